// Tests which rows decide a claim, the effect of the number of processes, and the reasons of other verdicts.
#include "harness/claims/judge.hpp"

#include "harness/claims/print.hpp"
#include "tests/claims/rows.hpp"
#include "tests/support/texts.hpp"

namespace pelage::claims {
namespace {

using namespace test;

const char* const ratio = "name = \"ratio\", axis = \"layers\", of = 64, to = 16";

std::vector<FoundRow> two_rows(double slow = 30) {
  return {row({{"layers", "16"}, {"model", "a"}}, 10), row({{"layers", "64"}, {"model", "a"}}, slow)};
}

TEST(Judge, UsesOnlyTheRowsOfTheClaim) {
  std::vector<FoundRow> rows = layers_and_models(10, 90);
  FoundRow other = row({{"layers", "64"}, {"model", "c"}}, 500);
  other.row.experiment = "other";
  rows.push_back(other);
  EXPECT_EQ(judged(rows, ratio, "{ at_most = 4 }").verdict, Verdict::fails);
  EXPECT_EQ(judged(rows, ratio, "{ at_most = 4 }", "experiment = \"own\", where = { model = \"a\" }").verdict,
            Verdict::holds);
  rows[3].row.overrides["fur.length"] = "0.1";
  EXPECT_EQ(judged(rows, ratio, "{ at_most = 4 }").verdict, Verdict::holds);
  EXPECT_EQ(judged(rows, ratio, "{ at_most = 4 }", "experiment = \"own\", overridden = true").effects, 1u)
      << "the overridden key is an axis, so that the case has no partner";
}

// A value that no row has is named, and cases that are neither `of` nor `to` give no notes.
TEST(Judge, NamesValuesThatNoRowHas) {
  std::vector<FoundRow> rows = layers_and_models();
  const auto reason = [&](const std::string& effect, const std::string& which = own) {
    return judged(rows, effect, "{ at_most = 4 }", which).reason;
  };
  EXPECT_EQ(
      reason("name = \"ratio\", of = { layers = 65 }, to = { layres = 16 }"),
      "0 of the 1 effects that decide the claim are measured; no row has layers = 65 (the rows have 16, 64); no "
      "row has the axis layres");
  pelage::test::expect_has(reason("name = \"level\"", "experiment = \"own\", where = { model = \"x\" }"),
                           "; no row has model = x (the rows have a, b)");
  FoundRow other = row({{"layers", "32"}, {"model", "a"}}, 20);
  other.row.status = Status::diverged;
  rows.push_back(other);
  EXPECT_TRUE(judged(rows, ratio, "{ at_most = 4 }").notes.empty());
}

TEST(Judge, NamesTheCasesThatAreLeftOut) {
  std::vector<FoundRow> rows = layers_and_models(10, 30);
  rows[3].row.status = Status::failed_check;
  rows[3].row.reason = "psnr 40";
  rows.push_back(rows[3]);  // of a second process
  const Judged one = judged(rows, ratio, "{ at_most = 4 }");
  EXPECT_EQ(one.verdict, Verdict::holds);
  ASSERT_EQ(one.notes.size(), 1u);
  EXPECT_EQ(one.notes[0],
            "2 left out: 64-b (failed-check: psnr 40); 16-b (there is no matching case with layers = 64)");
  const Judged two = judged(rows, ratio, "{ at_most = 4 }", "experiment = \"own\", cases = 2");
  EXPECT_EQ(two.verdict, Verdict::untestable);
  EXPECT_EQ(two.reason, "1 of the 2 effects that decide the claim are measured");
  EXPECT_FALSE(two.value.has_value());
  EXPECT_EQ(two.processes, 0u);
  std::vector<FoundRow> twice = {two_rows()[0], two_rows()[1], two_rows()[1]};
  twice.back().row.case_name = "again";
  EXPECT_EQ(judged(twice, ratio, "{ at_most = 4 }").notes.at(0),
            "1 left out: 16-a (several cases differ only in their names, so the claim cannot select one)");
  const std::vector<FoundRow> zero = {row({{"layers", "0"}}, 5), row({{"layers", "1"}}, 10),
                                      row({{"layers", "64"}}, 30)};
  EXPECT_EQ(judged(zero, "name = \"elasticity\", axis = \"layers\"", "{ at_least = 0 }").notes.at(0),
            "1 left out: 0 (its layers is not a number above 0)");
  for (FoundRow& failed : rows) failed.row.status = Status::failed_check;
  const Judged none = judged(rows, ratio, "{ at_most = 4 }");
  EXPECT_EQ(none.notes.at(0),
            "4 left out: 16-a (failed-check); 64-a (failed-check); 16-b (failed-check); and 1 more");
  EXPECT_EQ(none.reason, "0 of the 1 effects that decide the claim are measured");
}

TEST(Judge, SaysWhyAClaimIsUntestable) {
  const auto reason = [](const std::vector<FoundRow>& rows, const std::string& text) {
    const Judged one = judge(file_of(text), rows).front();
    EXPECT_EQ(one.verdict, Verdict::untestable);
    return one.reason;
  };
  EXPECT_EQ(reason({}, claim_text(ratio, "{ at_most = 4 }")), "there are no rows of the experiment own");
  EXPECT_EQ(reason(two_rows(), "[[claim]]\nid = \"c\"\nstatement = \"s\"\nuntestable = \"no strands\"\n"),
            "no strands");
  EXPECT_EQ(reason(two_rows(),
                   claim_text(ratio, "{ at_most = 4 }", "experiment = \"own\", where = { model = \"z\" }")),
            "0 of the 1 effects that decide the claim are measured; no row has model = z (the rows have a)");
  EXPECT_EQ(reason(two_rows(), claim_text(ratio, "{ at_most = 4 }") + "hardware = \"GeForce\"\n"),
            "the claim is about the paper's hardware (GeForce)");
  EXPECT_EQ(judged(two_rows(), ratio, "{ at_most = 4 }\nhardware = \"dev\"").verdict, Verdict::holds);
  EXPECT_EQ(reason({two_rows()[0], two_rows()[1], two_rows(0)[1]},
                   claim_text("name = \"elasticity\", axis = \"layers\"", "\"decreasing\"")),
            "the effect is not a finite number, because a quantity is 0, negative or not finite");
}

TEST(Judge, RefusesTooManySeparateDecisions) {
  std::vector<FoundRow> rows;
  for (std::size_t i = 0; i <= most_effects; ++i) rows.push_back(row({{"model", std::to_string(i)}}, 10));
  EXPECT_EQ(
      judged(rows, "name = \"level\"", "{ at_most = 20 }").reason,
      "201 effects are too many for separate decisions (at most 200); narrow `where`, or combine the effects");
  EXPECT_EQ(judged(rows, "name = \"level\", combine = \"mean\"", "{ at_most = 20 }").verdict, Verdict::holds);
  rows.pop_back();
  for (FoundRow& one : rows) one.row.metrics["masses"] = {10, "masses"};  // is drawn in less time
  const std::string masses = "name = \"level\", quantity = \"metric\", metric = \"masses\"";
  EXPECT_EQ(judged(rows, masses, "{ at_most = 20 }").effects, most_effects);
}

TEST(Judge, JudgesEveryDeviceAlone) {
  std::vector<FoundRow> rows = two_rows(30), other = two_rows(90);
  for (FoundRow& one : other) one.row.device = "another";
  rows.insert(rows.end(), other.begin(), other.end());
  const std::vector<Judged> both = judge(file_of(claim_text(ratio, "{ at_most = 4 }")), rows);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].device, "another");
  EXPECT_EQ(both[0].verdict, Verdict::fails);
  EXPECT_EQ(both[1].verdict, Verdict::holds);
  pelage::test::expect_has(markdown_of(both), {"| c, shape, another | s |", "| c, shape, device | s |"});
}

