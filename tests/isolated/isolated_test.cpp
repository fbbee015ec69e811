// Tests the memory and time limits of the separate process that prepares a mesh.
#include "harness/isolated/isolated.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "harness/error.hpp"

namespace pelage {
namespace {

std::uint64_t address_space() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0;
  file >> pages;
  return pages * std::uint64_t(::sysconf(_SC_PAGESIZE));
}

// Allocates `bytes` bytes of memory in the isolated process. Returns the error message, or "" if there is no
// error.
std::string message_of(std::uint64_t bytes, const Limits& limits) {
  try {
    isolated("cat.obj", limits,
             [bytes](const Say&) {
               const std::string taken(bytes, 'x');
               return taken.substr(0, 1);
             },
             {});
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

class LimitOfUser : public ::testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "AddressSanitizer reserves terabytes of address space, so the process has no limit";
#endif
    ASSERT_EQ(::getrlimit(RLIMIT_AS, &before_), 0);
    now_ = before_;
    now_.rlim_cur = address_space() + (std::uint64_t(256) << 20);
    ASSERT_EQ(::setrlimit(RLIMIT_AS, &now_), 0);  // what `ulimit -S -v` does
  }
  void TearDown() override {
    if (now_.rlim_cur != 0) ::setrlimit(RLIMIT_AS, &before_);
  }
  rlimit before_{}, now_{};
};

TEST_F(LimitOfUser, StaysInForceAndIsNamed) {
  const Limits limits{std::uint64_t(4) << 30, std::chrono::seconds(60)};
  const std::string message = message_of(std::uint64_t(1) << 30, limits);
  EXPECT_NE(message.find("cat.obj: cannot be used: needs more memory than the limit that the shell sets: " +
                         std::to_string(now_.rlim_cur >> 20) + " MiB (ulimit -v)"),
            std::string::npos)
      << message;
  EXPECT_EQ(message_of(1000, limits), "");
}

TEST_F(LimitOfUser, IsNotNamedIfTheOwnLimitIsLower) {
  const std::string message =
      message_of(std::uint64_t(1) << 30, {std::uint64_t(64) << 20, std::chrono::seconds(60)});
  EXPECT_NE(message.find("needs more than 64 MiB of memory"), std::string::npos) << message;
}

}  // namespace
}  // namespace pelage
