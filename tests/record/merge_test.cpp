// Tests into which journals a merge writes rows, and which it leaves out or refuses.
#include "harness/record/merge.hpp"

#include <functional>
#include <set>

#include "harness/error.hpp"
#include "harness/record/journal.hpp"
#include "tests/support/fake.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using namespace test;

const Identity kInputs{{"scene", "1111111111111111"},       {"device", "2222222222222222"},
                       {"kernel a.cl", "3333333333333333"}, {"sampling", "4444444444444444"},
                       {build_part, "5555555555555555"},    {shader_part, "6666666666666666"},
                       {renderer_part, "7777777777777777"}};

Row row_of(const std::string& name, const std::string& run = "run1") {
  Row row = test::sample_row(name);
  row.run_id = run;
  test::vary_times(row, run);
  row.experiment = "own";
  row.identity = kInputs;
  row.provenance["host"] = "node1";
  row.provenance["preset"] = "quick";
  return row;
}

Row failed(Row row, const std::string& utc) {
  row.status = Status::error;
  row.reason = "disk full";
  row.samples.clear();
  row.provenance["utc"] = utc;
  return row;
}

/// Tests write journals and pictures into the folder.
struct Merging : InFolder {
  void write(const std::string& journal, const std::vector<Row>& rows) const {
    std::string text;
    for (const Row& row : rows) text += to_line(row) + "\n";
    picture(journal, text);
  }
  /// Writes the journals a/own/gpu@node1.jsonl and b/own/gpu@node1.jsonl.
  void write_two(const std::vector<Row>& a, const std::vector<Row>& b) const {
    write("a/own/gpu@node1.jsonl", a);
    write("b/own/gpu@node1.jsonl", b);
  }
  void picture(const std::string& name, const std::string& bytes) const {
    fs::create_directories((folder.path / name).parent_path());
    folder.write(name, bytes);
  }
  Merge plan(const std::vector<std::string>& names, bool apart = false) const {
    std::vector<std::string> places;
    places.reserve(names.size());
    for (const std::string& name : names) places.push_back((folder.path / name).string());
    return plan_merge(read_results(places), apart);
  }
  std::string refusal_of(const std::vector<std::string>& names) const {
    return refusal([&] { plan(names); });
  }
  const fs::path out = folder.path / "out";
};

std::vector<std::string> cases_of(const fs::path& journal) {
  std::vector<std::string> names;
  for (const Row& row : read_contents(journal).rows) names.push_back(row.case_name);
  return names;
}

using Names = std::vector<std::string>;

TEST_F(Merging, ShardsBecomeOneJournalAndRowsStayAsTheyAre) {
  write("s0/own/gpu@node1.0-of-2.jsonl", {row_of("a"), row_of("c")});
  write("s1/own/gpu@node1.1-of-2.jsonl", {row_of("b", "run2")});
  // This row also belongs to the experiment "own". The row's field `experiment` determines this, not the name
  // "other" of the folder.
  write("s1/other/gpu@node2.jsonl", {row_of("b", "run3")});
  picture("s1/other/images/b.png", "of node2");
  Merge merge = plan({"s0", "s1"});
  EXPECT_EQ(write_merge(merge, out), 1u);
  EXPECT_EQ(text_of(out / "own/images/b@gpu@node2.png"), "of node2");
  EXPECT_EQ(cases_of(out / "own/gpu@node1.jsonl"), (Names{"a", "c", "b"}));
  EXPECT_EQ(cases_of(out / "own/gpu@node2.jsonl"), (Names{"b"}));
  EXPECT_EQ(text_of(out / "own/gpu@node1.jsonl"), text_of(folder.path / "s0/own/gpu@node1.0-of-2.jsonl") +
                                                      text_of(folder.path / "s1/own/gpu@node1.1-of-2.jsonl"));
}

TEST_F(Merging, ACopyIsWrittenOnce) {
  write_two({row_of("a"), row_of("b")}, {row_of("a")});
  const Merge merge = plan({"a", "b"});
  EXPECT_EQ(merge.rows.size(), 2u);
  EXPECT_EQ(merge.copies, 1u);
}

