// Tests into which journals a merge writes rows, and which it leaves out or refuses.
#include "harness/record/merge.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <sstream>

#include "harness/error.hpp"
#include "harness/record/journal.hpp"
#include "tests/support/fake.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using namespace test;

const Identity kInputs{
    {"scene", "1111111111111111"}, {"device", "2222222222222222"}, {"kernel a.cl", "3333333333333333"}};

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

/// A temporary folder into which a test writes journals and pictures.
struct Inputs {
  Folder folder;

  void write(const std::string& journal, const std::vector<Row>& rows) const {
    const fs::path file = folder.path / journal;
    fs::create_directories(file.parent_path());
    std::string text;
    for (const Row& row : rows) text += to_line(row) + "\n";
    write_text(file, text);
  }
  void picture(const std::string& name, const std::string& bytes) const {
    fs::create_directories((folder.path / name).parent_path());
    write_text(folder.path / name, bytes);
  }
  Merge plan(const std::vector<std::string>& names, bool apart = false) const {
    std::vector<std::string> places;
    places.reserve(names.size());
    for (const std::string& name : names) places.push_back((folder.path / name).string());
    return plan_merge(read_results(places), apart);
  }
  std::string refusal(const std::vector<std::string>& names) const {
    return test::refusal([&] { plan(names); }, "");
  }
  fs::path out() const { return folder.path / "out"; }
};

std::vector<std::string> cases_of(const fs::path& journal) {
  std::vector<std::string> names;
  for (const Row& row : read_contents(journal).rows) names.push_back(row.case_name);
  return names;
}

using Names = std::vector<std::string>;

TEST(Merge, ShardsBecomeOneJournalAndRowsStayAsTheyAre) {
  const Inputs inputs;
  inputs.write("s0/own/gpu@node1.0-of-2.jsonl", {row_of("a"), row_of("c")});
  inputs.write("s1/own/gpu@node1.1-of-2.jsonl", {row_of("b", "run2")});
  // This row also belongs to the experiment "own". The row's field `experiment` determines this, not the name
  // "other" of the folder.
  inputs.write("s1/other/gpu@node2.jsonl", {row_of("b", "run3")});
  Merge merge = inputs.plan({"s0", "s1"});
  EXPECT_EQ(write_merge(merge, inputs.out()), 0u);
  EXPECT_EQ(cases_of(inputs.out() / "own/gpu@node1.jsonl"), (Names{"a", "c", "b"}));
  EXPECT_EQ(cases_of(inputs.out() / "own/gpu@node2.jsonl"), (Names{"b"}));
  EXPECT_EQ(text_of(inputs.out() / "own/gpu@node1.jsonl"),
            text_of(inputs.folder.path / "s0/own/gpu@node1.0-of-2.jsonl") +
                text_of(inputs.folder.path / "s1/own/gpu@node1.1-of-2.jsonl"));
}

TEST(Merge, ACopyIsWrittenOnce) {
  const Inputs inputs;
  inputs.write("a/own/gpu@node1.jsonl", {row_of("a"), row_of("b")});
  inputs.write("b/own/gpu@node1.jsonl", {row_of("a")});
  const Merge merge = inputs.plan({"a", "b"});
  EXPECT_EQ(merge.rows.size(), 2u);
  EXPECT_EQ(merge.copies, 1u);
}

TEST(Merge, AnErrorIsReplacedByAnyRowWithoutErrorAndByALaterError) {
  const Inputs inputs;
  inputs.write("a/own/gpu@node1.jsonl", {row_of("a"), failed(row_of("b"), "2026-11-21T00:00:02Z")});
  inputs.write("b/own/gpu@node1.jsonl", {failed(row_of("a", "run2"), "2026-11-22T00:00:00Z"),
                                         failed(row_of("b", "run2"), "2026-11-21T00:00:01Z")});
  const Merge merge = inputs.plan({"b", "a"});
  ASSERT_EQ(merge.rows.size(), 2u);
  EXPECT_EQ(merge.replaced, 2u);
  for (const MergedRow& row : merge.rows) EXPECT_EQ(row.found.row.run_id, "run1");
  EXPECT_EQ(merge.rows[0].found.row.status, Status::ok);
}

TEST(Merge, OtherInputsOfACaseAreRefusedAndNamed) {
  const Inputs inputs;
  Row edited = row_of("a", "run2");
  edited.identity["scene"] = "9999999999999999";
  inputs.write("a/own/gpu@node1.jsonl", {row_of("a")});
  inputs.write("b/own/gpu@node1.jsonl", {edited});
  const std::string text = inputs.refusal({"a", "b"});
  test::expect_has(text, {"a/own/gpu@node1.jsonl", "b/own/gpu@node1.jsonl",
                          "scene was 1111111111111111, is 9999999999999999", "--keep-apart"});
}

