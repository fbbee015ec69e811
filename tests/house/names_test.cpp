// Each mapping (a way to distribute the pixels over work-items), pipeline, solver, topology and shading model
// has a name. The name may occur in the files that implement the named part, and in the table of its kind
// (for example, the table of all mappings). It may also occur in at most two other code lines of harness/ and
// bench/. The script scripts/names.py checks this rule.
#include <gtest/gtest.h>

#include <cstdlib>

namespace {

TEST(Names, AreInOneTable) {
  EXPECT_EQ(std::system("python3 '" PELAGE_SOURCE_DIR "/scripts/names.py'"), 0);
}

}  // namespace
