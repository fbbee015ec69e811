// Tests which rows pelage refuses, which cases run again, and that several copies of a row count as one row.
#include "harness/record/identity.hpp"

#include "harness/record/journal.hpp"
#include "harness/record/results_folder.hpp"
#include "tests/support/fake.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using namespace test;

TEST(Identity, DifferencesNameEveryPartOnce) {
  const Identity a{{"mesh", "1111111111111111"}, {"scene", "2222222222222222"}, {"kernel a.cl", "3"}};
  const Identity b{{"mesh", "1111111111111111"}, {"scene", "4444444444444444"}, {"kernel b.cl", "3"}};
  EXPECT_EQ(differences(a, a), std::vector<std::string>{});
  EXPECT_EQ(differing_parts(a, b), (std::vector<std::string>{"kernel a.cl with its includes",
                                                             "kernel b.cl with its includes", "scene"}));
  EXPECT_EQ(differences(a, b), (std::vector<std::string>{"kernel a.cl with its includes was 3, is absent",
                                                         "kernel b.cl with its includes was absent, is 3",
                                                         "scene was 2222222222222222, is 4444444444444444"}));
}

TEST(Identity, ItsHashDependsOnNamesAndContents) {
  EXPECT_EQ(hash_of(Identity{}), "");
  EXPECT_EQ(hash_of(Identity{{"a", "1"}}).size(), 16u);
  EXPECT_NE(hash_of(Identity{{"a", "1"}}), hash_of(Identity{{"a", "2"}}));
  EXPECT_NE(hash_of(Identity{{"a", "12"}}), hash_of(Identity{{"a1", "2"}}));
}

TEST(Identity, ARowKeepsItsIdentityAndItsSchema) {
  Row row = sample_row("a");
  row.schema = 2;
  row.identity = {{"scene", "0123456789abcdef"}, {"kernel a.cl", "fedcba9876543210"}};
  const Row back = row_from_line(to_line(row));
  EXPECT_EQ(back.schema, 3);
  EXPECT_EQ(back.identity, row.identity);
  row.schema = 1;
  expect_lacks(to_line(row), "\"identity\"");
  const Row old = row_from_line(to_line(row));
  EXPECT_EQ(old.schema, 1);
  EXPECT_TRUE(old.identity.empty());
}

TEST(Identity, ARowThatContradictsItsChecksIsRefused) {
  Row row = sample_row("a");
  row.check.back().limit = 0.008;
  expect_has(refusal([&] { row_from_line(to_line(row)); }), "weaker than pelage's limit");
  row.check = {{"reference", "flips", 0.5, 0.001, false}};
  expect_has(refusal([&] { row_from_line(to_line(row)); }), "its check flips");
  row.check.clear();
  expect_has(refusal([&] { row_from_line(to_line(row)); }), "nothing was checked");
}

TEST(Results, ACopiedRowCountsOnceAndNamesItsCopies) {
  const Folder folder;
  const fs::path one = folder.path / "one.jsonl", two = folder.path / "two.jsonl";
  write_text(one, to_line(sample_row("a")) + "\n" + to_line(sample_row("b")) + "\n{");
  fs::copy_file(one, two);
  const Results results = read_all_results({one.string(), two.string(), one.string()});
  ASSERT_EQ(results.rows.size(), 2u);
  EXPECT_EQ(results.rows.front().copies, (std::vector<fs::path>{two, one}));
  EXPECT_EQ(results.left_out.front().reason, "the last line (1 bytes) is not complete");
}

TEST(Results, TwoRowsOfOneMeasurementThatDifferAreRefused) {
  const Folder folder;
  const fs::path one = folder.path / "one.jsonl", two = folder.path / "two.jsonl";
  Row changed = sample_row("a");
  changed.samples["frame"].wall_ms.front() /= 2;
  write_text(one, to_line(sample_row("a")) + "\n");
  write_text(two, to_line(changed) + "\n");
  const std::string text = refusal([&] { read_results({folder.path.string()}); });
  expect_has(text, {"one.jsonl", "two.jsonl", "One of the files was changed"});
}

TEST(Results, TwoRowsWithTwoEqualTimesAreRefused) {
  const Folder folder;
  Row a = sample_row("a");
  for (auto& [phase, times] : a.samples)
    for (auto* list : {&times.wall_ms, &times.event_ms, &times.cpu_ms})
      if (!list->empty()) list->resize(2);
  Row b = a;
  b.case_name = "b";
  write_text(folder.path / "one.jsonl", to_line(a) + "\n" + to_line(b) + "\n");
  expect_has(refusal([&] { read_results({folder.path.string()}); }), "their 2 frame times are equal");
}

}  // namespace
}  // namespace pelage
