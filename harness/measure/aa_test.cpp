#include "harness/measure/aa_test.hpp"

#include <fmt/format.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>

namespace pelage {
namespace {

std::string_view to_text(Side side) {
  switch (side) {
    case Side::below:
      return "faster";
    case Side::within:
      return "same";
    case Side::above:
      return "slower";
    case Side::undecided:
      break;
  }
  return "undecided";
}

}  // namespace

Trial run_trial(const TimeRound& time_round, const TrialLimits& limits, std::mt19937_64& random) {
  Timings of_a, of_b;
  for (int round = 0; round < limits.rounds; ++round) {
    RoundTimes times = time_round((random() & 1) != 0);
    of_a.started_s.push_back(times.a_started_s);
    of_b.started_s.push_back(times.b_started_s);
    of_a.processes.push_back(std::move(times.a));
    of_b.processes.push_back(std::move(times.b));
  }
  const Difference difference = difference_of(of_a, of_b);
  return {difference, decide(std::span(&difference, 1), limits.threshold, limits.alpha).front()};
}

TrialCounts count_of(std::span<const Trial> trials) {
  TrialCounts counts;
  for (const Trial& trial : trials) {
    counts.faster += trial.decision.side == Side::below;
    counts.slower += trial.decision.side == Side::above;
    counts.same += trial.decision.side == Side::within;
    counts.undecided += trial.decision.side == Side::undecided;
  }
  return counts;
}

Interval rate_interval(int hits, int all) {
  using Binomial = boost::math::binomial_distribution<double>;
  return {hits == 0 ? 0 : Binomial::find_lower_bound_on_p(all, hits, 0.025),
          hits == all ? 1 : Binomial::find_upper_bound_on_p(all, hits, 0.025)};
}

std::string trials_csv_header() {
  return "side,change,low,high,p,paired,verdict\n";
}

std::string trials_csv(const std::string& side, std::span<const Trial> trials) {
  std::string text;
  for (const Trial& t : trials)
    text += fmt::format("{},{:.6f},{:.6f},{:.6f},{:.6g},{},{}\n", side, std::expm1(t.difference.log_ratio),
                        t.decision.ratio.low - 1, t.decision.ratio.high - 1, t.decision.p,
                        int(t.difference.paired), to_text(t.decision.side));
  return text;
}

}  // namespace pelage