TEST_F(Merging, AnErrorIsReplacedByAnyRowWithoutErrorAndByALaterError) {
  write_two({row_of("a"), failed(row_of("b"), "2026-11-21T00:00:02Z")},
            {failed(row_of("a", "run2"), "2026-11-22T00:00:00Z"),
             failed(row_of("b", "run2"), "2026-11-21T00:00:01Z")});
  const Merge merge = plan({"b", "a"});
  ASSERT_EQ(merge.rows.size(), 2u);
  EXPECT_EQ(merge.replaced, 2u);
  for (const MergedRow& row : merge.rows) EXPECT_EQ(row.found.row.run_id, "run1");
  EXPECT_EQ(merge.rows[0].found.row.status, Status::ok);
  picture("a/own/images/b.png", "of an earlier run");
  EXPECT_EQ(write_merge(merge, out), 0u);
}

TEST_F(Merging, OtherInputsOfACaseAreRefusedAndNamed) {
  Row edited = row_of("a", "run2");
  edited.identity["scene"] = "9999999999999999";
  write_two({row_of("a")}, {edited});
  expect_has(refusal_of({"a", "b"}), {"a/own/gpu@node1.jsonl", "b/own/gpu@node1.jsonl",
                                      "scene was 1111111111111111, is 9999999999999999", "--keep-apart"});
}

TEST_F(Merging, TwoMeasurementsOfACaseAreRefused) {
  write_two({row_of("a")}, {row_of("a", "run2")});
  expect_has(refusal_of({"a", "b"}), "measured in different runs (run1 and run2)");
}

TEST_F(Merging, ShardsOfDifferentRunsAreRefusedAndNamed) {
  const auto refusal_with = [this](const std::function<void(Row&)>& change) {
    Row other = row_of("b", "run2");
    change(other);
    write("a/own/gpu@node1.0-of-2.jsonl", {row_of("a")});
    write("b/own/gpu@node1.1-of-2.jsonl", {other});
    return refusal_of({"a", "b"});
  };
  EXPECT_EQ(refusal_with([](Row&) {}), "accepted");
  EXPECT_EQ(refusal_with([](Row& row) { row.identity["scene"] = "9999999999999999"; }), "accepted");
  EXPECT_EQ(refusal_with([](Row& row) { row.identity["kernel b.cl"] = "9999999999999999"; }), "accepted");
  for (const char* part : {"device", "kernel a.cl", "sampling", build_part, shader_part, renderer_part}) {
    expect_has(refusal_with([&](Row& row) { row.identity[part] = "9999999999999999"; }),
               std::string("are not of one run: ") + part + " was ");
  }
  expect_has(refusal_with([](Row& row) { row.provenance["preset"] = "smoke"; }),
             "preset was quick, is smoke");
  expect_has(refusal_with([](Row& row) { row.schema = 1, row.identity.clear(); }),
             "schema was 2 or later, is 1 (without identity)");
}

TEST_F(Merging, WhatDiffersIsKeptApartOnRequest) {
  Row edited = row_of("a", "run2");
  edited.identity["scene"] = "9999999999999999";
  write_two({row_of("a"), row_of("b")}, {edited, row_of("c", "run2")});
  write("c/own/gpu@node1.jsonl", {row_of("a", "run3")});
  picture("a/own/images/a.png", "first");
  picture("b/own/images/a.png", "edited");
  const Merge merge = plan({"a", "b", "c"}, true);
  EXPECT_EQ(merge.apart, (Names{"scene", "run, scene"}));
  EXPECT_EQ(write_merge(merge, out), 2u);
  EXPECT_EQ(cases_of(out / "own/gpu@node1.jsonl"), (Names{"a", "b"}));
  EXPECT_EQ(cases_of(out / "apart-2/own/gpu@node1.jsonl"), (Names{"a", "c"}));
  EXPECT_EQ(cases_of(out / "apart-3/own/gpu@node1.jsonl"), (Names{"a"}));
  EXPECT_EQ(text_of(out / "own/images/a.png"), "first");
  EXPECT_EQ(text_of(out / "apart-2/own/images/a.png"), "edited");
  EXPECT_EQ(read_results({out.string()}).size(), 5u);
}

