// Tests run_states(), which finds the shards and cases of a run that have no rows.
#include "harness/record/shards.hpp"

#include "tests/support/fake.hpp"

namespace pelage {
namespace {

/// A run of 6 cases in 3 shards. Cases 0 and 3 belong to shard 0, cases 1 and 4 to shard 1, and cases 2 and 5
/// to shard 2.
struct FakeRun {
  int count = 3;
  std::vector<fs::path> journals;
  std::vector<FoundRow> rows;

  void add(int shard, const std::vector<int>& cases, const std::string& host = "node1",
           bool recorded = true) {
    const fs::path journal =
        "shard/own/gpu@" + host + "." + std::to_string(shard) + "-of-" + std::to_string(count) + ".jsonl";
    journals.push_back(journal);
    for (const int i : cases) {
      Row row = test::sample_row("case" + std::to_string(i));
      row.experiment = "own";
      if (recorded)
        row.provenance = {{"shard", std::to_string(shard) + "/" + std::to_string(count)},
                          {"shard_cases", 2},
                          {"all_cases", 6},
                          {"repeats", 1},
                          {"shard_deal", "d"}};
      rows.push_back({row, journal});
    }
  }
  std::vector<std::string> gaps() const {
    std::vector<std::string> texts;
    for (const RunState& state : run_states(journals, rows))
      for (const Gap& gap : state.gaps) texts.push_back(state.where + " " + text_of(gap));
    return texts;
  }
};

using Texts = std::vector<std::string>;

TEST(Shards, TheNameOfAJournalHoldsItsShard) {
  const JournalName name = journal_name("a/own/gpu@node.1-of-3.jsonl");
  EXPECT_EQ(name.stem, "gpu@node");
  EXPECT_EQ(name.index, 1);
  EXPECT_EQ(name.count, 3);
  EXPECT_EQ(journal_name("own/gpu@node.local.jsonl").stem, "gpu@node.local");
  EXPECT_EQ(journal_name("own/gpu@node.local.jsonl").count, 1);
  EXPECT_EQ(journal_name("own/gpu@node.3-of-3.jsonl").stem, "gpu@node.3-of-3");
  EXPECT_EQ(journal_name("own/.0-of-3.jsonl").count, 1);
}

TEST(Shards, ACompleteRunHasNoGap) {
  FakeRun run;
  for (int shard = 0; shard < 3; ++shard) run.add(shard, {shard, shard + 3});
  EXPECT_EQ(run.gaps(), Texts{});
  EXPECT_FALSE(run_states(run.journals, run.rows).front().dealt_differently);
}

TEST(Shards, LostShardsAndMissingCasesAreNamed) {
  FakeRun run;
  run.add(0, {0, 3});
  run.add(2, {5});
  EXPECT_EQ(run.gaps(), (Texts{"gpu@node1 shard 1/3: no rows", "gpu@node1 shard 2/3: 1 of 2 cases"}));
  run.rows.back().row.status = Status::error;
  run.add(2, {2});
  EXPECT_EQ(run.gaps(), (Texts{"gpu@node1 shard 1/3: no rows",
                               "gpu@node1 shard 2/3: 1 of 2 cases, 1 ended with an error"}));
}

TEST(Shards, AJournalWithoutRowsHasAGap) {
  FakeRun run;
  run.count = 2;
  run.add(0, {0, 3});
  run.add(1, {}, "node2");
  run.journals.push_back("shard/own/cpu@node1.1-of-2.jsonl");  // of another device
  EXPECT_EQ(run.gaps(), (Texts{"gpu@node1+node2 shard 1/2: no rows"}));
}

// If a run has more shards than cases, some shards have no case.
TEST(Shards, AShardWithoutCasesHasNoGap) {
  FakeRun run;
  run.add(0, {0});
  run.add(1, {1});
  run.add(2, {});
  for (FoundRow& found : run.rows) {
    found.row.provenance["shard_cases"] = 1;
    found.row.provenance["all_cases"] = 2;
  }
  EXPECT_EQ(run.gaps(), Texts{});
  for (FoundRow& found : run.rows) found.row.provenance["all_cases"] = 3;
  EXPECT_EQ(run.gaps(), (Texts{"gpu@node1 shard 2/3: no rows"}));
}

TEST(Shards, ShardsOfSeveralHostsAreOneRunUnlessAHostHasAll) {
  FakeRun run;
  run.add(0, {0, 3}, "node1");
  run.add(1, {1, 4}, "node2");
  run.add(2, {2}, "node3");
  EXPECT_EQ(run.gaps(), (Texts{"gpu@node1+node2+node3 shard 2/3: 1 of 2 cases"}));
  run.add(2, {5}, "node1");  // the missing case was measured on another host
  EXPECT_EQ(run.gaps(), Texts{});
  for (int shard = 0; shard < 3; ++shard) run.add(shard, {shard, shard + 3}, "node4");
  run.add(0, {0, 3}, "node5");
  run.rows.erase(run.rows.begin(), run.rows.begin() + 6);  // removes the rows of node1, node2 and node3
  run.journals.erase(run.journals.begin(), run.journals.begin() + 4);
  EXPECT_EQ(run.gaps(), (Texts{"gpu@node5 shard 1/3: no rows", "gpu@node5 shard 2/3: no rows"}));
}

TEST(Shards, RowsOfOlderVersionsTellOnlyWhichShardsExist) {
  FakeRun run;
  run.add(0, {0}, "node1", false);
  run.add(2, {2}, "node1", false);
  run.rows.back().row.status = Status::error;
  EXPECT_EQ(run.gaps(),
            (Texts{"gpu@node1 shard 1/3: no rows", "gpu@node1 shard 2/3: 0 cases, 1 ended with an error"}));
  for (FoundRow& found : run.rows)
    found.row.provenance = {{"shard", 1}, {"shard_cases", 1}, {"all_cases", -1}, {"repeats", "two"}};
  run.rows.front().row.provenance["shard"] = "3/3";
  EXPECT_EQ(run.gaps(), (Texts{"gpu@node1 shard 1/3: no rows",
                               "gpu@node1 shard 2/3: 0 of 1 cases, 1 ended with an error"}));
}

TEST(Shards, EachProcessOfRepeatCounts) {
  FakeRun run;
  run.add(0, {0, 3});
  for (FoundRow& found : run.rows) {
    found.row.provenance["shard"] = "0/1";
    found.row.provenance["all_cases"] = 2;
    found.row.provenance["repeats"] = 2;
  }
  EXPECT_EQ(run.gaps(), (Texts{"gpu@node1 run: 2 of 4 cases"}));
}

// With --balance, each shard divides the cases by the times of earlier runs. Shard 1 did not use the same
// earlier runs as the others and measured case 3 instead of case 4, so that no shard has case 4.
TEST(Shards, ACaseThatBelongsToNoShardIsAGap) {
  FakeRun run;
  run.add(0, {0, 3});
  run.add(1, {1, 3});
  run.add(2, {2, 5});
  run.rows[2].row.provenance["shard_deal"] = "e";
  EXPECT_EQ(run.gaps(), (Texts{"gpu@node1 whole run: 5 of 6 cases"}));
  EXPECT_TRUE(run_states(run.journals, run.rows).front().dealt_differently);
}

TEST(Shards, RunsWithOtherOverridesAreCountedApart) {
  FakeRun run;
  for (int shard = 0; shard < 3; ++shard) run.add(shard, {shard, shard + 3});
  run.add(0, {0, 3});
  run.rows[6].row.overrides = run.rows[7].row.overrides = {{"fur.length", "0.1"}};
  const std::vector<RunState> states = run_states(run.journals, run.rows);
  ASSERT_EQ(states.size(), 2u);
  EXPECT_TRUE(states[0].gaps.empty());
  EXPECT_EQ(states[1].gaps.size(), 2u);
  EXPECT_EQ(states[1].done, (std::set<std::string>{"case0", "case3"}));
}

}  // namespace
}  // namespace pelage