// Times of a loaded machine decide nothing, unless other times give the same verdict.
TEST(Judge, RowsOfALoadedMachineDoNotDecide) {
  std::vector<FoundRow> rows = layers_and_models();  // the ratios are 3 and 2
  const auto verdict = [&](const std::string& limit) { return judged(rows, ratio, limit).verdict; };
  EXPECT_EQ(verdict("{ at_most = 2.5 }"), Verdict::fails);
  EXPECT_EQ(verdict("{ at_most = 4 }"), Verdict::holds);
  rows[1].row.provenance["other_cpu_share"] = 0.5;  // of the model a, whose ratio is 3
  EXPECT_EQ(verdict("{ at_most = 2.5 }"), Verdict::undecided);
  EXPECT_EQ(verdict("{ at_most = 4 }"), Verdict::undecided);
  EXPECT_EQ(verdict("{ at_most = 1.5 }"), Verdict::fails) << "the model b alone decides";
  EXPECT_EQ(verdict("{ at_least = 1.5 }"), Verdict::holds) << "the model b is nearer to the limit";
  EXPECT_EQ(judged(rows, ratio, "{ at_most = 4 }").reason,
            "the rows that decide were measured while other processes used the CPU; measure them again");
}

// The times of one process vary by 1% and do not show the spread between processes, which judge() assumes.
TEST(Judge, OneProcessDoesNotDecideASmallDifference) {
  const auto with = [](const std::string& limit, const std::vector<FoundRow>& rows) {
    return judged(rows, ratio, limit, own, some_spread);
  };
  const Judged one = with("{ at_most = 3.2 }", two_rows());
  EXPECT_EQ(one.verdict, Verdict::undecided);
  EXPECT_EQ(one.processes, 1u);
  pelage::test::expect_has(one.reason, {"1 of the 3 processes that are needed", "times vary by 7% between"});
  EXPECT_EQ(with("{ at_most = 4 }", two_rows()).verdict, Verdict::holds);
  // Each of the two times has the assumed relative spread 0.07, so the standard deviation of the ratio's
  // logarithm is 0.07 * sqrt(2) = 0.099. The ratio is 3, so its interval is 3 * exp(+-1.96 * 0.099).
  EXPECT_NEAR(one.interval.low, 2.47, 0.05);
  EXPECT_NEAR(one.interval.high, 3.64, 0.07);
  EXPECT_EQ(one.interval.high, with("{ at_most = 3.2 }", two_rows()).interval.high) << "the same numbers";
  std::vector<FoundRow> three;
  for (const char* run : {"r1", "r2", "r3"}) {
    three.push_back(row({{"layers", "16"}, {"model", "a"}}, 10, run));
    three.push_back(row({{"layers", "64"}, {"model", "a"}}, 30, run));
  }
  const Judged enough = with("{ at_most = 3.2 }", three);
  EXPECT_EQ(enough.verdict, Verdict::holds);
  EXPECT_EQ(enough.processes, 3u);
}

