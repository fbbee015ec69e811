// Tests scripts/compare_builds.py with two equal builds: it must draw frames with the two builds alternately,
// and print the ratios of the frame times of the builds.
#include <cstdio>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

TEST(CompareBuilds, EqualBuildsTakeTurnsAndGetARatio) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer must be the first library that is loaded";
#endif
  const Folder folder;
  fs::create_directories(folder.path / "tree/build/release");
  fs::create_symlink(PELAGE_BINARY, folder.path / "tree/build/release/pelage");
  for (const char* part : {"experiments", "kernels", "shaders"})
    fs::create_symlink(fs::path(PELAGE_SOURCE_DIR) / part, folder.path / "tree" / part);
  const int code = shell(
      folder,
      "python3 '" PELAGE_SOURCE_DIR
      "/scripts/compare_builds.py' tree tree -o out --rounds 2 --frames 3 --models torus --layers 16 --size 320x240");
  EXPECT_EQ(code, 0) << folder.read("stderr");
  const std::string text = folder.read("stdout");
  expect_has(text, "2 rounds; frame time new / old, and control / old\n");
  const auto line = text.find("geometric mean");
  ASSERT_NE(line, std::string::npos) << text;
  double ratio = 0, control = 0;
  ASSERT_EQ(std::sscanf(text.c_str() + line, "geometric mean %lf [%*f, %*f] %lf", &ratio, &control), 2)
      << text;
  // The builds are equal, so both ratios should be near 1. The exact ratios depend on the load of the
  // machine. The test therefore checks only that the ratios are positive.
  EXPECT_GT(ratio, 0);
  EXPECT_GT(control, 0);
  for (const char* side : {"old", "new", "control"})
    EXPECT_TRUE(fs::is_directory(folder.path / "out" / ("1-torus-16-320x240-" + std::string(side)))) << side;
}

}  // namespace
}  // namespace pelage::cli