TEST(Merge, TwoMeasurementsOfACaseAreRefused) {
  const Inputs inputs;
  inputs.write("a/own/gpu@node1.jsonl", {row_of("a")});
  inputs.write("b/own/gpu@node1.jsonl", {row_of("a", "run2")});
  test::expect_has(inputs.refusal({"a", "b"}), "measured in different runs (run1 and run2)");
}

TEST(Merge, AChangedRowIsRefused) {
  const Inputs inputs;
  Row changed = row_of("a");
  changed.samples["frame"].wall_ms.front() /= 2;
  inputs.write("a/own/gpu@node1.jsonl", {row_of("a")});
  inputs.write("b/own/gpu@node1.jsonl", {changed});
  test::expect_has(inputs.refusal({"a", "b"}), "One of the files was changed");
}

// Two shards of one run have no case in common, so the merge cannot compare rows of the same case. It must
// compare the properties that are equal for all cases of a run, for example the device.
TEST(Merge, ShardsOfDifferentRunsAreRefusedAndNamed) {
  const auto refusal_of = [](const std::function<void(Row&)>& change) {
    const Inputs inputs;
    Row other = row_of("b", "run2");
    change(other);
    inputs.write("a/own/gpu@node1.0-of-2.jsonl", {row_of("a")});
    inputs.write("b/own/gpu@node1.1-of-2.jsonl", {other});
    return inputs.refusal({"a", "b"});
  };
  EXPECT_EQ(refusal_of([](Row&) {}), "");
  EXPECT_EQ(refusal_of([](Row& row) { row.identity["scene"] = "9999999999999999"; }), "");
  EXPECT_EQ(refusal_of([](Row& row) { row.identity["kernel b.cl"] = "9999999999999999"; }), "");
  for (const char* part : {"device", "kernel a.cl"}) {
    const std::string text = refusal_of([&](Row& row) { row.identity[part] = "9999999999999999"; });
    test::expect_has(text, std::string("are not of one run: ") + part + " was ");
  }
  const std::string preset = refusal_of([](Row& row) { row.provenance["preset"] = "smoke"; });
  test::expect_has(preset, "preset was quick, is smoke");
  const std::string schema = refusal_of([](Row& row) {
    row.schema = 1;
    row.identity.clear();
  });
  test::expect_has(schema, "schema was 2 or later, is 1 (without identity)");
}

TEST(Merge, WhatDiffersIsKeptApartOnRequest) {
  const Inputs inputs;
  Row edited = row_of("a", "run2");
  edited.identity["scene"] = "9999999999999999";
  inputs.write("a/own/gpu@node1.jsonl", {row_of("a"), row_of("b")});
  inputs.write("b/own/gpu@node1.jsonl", {edited, row_of("c", "run2")});
  inputs.write("c/own/gpu@node1.jsonl", {row_of("a", "run3")});
  inputs.picture("a/own/images/a.png", "first");
  inputs.picture("b/own/images/a.png", "edited");
  const Merge merge = inputs.plan({"a", "b", "c"}, true);
  EXPECT_EQ(merge.apart, (Names{"scene", "run, scene"}));
  EXPECT_EQ(write_merge(merge, inputs.out()), 2u);
  EXPECT_EQ(cases_of(inputs.out() / "own/gpu@node1.jsonl"), (Names{"a", "b"}));
  EXPECT_EQ(cases_of(inputs.out() / "apart-2/own/gpu@node1.jsonl"), (Names{"a", "c"}));
  EXPECT_EQ(cases_of(inputs.out() / "apart-3/own/gpu@node1.jsonl"), (Names{"a"}));
  EXPECT_EQ(text_of(inputs.out() / "own/images/a.png"), "first");
  EXPECT_EQ(text_of(inputs.out() / "apart-2/own/images/a.png"), "edited");
  EXPECT_EQ(read_results({inputs.out().string()}).size(), 5u);
}

TEST(Merge, RowsOfSchema1StayReadable) {
  const Inputs inputs;
  for (const char* name : {"a", "b"}) {
    Row row = row_of(name);
    row.schema = 1;
    row.identity.clear();
    inputs.write(std::string(name) + "/own/gpu@node1.jsonl", {row});
  }
  write_merge(inputs.plan({"a", "b"}), inputs.out());
  EXPECT_EQ(cases_of(inputs.out() / "own/gpu@node1.jsonl"), (Names{"a", "b"}));
  EXPECT_EQ(read_contents(inputs.out() / "own/gpu@node1.jsonl").rows.front().schema, 1);
}

