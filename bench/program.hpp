// The frame of the benchmark programs of this folder: positional arguments and errors.
#pragma once
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>

#include "harness/error.hpp"

namespace pelage::bench {

/// The positional arguments of a program, numbered from 1.
struct Arguments {
  int count;
  char** values;

  std::string at(int i, const char* otherwise) const { return count > i ? values[i] : otherwise; }
};

/// Prints the usage and returns the exit code for a wrong command line.
inline int wrong_usage(const char* usage) {
  fmt::print(stderr, "usage: {}\n", usage);
  return 2;
}

/// Returns the result of run(arguments), which is the exit code of the program `name`. If run() throws,
/// prints the exception in one line, and returns 2 for an InputError, 3 if there is no OpenCL device, and 1
/// otherwise.
template <class Run>
int exit_code(const char* name, int argc, char** argv, Run&& run) {
  const auto report = [&](const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
  };
  try {
    return run(Arguments{argc, argv});
  } catch (const InputError& error) {
    report(error);
    return 2;
  } catch (const NoDeviceError& error) {
    report(error);
    return 3;
  } catch (const std::exception& error) {
    report(error);
    return 1;
  }
}

}  // namespace pelage::bench
