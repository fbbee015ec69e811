#include "harness/report/report.hpp"
#include "harness/table/render.hpp"
#include "tests/report/rows.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

std::vector<LeftOut> list_of(const std::vector<FoundRow>& rows) {
  return without_numbers(cells_of(rows), rows);
}

TEST(LeftOut, IsEmptyIfEveryCaseHasATime) {
  EXPECT_TRUE(list_of(test::table1_rows(0.01)).empty());
}

TEST(LeftOut, NamesEveryCaseWithoutATimeAndTheReason) {
  std::vector<FoundRow> rows = test::table1_rows();
  rows[0].row.status = Status::error;
  rows[0].row.reason = "clBuildProgram failed\nline 1 of the log\nline 2";
  rows[1].row.status = Status::failed_check;
  rows[1].row.reason =
      std::string(299, 'x') + "\u00e4 and more";  // byte 300 is the first of the two bytes of this letter
  rows[2].row.samples.clear();
  const std::vector<LeftOut> list = list_of(rows);
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0].case_name, rows[0].row.case_name);
  EXPECT_EQ(list[0].reason, "no time: error: clBuildProgram failed ...");
  EXPECT_EQ(list[1].reason, "no time: failed-check: " + std::string(299, 'x') + " ...");
  EXPECT_EQ(list[2].reason, "no time: the row has no times of frames");
  EXPECT_EQ(list[0].where, "shells/tile on test device");
}

TEST(LeftOut, NamesCasesWithoutTheRatioOfTheirExperiment) {
  std::vector<FoundRow> rows = test::table1_rows();
  rows[3].row.metrics["opengl_ratio"] = {2, "times"};
  const std::vector<LeftOut> list = list_of(rows);
  ASSERT_EQ(list.size(), rows.size() - 1);
  EXPECT_EQ(list[0].reason, "no ratio: the row does not contain the time of the OpenGL baseline");
}

TEST(LeftOut, NamesRowsWithoutEventTimes) {
  std::vector<FoundRow> rows = test::table1_rows();
  rows[4].row.provenance["event_times"] = "left out: the event times of all 6 frames are equal";
  const std::vector<LeftOut> list = list_of(rows);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].reason, "event times left out: the event times of all 6 frames are equal");
}

TEST(LeftOut, NamesRunsWithCasesThatHaveNoRow) {
  std::vector<FoundRow> rows = test::table1_rows();
  for (FoundRow& found : rows) found.row.provenance["shard_cases"] = found.row.provenance["all_cases"] = 40;
  const std::vector<LeftOut> list = missing_cases({rows.front().journal}, rows);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].experiment, "silva2010-table1");
  EXPECT_EQ(list[0].where, "test_device@h");
  EXPECT_EQ(list[0].reason, "cases without a row: 8 of 40");
  rows.resize(2);
  for (int shard = 0; shard < 2; ++shard)
    rows[std::size_t(shard)].row.provenance = {
        {"shard", fmt::format("{}/2", shard)}, {"all_cases", 3}, {"repeats", 2}};
  EXPECT_EQ(missing_cases({rows.front().journal}, rows).at(0).reason,
            "cases without a row: 4 of 6 in the whole run");
  rows[1].row.status = Status::error;
  for (const auto& [shard, cases, text] : {std::tuple("0/1", 1, "run: 1 of 1 cases, 1 ended with an error"),
                                           {"0/1", 2, "0 of 2; 1 more ended with an error"},
                                           {"1/2", 5, "3 of 5 in shard 1/2; 1 more ended with an error"}}) {
    for (FoundRow& found : rows) found.row.provenance = {{"shard", shard}, {"shard_cases", cases}};
    test::expect_has(missing_cases({rows.front().journal}, rows).back().reason, text);
  }
}

TEST(LeftOut, IsATableInEveryFormat) {
  const Table table = left_out_section({{"own", "a", "j.jsonl", "copy of a row of i.jsonl"},
                                        {"own", "a", "j.jsonl", "another reason"},
                                        {"", "", "k.jsonl", "the journal has no complete row"}})
                          .table;
  for (const std::string& text : {text_of(table), csv_of(table), latex_of(table), html_of(table)})
    test::expect_has(text, {"copy of a row of i.jsonl", "another reason", "the journal has no complete row"});
}

}  // namespace
}  // namespace pelage
