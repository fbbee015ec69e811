#include "harness/tuning/tuning_search.hpp"

#include <cmath>
#include <exception>
#include <set>

namespace pelage {
namespace {

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// Times configurations on every scene relative to the first one. `trusted` holds, for each scene, the hashes
/// of outputs that are known to be correct.
class Contest {
 public:
  Contest(const std::vector<TuningScene>& scenes, std::vector<std::set<std::uint64_t>>& trusted)
      : scenes_(scenes), trusted_(trusted) {}

  /// Returns one Candidate per configuration. The first is the incumbent, so its Candidate::ratio is 1.
  std::vector<Candidate> run(const std::vector<Tuning>& field, int rounds) {
    std::vector<Candidate> result(field.size());
    for (std::size_t i = 0; i < field.size(); ++i) result[i].tuning = field[i];
    // logs[i][r]: sum over the scenes of the logarithms of the configuration's time / the incumbent's time.
    std::vector<std::vector<double>> logs(field.size(), std::vector<double>(std::size_t(rounds), 0.0));
    for (std::size_t s = 0; s < scenes_.size(); ++s) take_turns(s, rounds, result, logs);
    for (std::size_t i = 0; i < field.size(); ++i) {
      Candidate& c = result[i];
      if (!c.fault.empty()) continue;
      for (double& x : logs[i]) x = std::exp(x / double(scenes_.size()));
      c.ratio = median(logs[i]);
      c.interval = median_interval(logs[i]);
      c.wins = i > 0 && c.interval.high < 1;
    }
    return result;
  }

 private:
  void take_turns(std::size_t s, int rounds, std::vector<Candidate>& field,
                  std::vector<std::vector<double>>& logs) {
    std::vector<std::unique_ptr<Contender>> at_work(field.size());
    const auto safely = [&](std::size_t i, const std::function<void()>& work) {
      try {
        work();
      } catch (const std::exception& error) {
        // Configuration 0 is the incumbent. Without the incumbent's times, the other configurations have no
        // ratio, so an error of the incumbent ends the search.
        if (i == 0) throw;
        field[i].fault = first_line(error.what());
        at_work[i].reset();
      }
    };
    for (std::size_t i = 0; i < field.size(); ++i)
      if (field[i].fault.empty())
        safely(i, [&] {
          at_work[i] = scenes_[s].make(field[i].tuning);
          at_work[i]->run_ms();  // the first run includes compilation and is not timed
        });
    for (int round = 0; round < rounds; ++round) {
      double incumbent_ms = 0;
      for (std::size_t i = 0; i < field.size(); ++i) {
        if (!at_work[i]) continue;
        safely(i, [&] {
          const double ms = at_work[i]->run_ms();
          if (i == 0) incumbent_ms = ms;
          logs[i][std::size_t(round)] += std::log(ms / incumbent_ms);
        });
      }
    }
    for (std::size_t i = 0; i < field.size(); ++i)
      if (at_work[i]) safely(i, [&] { verify(s, *at_work[i], field[i]); });
  }

  void verify(std::size_t s, Contender& contender, Candidate& candidate) {
    const std::uint64_t hash = contender.output_hash();
    if (trusted_[s].contains(hash)) return;
    candidate.fault = contender.fault();
    if (candidate.fault.empty())
      trusted_[s].insert(hash);
    else
      candidate.fault = scenes_[s].name + ": " + candidate.fault;
  }

  const std::vector<TuningScene>& scenes_;
  std::vector<std::set<std::uint64_t>>& trusted_;
};

Tuning with(Tuning tuning, const TuningAxis& axis, std::optional<int> value) {
  if (value)
    tuning[axis.name] = *value;
  else
    tuning.erase(axis.name);
  return tuning;
}

/// Returns the incumbent, and the configurations that differ from it in this axis only and are not yet tried.
std::vector<Tuning> field_of(const Tuning& incumbent, const TuningAxis& axis, const std::set<Tuning>& known) {
  std::vector<Tuning> field{incumbent};
  std::vector<std::optional<int>> values{std::nullopt};
  values.insert(values.end(), axis.values.begin(), axis.values.end());
  for (const auto& value : values)
    if (const Tuning candidate = with(incumbent, axis, value);
        candidate != incumbent && !known.contains(candidate))
      field.push_back(candidate);
  return field;
}

}  // namespace

TuningSearch search_tuning(const std::vector<TuningAxis>& axes, const std::vector<TuningScene>& scenes,
                           int rounds, const std::function<void(const Candidate&)>& told) {
  TuningSearch result;
  std::vector<std::set<std::uint64_t>> trusted(scenes.size());
  Contest contest(scenes, trusted);
  if (result.fault = contest.run({Tuning{}}, 1).front().fault; !result.fault.empty()) return result;

  Tuning incumbent;
  std::set<Tuning> known{incumbent};
  for (int pass = 0; pass < 2; ++pass) {
    const Tuning before = incumbent;
    for (const TuningAxis& axis : axes) {
      const std::vector<Tuning> field = field_of(incumbent, axis, known);
      if (field.size() < 2) continue;
      std::vector<Candidate> candidates = contest.run(field, rounds);
      const Candidate* best = nullptr;
      for (std::size_t i = 1; i < candidates.size(); ++i) {
        const Candidate& c = candidates[i];
        known.insert(c.tuning);
        told(c);
        result.tried.push_back(c);
        if (c.wins && (!best || c.ratio < best->ratio)) best = &c;
      }
      if (best) incumbent = best->tuning;
    }
    if (incumbent == before) break;
  }
  if (incumbent.empty()) return result;
  result.last = contest.run({Tuning{}, incumbent}, 2 * rounds).back();
  if (result.last.wins) result.best = incumbent;
  return result;
}

}  // namespace pelage
