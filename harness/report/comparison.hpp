// Comparison of two sets of results, A and B, case by case.
#pragma once
#include <string>
#include <vector>

#include "harness/report/cells.hpp"
#include "harness/report/plot_spec.hpp"
#include "harness/table/table.hpp"

namespace pelage {

/// The property in which the two cells of a pair may differ: "device", "variant" or "axes.KEY"; "" for none.
/// The constructor throws InputError for another text.
struct CompareBy {
  std::string text;
  explicit CompareBy(const std::string& by);
};

/// Where the confidence interval of the change lies with regard to the limits -threshold and +threshold:
/// below both (`faster`), above both (`slower`), between them (`same`), or it contains a limit (`undecided`).
/// The verdict is `lost` if the case has a time in A but no time in B.
enum class Verdict { same, faster, slower, undecided, lost };

struct Pair {
  std::string name;                ///< the properties that the two compared cells have in common
  std::vector<std::string> parts;  ///< the same, one property each
  std::string a, b;                ///< values of the property `by` in the two cells
  double a_ms, b_ms;               ///< typical_ms() of both cells; 0 if a time is missing
  std::size_t a_processes, b_processes;
  bool contended;         ///< whether other processes disturbed the timing of A or B
  double change = 0;      ///< b_ms / a_ms - 1; 0 if a time is missing
  Interval interval;      ///< confidence interval of `change`; 0 to 0 if a time is missing
  double confidence = 0;  ///< confidence level of `interval`; Holm's correction makes it at least 1 - alpha
  double p = 1;           ///< p-value of the verdict, before Holm's correction
  bool paired = false;    ///< whether the processes of A and B ran alternately
  bool assumed = false;   ///< whether the test used assumed_spread, because processes were too few
  /// Smallest relative increase of the time that the test finds with probability 0.9; 0 if unknown.
  double detectable = 0;
  /// Estimated number of processes per set that the test needs for a decision (processes_needed()); 0 if
  /// unknown or above 1000.
  std::size_t needed = 0;
  Verdict verdict = Verdict::undecided;
  std::string reason;  ///< if the verdict is `lost`: status and reason of the cell in B
};

struct CompareLimits {
  double threshold = 0.05;  ///< magnitude of both limits of the relative change (see Verdict); at least 0
  double alpha = 0.05;      ///< largest probability that one or more verdicts are wrong
};

/// Pairs every cell of `a` with each cell of `second_set` that has the same properties, except for the
/// property that `by` names. If `by` is "device", the function then pairs the remaining cells: two cells of a
/// case on different devices. Their variants name the mapping, whose default depends on the device. If
/// `one_set` is true, the cells of `a` are paired with each other; the cell with the smaller value of `by`
/// (natural_less()) is first. Throws InputError if there is no pair, or if a set contains two cells that
/// differ only in their identity.
std::vector<Pair> compare_cells(const std::vector<Cell>& a, const std::vector<Cell>& second_set, bool one_set,
                                const CompareBy& by, const CompareLimits& limits);

std::string_view to_text(Verdict verdict);

/// Returns a table with one line per pair: both times, the change with its interval, and the verdict. The
/// subtitle contains the properties that all pairs have in common. `pairs` is a result of compare_cells() and
/// not empty. `a` and `b` are names of the two sets of results, if there are two.
Table comparison_table(const std::vector<Pair>& pairs, const CompareBy& by, const std::string& a = "A",
                       const std::string& b = "B");

/// Returns a plot of the changes in a comparison_table().
PlotSpec comparison_plot(const Table& table);

/// Returns 0.05 for both "5%" and "0.05". The message of the InputError for other texts contains `option`.
double fraction_from_text(const std::string& option, const std::string& text);

}  // namespace pelage
