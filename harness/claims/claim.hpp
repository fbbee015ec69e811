// A claim: a sentence of a paper, or of a user, that rows of results can confirm or refute. docs/claims.md
// describes the file format, the kinds of effects and the verdicts.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pelage::claims {

/// The number that a claim uses for each case.
enum class Quantity {
  frame_time,   ///< median wall time of a frame, ms
  frame_rate,   ///< 1000 / frame_time, frames per second
  phase_time,   ///< median time of a phase, ms: wall time, or event time if the phase has no wall time
  phase_share,  ///< phase_time / frame_time, 0 to 1
  metric        ///< a metric of the rows, in its own unit
};

/// The number that is computed from the quantities of the cases and compared with the limit.
enum class Effect {
  level,           ///< the quantity of a case
  ratio,           ///< quantity of the case `of` divided by that of the matching case `to`
  ratio_by_phase,  ///< 1 + (phase time of `of` - phase time of `to`) / frame time of `to`
  elasticity,      ///< slope of the logarithm of the quantity against the logarithm of the axis
  linearity,       ///< slope in the upper part of the axis, divided by the slope in the lower part
  ratio_trend,     ///< slope of the logarithm of `ratio` against the logarithm of another axis
  share_of_cases   ///< share of the cases whose quantity is at least `threshold`, 0 to 1
};

/// How the effects of several cases become a verdict.
enum class Combine {
  every,           ///< the relation must hold for the effect of every case
  geometric_mean,  ///< the relation must hold for the geometric mean of the effects
  mean,
  median
};

/// The values of an effect for which the claim is true.
struct Region {
  std::optional<double> low = {}, high = {};
  bool strict = false;  ///< true if the limits themselves do not belong to the region
  bool contains(double value) const;
  bool contains(double from, double to) const;  ///< whether all values from `from` to `to` belong to it
  bool outside(double from, double to) const;   ///< whether no value from `from` to `to` belongs to it
};

struct Claim {
  std::string id;         ///< unique in its file
  std::string statement;  ///< in our own words
  std::string reading;    ///< how the statement was translated into the relation; may be empty
  std::string paper;      ///< key of the paper in CITATION and references.bib; may be empty
  std::string section;    ///< place in the paper; may be empty
  bool absolute = false;  ///< true if the claim depends on the speed of the hardware
  /// Why no row of pelage can decide the claim. If it is not empty, the claim has none of the keys below.
  std::string untestable;
  /// Part of the name of the only device whose rows decide the claim; empty if every device may decide it.
  std::string hardware;

  std::vector<std::string> experiments;
  std::map<std::string, std::vector<std::string>> where;  ///< axis -> values of the cases that are used
  bool overridden = false;                                ///< true if rows with overrides are used too
  Quantity quantity = Quantity::frame_time;
  std::string phase;   ///< for phase_time, phase_share and ratio_by_phase
  std::string metric;  ///< for Quantity::metric
  std::string per;     ///< metric by which the quantity is divided; may be empty
  /// Phase -> value of `axis`. If it is not empty, each row gives one case per phase. The quantity of this
  /// case is computed from the times of the phase. Such cases were measured alternately in one process.
  std::map<std::string, std::string> phases;
  Effect effect = Effect::level;
  std::string axis, of, to;
  std::string along;   ///< metric that measures the axis; if empty, the numbers of the axis
  std::string across;  ///< for ratio_trend: the axis against which the ratio changes
  double threshold = 0;
  Combine combine = Combine::every;
  std::string relation;  ///< the relation with its limits, as text: "at most 0.5"
  Region region;
  std::size_t cases = 1;      ///< smallest number of effects that decide the claim
  double process_spread = 0;  ///< see ClaimFile
};

struct ClaimFile {
  std::filesystem::path file;
  /// Relative standard deviation of times between processes. It is assumed for cases that were measured by
  /// fewer than `separate_processes` processes, because their rows do not show this spread.
  double process_spread = 0.07;
  int separate_processes = 3;
  std::vector<Claim> claims;  ///< in the order of the file
};

/// Returns the text of the effect, for instance "frame rate, layers 64 : 16, geometric mean".
std::string description_of(const Claim& claim);

}  // namespace pelage::claims
