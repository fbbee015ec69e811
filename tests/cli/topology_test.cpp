// pelage topology prints what the paper counts.
#include <gtest/gtest.h>

#include <regex>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

/// "name masses springs" of the row of that name; empty when there is none.
std::string row_of(const std::string& text, const std::string& name) {
  std::smatch found;
  const std::regex row("(^|\n)" + name + " +([0-9]+) +([0-9]+) ");
  return std::regex_search(text, found, row) ? found[2].str() + " " + found[3].str() : "";
}

TEST(TopologyCommand, CountsThePapersModels) {
  const Folder folder;
  const Outcome grass = pelage(folder, "topology banisch-grass");
  ASSERT_EQ(grass.code, 0) << grass.err;
  EXPECT_NE(grass.out.find("13 surface points"), std::string::npos) << grass.out;
  EXPECT_EQ(row_of(grass.out, "sticks"), "26 13");
  EXPECT_EQ(row_of(grass.out, "prisms"), "26 41");
  EXPECT_EQ(row_of(grass.out, "separable-sticks"), "96 48");
  EXPECT_EQ(row_of(grass.out, "separable-prisms"), "96 96");
  const Outcome elephant = pelage(folder, "topology banisch-elephant");
  ASSERT_EQ(elephant.code, 0) << elephant.err;
  EXPECT_EQ(row_of(elephant.out, "separable-prisms"), "6888 6888");
  EXPECT_EQ(row_of(elephant.out, "separable-sticks"), "6888 3444");
  EXPECT_NE(row_of(elephant.out, "sticks on vertex copies"), "");
}

TEST(TopologyCommand, RefusesWhatIsNoModel) {
  const Folder folder;
  const Outcome outcome = pelage(folder, "topology no-such-model");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("no-such-model"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace pelage::cli