TEST(Merge, EachRowKeepsItsPicture) {
  const Inputs inputs;
  inputs.write("a/own/gpu@node1.jsonl", {row_of("a")});
  inputs.write("b/own/gpu@node2.jsonl", {row_of("a", "run2")});
  inputs.write("c/own/cpu@node1.jsonl", {row_of("a", "run3")});
  inputs.picture("a/own/images/a.png", "of node1");
  inputs.picture("b/own/images/a.png", "of node2");
  inputs.picture("c/own/images/a@cpu.png", "of the cpu");
  inputs.picture("c/own/images/a.png", "of another device");
  EXPECT_EQ(write_merge(inputs.plan({"a", "b", "c"}), inputs.out()), 3u);
  std::set<std::string> pictures;
  for (const FoundRow& found : read_results({inputs.out().string()}))
    pictures.insert(text_of(picture_of(found)));
  EXPECT_EQ(pictures, (std::set<std::string>{"of node1", "of node2", "of the cpu"}));
}

// All processes of --repeat should write the same picture of a case. If the files differ, the merge must keep
// both.
TEST(Merge, APictureIsNeverReplaced) {
  const Inputs inputs;
  Row second = row_of("a", "run2");
  second.repeat = 1;
  inputs.write("a/own/gpu@node1.jsonl", {row_of("a")});
  inputs.write("b/own/gpu@node1.jsonl", {second});
  inputs.picture("a/own/images/a.png", "first");
  inputs.picture("b/own/images/a.png", "other");
  write_merge(inputs.plan({"a", "b"}), inputs.out());
  EXPECT_EQ(text_of(inputs.out() / "own/images/a.png"), "first");
  EXPECT_EQ(text_of(inputs.out() / "own/images/a@2.png"), "other");
}

TEST(Merge, NothingIsOverwritten) {
  const Inputs inputs;
  inputs.write("a/own/gpu@node1.jsonl", {row_of("a")});
  const Merge merge = inputs.plan({"a"});
  fs::create_directories(inputs.out());
  write_merge(merge, inputs.out());  // allowed, because the folder is empty
  const std::string before = text_of(inputs.out() / "own/gpu@node1.jsonl");
  EXPECT_THROW(write_merge(merge, inputs.out()), InputError);
  EXPECT_EQ(text_of(inputs.out() / "own/gpu@node1.jsonl"), before);
  write_text(inputs.folder.path / "file", "text");
  EXPECT_THROW(write_merge(merge, inputs.folder.path / "file"), InputError);
  EXPECT_EQ(text_of(inputs.folder.path / "file"), "text");
}

TEST(Merge, AFailedMergeLeavesNothing) {
  const Inputs inputs;
  inputs.write("a/own/gpu@node1.jsonl", {row_of("a")});
  inputs.picture("a/own/images/a.png", "picture");
  Merge merge = inputs.plan({"a"});
  // The merge now fails, because a journal refuses a second row with the same key.
  merge.rows.push_back(merge.rows.front());
  EXPECT_THROW(write_merge(merge, inputs.out()), InputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(inputs.folder.path), fs::directory_iterator()), 1);
}

TEST(Merge, ARowCannotLeaveTheFolder) {
  const Inputs inputs;
  for (const char* name : {"../../x", "/etc/x", "..", ""}) {
    Row row = row_of("a");
    row.experiment = name;
    inputs.write("a/own/gpu@node1.jsonl", {row});
    EXPECT_NE(inputs.refusal({"a"}).find("cannot be the name of a file"), std::string::npos) << name;
  }
  Row row = row_of("../a");
  inputs.write("a/own/gpu@node1.jsonl", {row});
  test::expect_has(inputs.refusal({"a"}), "cannot be the name of a file");
}

// A merge must copy the recorded rows of the repository. Rows of older schemas become rows of the present
// one.
TEST(Merge, TheRecordedRowsComeThroughUnchanged) {
  const Inputs inputs;
  std::size_t journals = 0;
  for (const fs::path& journal : journals_of({PELAGE_SOURCE_DIR "/results"})) {
    const fs::path out = inputs.folder.path / std::to_string(journals++);
    const std::vector<FoundRow> rows = read_results({journal.string()});
    write_merge(plan_merge(rows, false), out);
    std::istringstream recorded(text_of(journal));
    std::string expected;
    for (std::string line; std::getline(recorded, line);) expected += to_line(row_from_line(line)) + "\n";
    EXPECT_EQ(text_of(out / rows.front().row.experiment / journal.filename()), expected) << journal;
  }
  EXPECT_GE(journals, 5u);
}

}  // namespace
}  // namespace pelage
