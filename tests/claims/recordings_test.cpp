// Tests the shipped claims on the recorded rows of results/: deliberate changes to the times and metrics in
// the rows must change the verdicts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "harness/base/numbers.hpp"
#include "harness/claims/judge.hpp"
#include "harness/measure/statistics.hpp"
#include "tests/support/files.hpp"

namespace pelage::claims {
namespace {

const std::vector<FoundRow>& recordings() {
  static const std::vector<FoundRow> rows =
      read_results({(fs::path(PELAGE_SOURCE_DIR) / "results").string()});
  return rows;
}

const ClaimFile& shipped() {
  static const ClaimFile file = read_claims(fs::path(PELAGE_SOURCE_DIR) / "experiments/claims.toml");
  return file;
}

ClaimFile only(const std::string& id) {
  ClaimFile file = shipped();
  std::erase_if(file.claims, [&id](const Claim& claim) { return claim.id != id; });
  EXPECT_EQ(file.claims.size(), 1u) << id;
  return file;
}

constexpr double positive = std::numeric_limits<double>::infinity();

void scale(Row& row, const std::string& phase, double by) {
  if (std::isinf(by)) return;  // times are positive
  for (double& ms : row.samples[phase].wall_ms) ms *= by;
  for (double& ms : row.samples[phase].event_ms) ms *= by;
}

/// Returns the number that a slope of the claim is computed against: a metric, or the axis value.
double number_against(const Claim& claim, const Row& row) {
  const std::string& along = claim.along;
  if (const auto found = row.metrics.find(along); found != row.metrics.end()) return found->second.value;
  const std::string value = value_at(row.axes, claim.across.empty() ? claim.axis : claim.across);
  if (const auto size = size_from_text(value)) return double(size->width) * size->height;
  return double_of(value).value_or(1);
}

/// Multiplies the quantity of the claim by `by` in a row, as a wrong measurement would. With
/// `by` = positive, the sign of each value becomes positive.
void plant(const Claim& claim, Row& row, double by) {
  if (claim.quantity == Quantity::metric) {
    const auto found = row.metrics.find(claim.metric);
    if (found == row.metrics.end()) return;
    Metric& metric = found->second;
    if (std::isinf(by)) by = metric.value < 0 ? -1 : 1;
    metric.value *= by;
    if (metric.low) metric.low = *metric.low * by;
    if (metric.high) metric.high = *metric.high * by;
    if (by < 0 && metric.low && metric.high) std::swap(metric.low, metric.high);
  } else {
    scale(row, claim.phase.empty() ? "frame" : claim.phase, by);
  }
}

/// Changes a row so that the effect of the claim changes by about the factor `by`, or its slope by log10(by).
void plant_effect(const Claim& claim, Row& row, double by) {
  if (!claim.phases.empty()) {  // one row has the times of several axis values
    for (const auto& [phase, value] : claim.phases)
      if (claim.of.empty() ? phase == "frame" : value == claim.of.at(claim.axis)) scale(row, phase, by);
    return;
  }
  const bool slope = claim.effect == Effect::elasticity || claim.effect == Effect::ratio_trend;
  for (const auto& [axis, value] : claim.of)
    if (value_at(row.axes, axis) != value) return;
  plant(claim, row, slope ? std::pow(number_against(claim, row), std::log10(by)) : by);
}

// For each claim with a verdict, there is a change of the rows that turns the verdict into its opposite.
TEST(Recordings, PlantedWrongRowsChangeTheVerdicts) {
  std::size_t decided = 0;
  for (const Judged& before : judge(shipped(), recordings())) {
    const Claim& claim = before.claim;
    if (before.verdict == Verdict::untestable) continue;
    std::vector<FoundRow> own;
    for (const FoundRow& found : recordings())
      if (std::ranges::count(claim.experiments, found.row.experiment) > 0) own.push_back(found);
    // An undecided verdict has no opposite: a change must decide it.
    const auto turns = [&](const std::vector<FoundRow>& rows) {
      for (const Judged& after : judge(only(claim.id), rows)) {
        if (after.device != before.device) continue;
        if (after.verdict == Verdict::fails && before.verdict != Verdict::fails) return true;
        if (after.verdict == Verdict::holds && before.verdict != Verdict::holds) return true;
      }
      return false;
    };
    bool turned = false;
    for (const double by : {0.1, 10.0, 1.3, 0.7, 1e-3, 1e3, 1e-6, 1e6, 0.5, 2.0, -1.0, 0.0, positive}) {
      std::vector<FoundRow> rows = own;
      for (FoundRow& found : rows) plant_effect(claim, found.row, by);
      turned = turned || turns(rows);
      if (turned) break;
    }
    EXPECT_TRUE(turned) << claim.id << ": no planted change turns " << to_text(before.verdict);
    ++decided;
  }
  EXPECT_GE(decided, 60u);
}

TEST(Recordings, AMissingCaseMakesAClaimUntestable) {
  std::vector<FoundRow> rows = recordings();
  const std::size_t removed = std::erase_if(rows, [](const FoundRow& found) {
    return found.row.experiment == "silva2010-table1" && found.row.case_name == "lion-16-800x600";
  });
  EXPECT_GE(removed, 1u);
  EXPECT_EQ(judge(only("layers-third"), rows).front().verdict, Verdict::untestable);
}

// The shipped process_spread must not be below the relative standard deviation of the frame times of three
// processes in the recordings of topology-table1, which the comment in experiments/claims.toml must state.
TEST(Recordings, TheAssumedSpreadIsNotTooSmall) {
  std::map<std::string, std::vector<double>> logs;
  for (const auto& [row, journal, copies] : recordings())
    if (row.experiment == "topology-table1" && row.status == Status::ok)
      logs[row.case_name + row.variant].push_back(std::log(median(frame_ms(row))));
  double squares = 0, freedom = 0;
  for (const auto& [name, times] : logs) {
    const double mean = std::accumulate(times.begin(), times.end(), 0.0) / double(times.size());
    for (const double time : times) squares += (time - mean) * (time - mean);
    freedom += double(times.size()) - 1;
  }
  ASSERT_GE(freedom, 20);
  const double spread = std::sqrt(squares / freedom);
  EXPECT_LE(spread, shipped().process_spread);
  const std::string text = pelage::test::text_of(PELAGE_SOURCE_DIR "/experiments/claims.toml");
  EXPECT_NE(text.find(fmt::format("is {:.1f}%", 100 * spread)), std::string::npos) << spread;
}

}  // namespace
}  // namespace pelage::claims