// Three processes measure 8, 10 and 13 ms. The interval must be as wide as this variation between processes.
TEST(Judge, SeparateProcessesShowTheirSpread) {
  std::vector<FoundRow> rows;
  const std::pair<const char*, double> runs[] = {{"r1", 8}, {"r2", 10}, {"r3", 13}};
  for (const auto& [run, ms] : runs) rows.push_back(row({{"model", "a"}}, ms, run));
  const Judged one = judged(rows, "name = \"level\"", "{ at_most = 12 }");
  EXPECT_EQ(one.verdict, Verdict::undecided);
  EXPECT_EQ(one.reason, "the interval contains a limit of the relation");
  EXPECT_EQ(one.decisive, "") << "there are no other effects";
  EXPECT_LT(one.interval.low, 8.2);
  EXPECT_GT(one.interval.high, 12.5);
}

// Both phases belong to the same process. A factor that changes all times of this process cancels in the
// ratio of the phases.
TEST(Judge, PhasesInTurnsShareTheirProcess) {
  FoundRow one = row({{"model", "a"}}, 30);
  one.row.samples["quarter"].wall_ms = one.row.samples["frame"].wall_ms;
  for (double& ms : one.row.samples["quarter"].wall_ms) ms /= 3;
  const Judged turns = judged(
      {one}, "name = \"ratio\", axis = \"layers\", phases = { frame = 64, quarter = 16 }, of = 64, to = 16",
      "{ at_most = 3.05 }", own, some_spread);
  EXPECT_EQ(turns.verdict, Verdict::holds);
  EXPECT_NEAR(turns.interval.high, 3, 1e-6);
  const auto share = [&] {
    return judged({one}, "name = \"level\", quantity = \"phase-share\", phase = \"quarter\"",
                  "{ at_most = 1 }", own, some_spread);
  };
  EXPECT_NEAR(share().interval.high, 1.0 / 3, 1e-9);
  one.row.samples["quarter"].wall_ms.resize(3);
  EXPECT_NEAR(share().interval.high, 1.0 / 3, 0.01) << "drawn apart from the frames";
}