TEST_F(Merging, RowsOfSchema1StayReadable) {
  for (const char* name : {"a", "b"}) {
    Row row = row_of(name);
    row.schema = 1;
    row.identity.clear();
    write(std::string(name) + "/own/gpu@node1.jsonl", {row});
  }
  write_merge(plan({"a", "b"}), out);
  EXPECT_EQ(cases_of(out / "own/gpu@node1.jsonl"), (Names{"a", "b"}));
  EXPECT_EQ(read_contents(out / "own/gpu@node1.jsonl").rows.front().schema, 1);
}

TEST_F(Merging, EachRowKeepsItsPicture) {
  write("a/own/gpu@node1.jsonl", {row_of("a")});
  write("b/own/gpu@node2.jsonl", {row_of("a", "run2")});
  write("c/own/cpu@node1.jsonl", {row_of("a", "run3")});
  picture("a/own/images/a.png", "of node1");
  picture("b/own/images/a.png", "of node2");
  picture("c/own/images/a@cpu.png", "of the cpu");
  picture("c/own/images/a.png", "of another device");
  EXPECT_EQ(write_merge(plan({"a", "b", "c"}), out), 3u);
  std::set<std::string> pictures;
  for (const FoundRow& found : read_results({out.string()})) pictures.insert(text_of(picture_of(found)));
  EXPECT_EQ(pictures, (std::set<std::string>{"of node1", "of node2", "of the cpu"}));
}

// All processes of --repeat should write the same picture of a case. If the files differ, the merge must keep
// both.
TEST_F(Merging, APictureIsNeverReplaced) {
  Row second = row_of("a", "run2");
  second.repeat = 1;
  write_two({row_of("a")}, {second});
  picture("a/own/images/a.png", "first");
  picture("b/own/images/a.png", "other");
  write_merge(plan({"a", "b"}), out);
  EXPECT_EQ(text_of(out / "own/images/a.png"), "first");
  EXPECT_EQ(text_of(out / "own/images/a@2.png"), "other");
}

TEST_F(Merging, NothingIsOverwritten) {
  write("a/own/gpu@node1.jsonl", {row_of("a")});
  const Merge merge = plan({"a"});
  fs::create_directories(out);
  write_merge(merge, out);  // allowed, because the folder is empty
  const std::string before = text_of(out / "own/gpu@node1.jsonl");
  EXPECT_THROW(write_merge(merge, out), InputError);
  EXPECT_EQ(text_of(out / "own/gpu@node1.jsonl"), before);
  write_text(folder.path / "file", "text");
  EXPECT_THROW(write_merge(merge, folder.path / "file"), InputError);
  EXPECT_EQ(text_of(folder.path / "file"), "text");
}

TEST_F(Merging, AFailedMergeLeavesNothing) {
  write("a/own/gpu@node1.jsonl", {row_of("a")});
  picture("a/own/images/a.png", "picture");
  Merge merge = plan({"a"});
  // The merge now fails, because a journal refuses a second row with the same key.
  merge.rows.push_back(merge.rows.front());
  EXPECT_THROW(write_merge(merge, out), InputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()), 1);
}

TEST_F(Merging, ARowCannotLeaveTheFolder) {
  for (const char* name : {"../../x", "/etc/x", "..", ""}) {
    Row row = row_of("a");
    row.experiment = name;
    write("a/own/gpu@node1.jsonl", {row});
    expect_has(refusal_of({"a"}), "cannot be the name of a file");
  }
  Row row = row_of("../a");
  write("a/own/gpu@node1.jsonl", {row});
  expect_has(refusal_of({"a"}), "cannot be the name of a file");
}

// A merge must copy the recorded rows of the repository. Rows of older schemas become rows of the present
// one.
TEST_F(Merging, TheRecordedRowsComeThroughUnchanged) {
  std::size_t journals = 0;
  for (const fs::path& journal : journals_of({PELAGE_SOURCE_DIR "/results"})) {
    const fs::path merged = folder.path / std::to_string(journals++);
    const std::vector<FoundRow> rows = read_results({journal.string()});
    write_merge(plan_merge(rows, false), merged);
    std::string expected;
    for (const std::string& line : lines_of(text_of(journal)))
      expected += to_line(row_from_line(line)) + "\n";
    EXPECT_EQ(text_of(merged / rows.front().row.experiment / journal.filename()), expected) << journal;
  }
  EXPECT_GE(journals, 5u);
}

}  // namespace
}  // namespace pelage
