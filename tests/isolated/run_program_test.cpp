// Tests the function that runs another program.
#include <gtest/gtest.h>

#include <cstdlib>

#include "harness/isolated/isolated.hpp"

namespace pelage {
namespace {

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
