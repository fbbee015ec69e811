// Runs tests of this binary in a child process under oclgrind.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

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
  namespace fs = std::filesystem;
  const fs::path stem = fs::temp_directory_path() / fmt::format("pelage-oclgrind-{}", ::getpid());
  const fs::path log = stem.string() + ".log", out = stem.string() + ".out";
  UnderOclgrind found;
  found.status = std::system(fmt::format("{} oclgrind --check-api {} --log '{}' '{}' --gtest_filter='{}' "
                                         "--gtest_also_run_disabled_tests >'{}' 2>&1",
                                         environment, checks, log.string(),
                                         fs::read_symlink("/proc/self/exe").string(), filter, out.string())
                                 .c_str());
  found.log = test::text_of(log);
  found.printed = test::text_of(out);
  fs::remove(log);
  fs::remove(out);
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
