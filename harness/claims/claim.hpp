// A claim is a statement of a paper or of a user, which rows of results can confirm or refute.
// docs/experiments.md describes the file format, the kinds of effects and the verdicts.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pelage::claims {

/// The quantity of a case that a claim evaluates.
enum class Quantity {
  frame_time,   ///< median wall time of a frame, ms
  frame_rate,   ///< 1000 / frame_time, frames per second
  phase_time,   ///< median time of a phase, ms: wall time, or event time if the phase has no wall time
  phase_share,  ///< phase_time / frame_time, 0 to 1
  metric        ///< a metric of the row, in the unit of this metric
};

/// The number that is computed from the quantities of cases and compared with the limits of the claim.
enum class Effect {
  level,           ///< the quantity of a case
  ratio,           ///< quantity of the case `of`, divided by the quantity of the case `to`
  ratio_by_phase,  ///< 1 + (phase time of `of` - phase time of `to`) / frame time of `to`
  elasticity,      ///< slope of the logarithm of the quantity against the logarithm of the axis value
  linearity,       ///< slope of the quantity above the middle axis value / slope below this value
  ratio_trend,     ///< slope of log(`ratio`) against log(value of the axis Claim::across)
  share_of_cases   ///< share of the cases whose quantity is at least `threshold`, 0 to 1
};

/// How the effects of several cases decide the claim.
enum class Combine {
  every,           ///< every effect must be inside Claim::region
  geometric_mean,  ///< the geometric mean of the effects must be inside Claim::region
  mean,
  median
};

/// The values of an effect for which the claim holds, possibly without a lower or an upper limit.
struct Region {
  std::optional<double> low = {}, high = {};
  bool strict = false;  ///< true if `low` and `high` themselves are outside the region
  bool contains(double value) const;
  bool contains(double from, double to) const;  ///< whether all values from `from` to `to` are inside
  bool outside(double from, double to) const;   ///< whether all values from `from` to `to` are outside
};

/// Axis -> value. A case is selected if it has all of these values.
using Selection = std::map<std::string, std::string>;

struct Claim {
  bool ours() const { return paper.empty(); }  ///< true: not a statement of a paper

  std::string id;         ///< unique in the file of claims
  std::string statement;  ///< the claim as a sentence
  std::string test;       ///< explains how `relation` tests the statement; may be empty
  std::string reading;    ///< "paper" or "pelage": the reading of the paper whose rows decide; "": none
  std::string paper;      ///< key of the paper in the references.bib of a report; empty for our own findings
  std::string section;    ///< section, figure or table of the paper; may be empty
  bool absolute = false;  ///< true if the claim depends on the speed of the hardware
  std::string why;        ///< why the claim fails, where it does; may be empty
  /// The reason why no rows can decide the claim; if there is one, all members below keep their defaults.
  std::string untestable;
  /// Only rows from devices with this text in their name decide the claim. Empty if all do.
  std::string hardware;

  std::vector<std::string> experiments;
  std::map<std::string, std::vector<std::string>> where;  ///< axis -> values of the used cases
  bool overridden = false;  ///< true: rows measured with --set, --axis or --model are also used
  Quantity quantity = Quantity::frame_time;
  std::string phase;   ///< for phase_time, phase_share and ratio_by_phase
  std::string metric;  ///< for Quantity::metric
  std::string per;     ///< metric by which the quantity is divided; may be empty
  /// Phase -> value of `axis`, if one process timed several variants alternately: each row then has the times
  /// of these variants as phases, and each phase is a separate case.
  std::map<std::string, std::string> phases;
  Effect effect = Effect::level;
  std::string axis;  ///< the axis of slopes and phases; "" for ratios if `of` names several axes
  /// For ratios: the two cases of a pair. They have equal values of all axes that neither selection names.
  Selection of, to;
  std::string along;   ///< metric against which slopes are computed instead of the axis; may be empty
  std::string across;  ///< for ratio_trend: the axis against which the slope of the ratio is computed
  double threshold = 0;
  Combine combine = Combine::every;
  std::string relation;  ///< the relation with its limits, as text: "at most 0.5"
  Region region;
  /// Least number of effects (share_of_cases: of cases). With fewer, the claim is untestable.
  std::size_t cases = 1;
  std::size_t values = 0;  ///< smallest number of axis values from which a slope or trend is computed
  /// Assumed relative standard deviation of times between processes; by default ClaimFile::process_spread.
  double process_spread = 0;
};

struct ClaimFile {
  std::filesystem::path file;
  /// Assumed relative standard deviation of times between processes, for cases that fewer than
  /// `separate_processes` processes measured, which do not suffice to measure it.
  double process_spread = 0.07;
  int separate_processes = 3;
  std::vector<Claim> claims;  ///< in the order of the file
};

/// Returns the selection as text: "layers = 64, size = 800x600".
std::string text_of(const Selection& selection);

/// Returns a description of the effect, for instance "frame rate with layers = 64, divided by the value with
/// layers = 16; each case".
std::string description_of(const Claim& claim);

/// Reads a file of claims and the files that its key `include` names. The InputError for a file with an error
/// names the file, the line, the key and the correct form.
ClaimFile read_claims(const std::filesystem::path& file);

/// Returns the path of the shipped file experiments/claims.toml. Throws InputError if it is not installed.
std::filesystem::path shipped_claims();

}  // namespace pelage::claims
