#include "harness/experiment/balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace pelage {
namespace {

using Times = std::vector<std::optional<double>>;

Row row_of(const std::string& name, double prepare_s, double sampling_s, double check_s) {
  Row row;
  row.experiment = "own";
  row.case_name = name;
  row.provenance = {{"prepare_s", prepare_s}, {"sampling_s", sampling_s}, {"check_s", check_s}};
  return row;
}

std::vector<double> loads_of(const Times& times, const std::vector<int>& shards, int count) {
  std::vector<double> loads(std::size_t(count), 0.0);
  for (std::size_t i = 0; i < shards.size(); ++i) loads[std::size_t(shards[i])] += times[i].value_or(0);
  return loads;
}

TEST(Deal, WithoutTimesEveryCountThCaseBelongsToOneShard) {
  EXPECT_EQ(deal(Times(7), 3), (std::vector<int>{0, 1, 2, 0, 1, 2, 0}));
  EXPECT_EQ(deal(Times(2), 5), (std::vector<int>{0, 1}));
  EXPECT_TRUE(deal(Times(), 5).empty());
}

// deal() must give each of the two shards 13 s. If it assigned the cases alternately to the shards, the
// shards would take 22 s and 4 s.
TEST(Deal, ALongCaseDoesNotShareItsShardWithOthers) {
  const Times times{10.0, 1.0, 6.0, 1.0, 6.0, 2.0};
  const std::vector<int> shards = deal(times, 2);
  EXPECT_EQ(loads_of(times, shards, 2), (std::vector<double>{13, 13}));
}

// The case without a time counts as 4 s, the mean of the times of the other cases. deal() assigns the cases
// in the order 6 s, 4 s, 4 s, 2 s.
TEST(Deal, ACaseWithoutATimeCountsAsTheMeanOfTheOthers) {
  EXPECT_EQ(deal({2.0, std::nullopt, 6.0, 4.0}, 3), (std::vector<int>{1, 1, 0, 2}));
}

TEST(Deal, EqualTimesAreDealtInTurn) {
  EXPECT_EQ(deal({5.0, 5.0, 5.0, 5.0, 5.0}, 3), (std::vector<int>{0, 1, 2, 0, 1}));
}

// The load of a shard is the sum of its times. Each case goes to the smallest load, which is at most the
// mean. Therefore no load exceeds the mean plus the largest time of a case.
TEST(Deal, EveryCaseIsInOneShardAndTheLoadsAreBounded) {
  std::mt19937 random(18);
  for (int round = 0; round < 500; ++round) {
    const int count = 1 + int(random() % 8);
    Times times(random() % 60);
    double sum = 0, largest = 0;
    for (auto& time : times) {
      time = double(random() % 100000) / 1000;
      sum += *time;
      largest = std::max(largest, *time);
    }
    const std::vector<int> shards = deal(times, count);
    ASSERT_EQ(shards.size(), times.size());
    EXPECT_EQ(shards, deal(times, count));
    for (const int shard : shards) EXPECT_TRUE(shard >= 0 && shard < count) << shard;
    for (const double load : loads_of(times, shards, count)) EXPECT_LE(load, sum / count + largest + 1e-9);
  }
}

TEST(CaseSeconds, AddsPreparationSamplingAndChecks) {
  EXPECT_EQ(case_seconds(row_of("a", 1, 2, 4)), 7);
  EXPECT_EQ(case_seconds(row_of("a", -1, 2, 4)), 6);  // no time is negative; a user may have edited the row
  Row old = row_of("a", 1, 2, 4);
  old.provenance.clear();
  old.first_launch_ms = 500;
  old.samples["frame"].wall_ms = {100, 200};
  old.samples["raster"].event_ms = {90, 190};
  EXPECT_DOUBLE_EQ(case_seconds(old).value(), 0.8);
  old.status = Status::error;
  EXPECT_FALSE(case_seconds(old).has_value());
}

TEST(CaseSeconds, IsAveragedOverTheRowsOfACase) {
  std::vector<FoundRow> rows{
      {row_of("a", 1, 1, 0), "j"}, {row_of("a", 2, 2, 0), "j"}, {row_of("b", 9, 0, 0), "j"}};
  rows[2].row.first_launch_ms = 500;  // sampling_s, which is 0, counts in its place
  rows.push_back({row_of("a", 100, 0, 0), "j"});
  rows.back().row.experiment = "another";
  std::vector<Case> cases(3);
  cases[0].name = "c";
  cases[1].name = "b";
  cases[2].name = "a";
  EXPECT_EQ(earlier_seconds("own", cases, rows), (Times{std::nullopt, 9.0, 3.0}));
}

TEST(Deal, ItsHashDependsOnCasesAndShards) {
  std::vector<Case> cases(2);
  cases[0].name = "a";
  cases[1].name = "b";
  const std::string hash = hash_of_deal(cases, {0, 1});
  EXPECT_EQ(hash, "6825bfff41587195");  // --resume compares it with that of rows of earlier versions
  EXPECT_NE(hash, hash_of_deal(cases, {1, 0}));
  cases[1].name = "c";
  EXPECT_NE(hash, hash_of_deal(cases, {0, 1}));
}

}  // namespace
}  // namespace pelage
