#include <gtest/gtest.h>

#include "harness/report/csv.hpp"
#include "tests/report/rows.hpp"

namespace pelage {
namespace {

std::vector<FoundRow> with(std::vector<FoundRow> rows, const Identity& identity, const std::string& run) {
  for (FoundRow& found : rows) {
    found.row.identity = identity;
    found.row.run_id = run;
    found.journal = run + ".jsonl";
  }
  return rows;
}

TEST(InputSets, RowsOfOneIdentityAreOneSet) {
  auto rows = with(test::table1_rows(), {{"scene", "1"}}, "a");
  const auto again = with(test::table1_rows(), {{"scene", "1"}}, "b");
  rows.insert(rows.end(), again.begin(), again.end());
  const auto sets = input_sets(rows);
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(sets[0].rows.size(), 64u);
  EXPECT_EQ(sets[0].differs, "");
}

TEST(InputSets, OtherInputsStandApartAndAreNamed) {
  auto rows = with(test::table1_rows(), {{"mesh", "m"}, {"scene", "1"}, {"kernel a.cl", "k"}}, "a");
  auto other = with(test::table1_rows(2), {{"mesh", "m"}, {"scene", "2"}, {"kernel a.cl", "l"}}, "b");
  other.resize(5);
  other[4].row.case_name = "only here";  // the first set has no such case
  const auto old = with(test::table1_rows(3), {}, "c");
  rows.insert(rows.end(), other.begin(), other.end());
  rows.insert(rows.end(), old.begin(), old.end());
  const auto sets = input_sets(rows);
  ASSERT_EQ(sets.size(), 3u);
  EXPECT_EQ(sets[0].rows.size(), 32u);
  EXPECT_EQ(sets[1].rows.size(), 5u);
  EXPECT_EQ(sets[1].differs, "kernel a.cl with its includes, scene");
  EXPECT_EQ(sets[2].rows.size(), 32u);
  EXPECT_EQ(sets[2].differs, "identity incomplete");
}

TEST(InputSets, AJournalWithTwoIdentitiesOfACaseIsDivided) {
  auto rows = with(test::table1_rows(), {{"scene", "1"}}, "a");
  rows.push_back(rows.front());
  rows.back().row.repeat = 1;
  rows.back().row.identity = {{"scene", "2"}};
  const auto sets = input_sets(rows);
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_EQ(sets[1].rows.size(), 1u);
  EXPECT_EQ(sets[1].differs, "scene");
}

TEST(InputSets, NoRowsAreOneEmptySet) {
  const auto sets = input_sets({});
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_TRUE(sets[0].rows.empty());
}

}  // namespace
}  // namespace pelage
