// Tests the memory and time limits of the separate process that prepares a mesh.
#include "harness/isolated/isolated.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "tests/support/texts.hpp"

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
  return test::refusal(
      [&] {
        isolated("cat.obj", limits,
                 [bytes](const Say&) {
                   const std::string taken(bytes, 'x');
                   return taken.substr(0, 1);
                 },
                 {});
      },
      "");
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
  test::expect_has(message,
                   "cat.obj: cannot be used: needs more memory than the limit that the shell sets: " +
                       std::to_string(now_.rlim_cur >> 20) + " MiB (ulimit -v)");
  EXPECT_EQ(message_of(1000, limits), "");
}

TEST_F(LimitOfUser, IsNotNamedIfTheOwnLimitIsLower) {
  test::expect_has(message_of(std::uint64_t(1) << 30, {std::uint64_t(64) << 20, std::chrono::seconds(60)}),
                   "needs more than 64 MiB of memory");
}

TEST(RunProgram, GivesTheExitCodeAndTheMessages) {
  const ProgramOutcome outcome = run_program({"sh", "-c", "echo one; echo two >&2; exit 3"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.messages, "one\ntwo\n");
  EXPECT_EQ(last_line(outcome.messages), "two");
}

TEST(RunProgram, PassesArgumentsWithoutAShell) {
  EXPECT_EQ(run_program({"printf", "%s|", "a b", "$HOME", "*"}).messages, "a b|$HOME|*|");
}

TEST(RunProgram, RunsInAFolderWithoutInput) {
  EXPECT_EQ(run_program({"pwd"}, "/usr").messages, "/usr\n");
  EXPECT_EQ(run_program({"cat"}).messages, "");
}

TEST(RunProgram, TellsThatAProgramCannotBeStartedOrWasKilled) {
  EXPECT_EQ(run_program({"no-program-of-this-name"}).code, 127);
  EXPECT_EQ(run_program({"pwd"}, "/no-such-folder").code, 127);
  EXPECT_EQ(run_program({"sh", "-c", "kill -9 $$"}).code, -1);
}

TEST(RunProgram, SearchesOnPath) {
  EXPECT_TRUE(on_path("sh"));
  EXPECT_FALSE(on_path("no-program-of-this-name"));
  EXPECT_FALSE(on_path("."));  // a folder
}

}  // namespace
}  // namespace pelage
