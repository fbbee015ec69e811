// Tests the shipped claims on the recorded rows of results/: deliberate changes to the times and metrics in
// the rows must change the verdicts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <set>

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

void scale(Row& row, const std::string& phase, double by) {
  for (double& ms : row.samples[phase].wall_ms) ms *= by;
  for (double& ms : row.samples[phase].event_ms) ms *= by;
}

bool is(const Row& row, const std::string& axis, const std::string& value) {
  return value_at(row.axes, axis) == value;
}

bool separable(const Row& row) {
  return value_at(row.axes, "dynamics.topology").starts_with("separable");
}

/// A deliberate change to the rows, and the verdict that the claim must have after the change.
struct Plant {
  std::string claim;
  Verdict verdict;
  std::function<void(Row&)> change;
};

/// Returns a change that multiplies the times of `phase` by the factor `by`, in all rows of cases in which
/// the parameter `axis` has the value `value`.
std::function<void(Row&)> times(const std::string& axis, const std::string& value, const std::string& phase,
                                double by) {
  return [=](Row& row) {
    if (is(row, axis, value)) scale(row, phase, by);
  };
}

std::function<void(Row&)> all_times(const std::string& phase, double by) {
  return [=](Row& row) { scale(row, phase, by); };
}

/// Returns a change that sets a metric to the result of `change`, which receives the row and the old value.
std::function<void(Row&)> metric(const std::string& name,
                                 const std::function<double(const Row&, double)>& change) {
  return [=](Row& row) {
    if (const auto found = row.metrics.find(name); found != row.metrics.end())
      found->second.value = change(row, found->second.value);
  };
}

/// Multiplies the frame times of pictures of 1680 x 1050 pixels by a factor proportional to the number of
/// triangles.
void large_by_triangles(Row& row) {
  if (is(row, "size", "1680x1050")) scale(row, "frame", row.metrics["triangles"].value / 9360);
}

/// Returns a change of a metric: multiplies it by `by` in the rows of the variant `strands`.
std::function<double(const Row&, double)> of_strands(double by) {
  return [=](const Row& row, double v) { return is(row, "variant", "strands") ? by * v : v; };
}

/// Returns a change for the rows of the effect `reading`: it multiplies their ratio to plain shells by `by`.
std::function<void(Row&)> overhead_of(const std::string& reading, double by) {
  return metric("frame_over_baseline",
                [=](const Row& row, double v) { return is(row, "reading", reading) ? by * v : v; });
}

