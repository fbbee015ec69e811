// Runs tests of this binary in a child process under oclgrind.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/files.hpp"

namespace pelage {

struct UnderOclgrind {
  int status = 0;       ///< exit status of the tests
  std::string log;      ///< oclgrind's messages; they are needed because oclgrind's exit status is always 0
  std::string printed;  ///< output of the tests; with --inst-counts, also oclgrind's output
};

/// Runs the tests of this binary that match `filter`, including disabled tests. `checks` contains the options
/// of oclgrind that follow --check-api. `environment` is an assignment "NAME=value" of an environment
/// variable for the command, or an empty string.
inline UnderOclgrind under_oclgrind(const std::string& filter, const std::string& checks,
                                    const std::string& environment = "") {
  const test::Folder folder;
  const std::string place = folder.path.string();
  UnderOclgrind found;
  found.status = std::system(
      fmt::format(
          "{} oclgrind --check-api {} --log '{}/log' '{}' --gtest_filter='{}' --gtest_also_run_disabled_tests >'{}/out' 2>&1",
          environment, checks, place, fs::read_symlink("/proc/self/exe").string(), filter, place)
          .c_str());
  found.log = folder.read("log");
  found.printed = folder.read("out");
  return found;
}

class Oclgrind : public ::testing::Test {
 protected:
  void SetUp() override {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "AddressSanitizer and oclgrind both want to be loaded first";
#endif
  }
};

}  // namespace pelage
