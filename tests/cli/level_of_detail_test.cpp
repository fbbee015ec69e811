// Runs pelage-bench-lod. docs/level-of-detail.md states the limits that this test compares.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <re2/re2.h>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

const std::filesystem::path program = std::filesystem::path(PELAGE_BINARY).parent_path() / "pelage-bench-lod";

std::string output_of_bench(const Folder& folder, const std::string& arguments) {
  const std::string command =
      fmt::format("cd '{}' && ASAN_OPTIONS=detect_leaks=0 timeout 600 '{}' {} >out 2>err",
                  folder.path().string(), program.string(), arguments);
  EXPECT_EQ(std::system(command.c_str()), 0) << folder.read("err");
  return folder.read("out");
}

TEST(LevelOfDetail, ADollyHardlyPopsAndKeepsItsCoverage) {
  const Folder folder;
  for (const char* model : {"bunny", "torus"}) {
    const std::string out = output_of_bench(folder, fmt::format("{} 100000 320x240", model));
    double ratio = 0;
    ASSERT_TRUE(RE2::PartialMatch(out, R"(dolly: .*ratio ([0-9.]+))", &ratio)) << out;
    EXPECT_LE(ratio, 1.5) << model;
    EXPECT_GT(ratio, 0) << model;
    re2::StringPiece rest(out);
    double far = 0, near = 0;
    int lines = 0;
    while (RE2::FindAndConsume(
        &rest, R"(mean coverage ([+-][0-9.]+)% at the distance [0-9.]+, ([+-][0-9.]+)% at)", &far, &near)) {
      ++lines;
      EXPECT_LT(std::abs(far), 1) << model;
      EXPECT_LT(std::abs(near), 1) << model;
    }
    EXPECT_EQ(lines, 4) << out;
  }
}

}  // namespace
}  // namespace pelage::cli
