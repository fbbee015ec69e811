// Tests which rows pelage refuses, which cases run again, and that several copies of a row count as one row.
#include "harness/record/identity.hpp"

#include <gtest/gtest.h>

#include "harness/record/journal.hpp"
#include "harness/record/results_folder.hpp"
#include "tests/support/fake.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using namespace test;

template <class F>
std::string refusal_of_call(F&& call) {
  return test::refusal([&] { call(); }, "");
}

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
  row.identity = {{"scene", "0123456789abcdef"}, {"kernel a.cl", "fedcba9876543210"}};
  const Row back = row_from_line(to_line(row));
  EXPECT_EQ(back.schema, 3);
  EXPECT_EQ(back.identity, row.identity);
  row.schema = 1;
  const Row old = row_from_line(to_line(row));
  EXPECT_EQ(old.schema, 1);
  EXPECT_TRUE(old.identity.empty());
  row.schema = 4;
  test::expect_has(refusal_of_call([&] { row_from_line(to_line(row)); }), "schema 4");
}

TEST(Identity, ARowThatContradictsItsChecksIsRefused) {
  Row row = sample_row("a");
  row.check.push_back({"reference", "flips", 0.5, 0.001, false});
  test::expect_has(refusal_of_call([&] { row_from_line(to_line(row)); }), "its check flips");
  row.check.clear();
  test::expect_has(refusal_of_call([&] { row_from_line(to_line(row)); }), "nothing was checked");
}

// A row that a newer version of pelage wrote is not damaged. The error message must not advise the user to
// delete it.
TEST(Journal, ARowOfANewerVersionIsNotCalledDamaged) {
  const Folder folder;
  Row row = sample_row("a");
  row.schema = 4;
  folder.write("j.jsonl", to_line(row) + "\n");
  const std::string text = refusal_of_call([&] { read_contents(folder.path / "j.jsonl"); });
  test::expect_has(text, "j.jsonl:1: the row has schema 4");
  test::expect_lacks(text, "delete");
}

TEST(Journal, AFailedCaseRunsAgain) {
  const Folder folder;
  const fs::path file = folder.path / "j.jsonl";
  Row failed = sample_row("a");
  failed.status = Status::error;
  failed.reason = "disk full";
  failed.samples.clear();
  {
    Journal journal(file, Journal::Mode::fresh);
    journal.append(failed);
    EXPECT_FALSE(journal.holds(row_key(failed)));
    journal.append(failed);
    journal.append(sample_row("a"));
    EXPECT_TRUE(journal.holds(row_key(failed)));
    EXPECT_NE(refusal_of_call([&] { journal.append(failed); }), "");
  }
  const std::vector<Row> rows = read_contents(file).rows;
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows.front().status, Status::ok);
}

TEST(Results, ACopiedRowCountsOnceAndNamesItsCopies) {
  const Folder folder;
  const fs::path one = folder.path / "one.jsonl", two = folder.path / "two.jsonl";
  write_text(one, to_line(sample_row("a")) + "\n" + to_line(sample_row("b")) + "\n");
  fs::copy_file(one, two);
  const std::vector<FoundRow> rows = read_results({one.string(), two.string(), one.string()});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows.front().copies, (std::vector<fs::path>{two, one}));
}

TEST(Results, TwoRowsOfOneMeasurementThatDifferAreRefused) {
  const Folder folder;
  const fs::path one = folder.path / "one.jsonl", two = folder.path / "two.jsonl";
  Row changed = sample_row("a");
  changed.samples["frame"].wall_ms.front() /= 2;
  write_text(one, to_line(sample_row("a")) + "\n");
  write_text(two, to_line(changed) + "\n");
  const std::string text = refusal_of_call([&] { read_results({folder.path.string()}); });
  test::expect_has(text, {"one.jsonl", "two.jsonl"});
}

}  // namespace
}  // namespace pelage
