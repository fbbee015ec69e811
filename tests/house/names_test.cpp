// Tests that each mapping, pipeline, solver, topology or model of shading is named in its own files, in one
// table and in at most two further places.
#include <gtest/gtest.h>

#include <cstdlib>

namespace {

TEST(Names, AreInOneTable) {
  EXPECT_EQ(std::system("python3 '" PELAGE_SOURCE_DIR "/scripts/names.py'"), 0);
}

}  // namespace