TEST(Judge, CountsAreExactAndMeasuredMetricsAreNot) {
  FoundRow one = row({{"model", "a"}}, 30);
  one.row.metrics["masses"] = {100, "masses", "=", 99.0, 101.0};  // limits of rounding, no 95% interval
  one.row.metrics["wet_ms"] = {100, "ms"};
  const auto level = [&](const std::string& metric) {
    return judged({one}, "name = \"level\", quantity = \"metric\", metric = \"" + metric + "\"",
                  "{ at_most = 101 }", own, some_spread);
  };
  EXPECT_EQ(level("masses").verdict, Verdict::holds);
  EXPECT_EQ(level("masses").interval.high, 100);
  EXPECT_EQ(level("wet_ms").verdict, Verdict::undecided);
  EXPECT_NEAR(level("wet_ms").interval.high, 114, 2);
}

TEST(Judge, MarksRowsOfALoadedMachine) {
  std::vector<FoundRow> rows = two_rows();
  rows[0].row.provenance["other_cpu_share"] = 0.5;
  const Judged one = judged(rows, ratio, "{ at_most = 4 }");
  EXPECT_EQ(one.notes, std::vector<std::string>{"1 rows were measured while other processes used the CPU"});
}

TEST(Printing, ShowsEffectIntervalVerdictAndReason) {
  const std::vector<Judged> list = judge(
      file_of(claim_text(ratio, "{ at_most = 4 }") +
              "[[claim]]\nid = \"none\"\nstatement = \"a | b\"\nsource = { paper = \"p\", section = \"2\" }\n"
              "untestable = \"no rows, yet\"\n"),
      two_rows());
  const auto table = table_of(list);
  ASSERT_EQ(table.size(), 3u);
  for (const auto& line : table) EXPECT_EQ(line.size(), table[0].size());
  EXPECT_EQ(table[1][1], "holds");
  EXPECT_EQ(table[2][12], "") << "an untestable claim has no effect";
  const auto json = json_of(list);
  EXPECT_NEAR(json[0]["effect"].get<double>(), 3, 1e-9);
  EXPECT_TRUE(json[1]["effect"].is_null());
  EXPECT_EQ(json[1]["reason"], "no rows, yet");
  pelage::test::expect_has(markdown_of(list), "| none, shape | a \\| b | p, section 2 |");
}

TEST(Printing, ShowsOnlyWhatIsKnown) {
  Judged two = judged(two_rows(), "name = \"level\", combine = \"mean\"", "{ at_most = 4 }"), missing;
  two.value = 3;
  two.interval = {2, 4.5};
  Judged one = two, full = two;
  one.effects = 1;
  full.claim.test = full.claim.paper = "p";
  full.claim.reading = "paper";
  full.decisive = "lion";
  full.paper_value = 1;
  full.reason = "why";
  full.notes = {"n"};
  missing.no_rows = true;
  missing.claim.experiments = {"e"};
  const std::string same = "    frame time; mean over the cases: 3 [2, 4.5]";
  EXPECT_EQ(text_of({full, one, two, missing}, false),
            "Device device on h\nfails      c  (shape; p, reading paper)\n    s\n    test: p\n" + same +
                " for lion; 2 effects from 10 to 30; the claim: at most 4; the paper's numbers: 1\n"
                "    fails: why\n    note: n\n"
                "fails      c  (shape; ours)\n    s\n" +
                same + "; the claim: at most 4\nfails      c  (shape; ours)\n    s\n" + same +
                ", from 2 effects; the claim: at most 4\n"
                "1 claim needs rows of these experiments, which have no rows here: e; --all lists it\n"
                "Claims of papers, 1: 0 holds, 1 fails, 0 undecided, 0 untestable\n"
                "Claims of our own, 3: 0 holds, 2 fails, 0 undecided, 1 untestable\n");
  EXPECT_EQ(
      text_of({missing}, true),
      "untestable   (shape; ours)\n    \nClaims of our own, 1: 0 holds, 0 fails, 0 undecided, 1 untestable\n");
}

}  // namespace
}  // namespace pelage::claims
