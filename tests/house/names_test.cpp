// Tests that the name of each mapping, pipeline, solver, topology and shading model occurs only in its own
// files, in one table and in at most two other places.
#include <gtest/gtest.h>

#include <cstdlib>

namespace {

TEST(Names, AreInOneTable) {
  EXPECT_EQ(std::system("python3 '" PELAGE_SOURCE_DIR "/scripts/names.py'"), 0);
}

}  // namespace