std::vector<Plant> plants() {
  const auto holds = Verdict::holds, fails = Verdict::fails;
  const auto shared = [](const Row& row, double value) { return separable(row) ? value / 10 : value; };
  return {{"topology-masses", fails, metric("masses", shared)},
          {"topology-springs", fails, metric("springs", shared)},
          {"elephant-masses", fails, metric("masses", [](const Row&, double v) { return v + 1; })},
          {"elephant-springs", fails, metric("springs", [](const Row&, double v) { return v - 1; })},
          {"time-separable-sticks", fails, times("dynamics.topology", "separable-sticks", "simulate", 0.05)},
          {"time-separable-prisms", holds, times("dynamics.topology", "separable-prisms", "simulate", 4)},
          {"drawing-dominates", fails, all_times("simulate", 1000)},
          {"drawing-bottleneck", fails, times("model", "banisch-grass", "simulate", 1e5)},
          {"dog-sticks", fails, times("model", "banisch-dog", "simulate", 1000)},
          {"grass-drawing", fails, times("model", "banisch-grass", "simulate", 1e4)},
          {"grass-topologies", fails, times("dynamics.topology", "separable-prisms", "frame", 2)},
          {"grass-implicit", fails, times("variant", "backward-euler", "simulate", 1e5)},
          {"elephant-implicit", fails, times("variant", "backward-euler", "simulate", 1e4)},
          {"implicit-cost", fails, times("variant", "backward-euler", "frame", 0.2)},
          {"implicit-stability", fails,
           metric("longest_step_ms",
                  [](const Row& row, double v) {
                    return is(row, "dynamics.solver", "backward-euler") ? v / 1e5 : v;
                  })},
          {"explicit-accuracy", fails,
           metric("error_rms",
                  [](const Row& row, double v) {
                    return is(row, "dynamics.solver", "explicit-euler") ? v / 10 : v;
                  })},
          {"elephant-implicit-equal-steps", fails, times("variant", "backward-euler", "simulate", 1e4)},
          {"returns", holds, metric("lean_median", [](const Row&, double) { return 0.5; })},
          {"no-flip", holds, metric("height_least", [](const Row&, double) { return 0.5; })},
          {"no-flip-below-w", fails, metric("height_least", [](const Row&, double) { return -0.5; })},
          {"parting", fails, metric("gap_most", [](const Row&, double) { return 0.0; })},
          {"elephant-real-time", fails, times("dynamics.topology", "prisms", "frame", 50)},
          {"separable-interactive", fails, times("dynamics.topology", "separable-prisms", "frame", 50)},
          {"dog-interactive", fails, times("dynamics.topology", "sticks", "frame", 50)},
          {"layers-third", fails, times("layers", "64", "frame", 2)},
          {"layers-third-in-turns", fails, all_times("quarter", 2)},
          {"layers-linear", fails, all_times("frame", 2)},
          {"layers-proportional", holds, times("layers", "64", "frame", 1.24)},
          {"layers-always", fails, times("layers", "16", "frame", 10)},
          {"resolution-sublinear", fails, times("size", "1680x1050", "frame", 5)},
          {"resolution-triangles", fails, large_by_triangles},
          {"triangles-proportional", holds,
           [](Row& row) { scale(row, "frame", row.metrics["triangles"].value / 9360); }},
          {"real-time", holds, all_times("frame", 0.05)},
          {"effects-overhead", fails, times("reading", "default", "frame", 2)},
          {"effects-overhead-opengl", holds, times("reading", "default", "opengl", 0.6)},
          {"clumps-cost", fails, times("reading", "default", "opengl", 0.5)},
          {"curl-overhead", fails, overhead_of("curl", 2)},
          {"clump-overhead", holds, overhead_of("clump", 0.5)},
          {"all-overhead", holds, overhead_of("all", 0.5)},
          {"mask-in-frame", fails, overhead_of("mask", 2)},
          {"wet-resolution-triangles", fails, large_by_triangles},
          {"wet-real-time", holds, all_times("frame", 0.01)},
          {"wet-large-mesh", holds, all_times("frame", 0.01)},
          {"dynamic-mask", fails, metric("wet_ms", [](const Row&, double v) { return v + 100; })},
          {"strands-overdraw", fails, metric("overdraw", of_strands(2))},
          {"strands-frame-time", fails, times("variant", "strands", "frame", 4)},
          {"strands-variety", fails, metric("raycast_coarse_psnr", of_strands(0.5))},
          {"strands-simulation", holds, all_times("simulate", 0.1)},
          {"strands-simulation-cost", holds, metric("simulate_ns_per_segment", of_strands(0.1))},
          {"strands-detail", fails, times("variant", "pruned", "frame", 4)},
          {"strands-detail-picture", holds,
           metric("raycast_coarse_psnr", [](const Row&, double v) { return v + 9; })},
          {"strands-detail-width", fails, metric("raycast_coarse_psnr", [](const Row& row, double v) {
             return is(row, "variant", "least-width") ? 0.9 * v : v;
           })}};
}

TEST(Recordings, PlantedWrongRowsChangeTheVerdicts) {
  std::size_t changed = 0;
  for (const Plant& plant : plants()) {
    const ClaimFile file = only(plant.claim);
    const Verdict before = judge(file, recordings()).front().verdict;
    if (before == Verdict::untestable) continue;  // results/ has no rows of the experiment
    std::vector<FoundRow> rows = recordings();
    for (FoundRow& found : rows)
      if (found.row.experiment == file.claims[0].experiments[0]) plant.change(found.row);
    const Judged after = judge(file, rows).front();
    EXPECT_EQ(to_text(after.verdict), to_text(plant.verdict)) << plant.claim << ": " << after.reason;
    EXPECT_NE(to_text(before), to_text(after.verdict)) << plant.claim;
    changed += after.verdict != before;
  }
  EXPECT_GE(changed, 30u);
}

TEST(Recordings, EveryDecidedClaimIsPlanted) {
  std::set<std::string> planted;
  for (const Plant& plant : plants()) planted.insert(plant.claim);
  std::size_t decided = 0;
  for (const Judged& judged : judge(shipped(), recordings())) {
    if (judged.verdict == Verdict::untestable) continue;
    ++decided;
    EXPECT_TRUE(planted.contains(judged.claim.id)) << judged.claim.id;
  }
  EXPECT_GE(decided, 18u);
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
