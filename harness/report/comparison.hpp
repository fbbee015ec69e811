// Comparison of two sets of results, case by case.
#pragma once
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// The property in which the two cells of a pair may differ: "device", "variant" or "axes.KEY"; "" for none.
/// The constructor throws InputError for another text.
struct CompareBy {
  std::string text;
  explicit CompareBy(const std::string& by);
};

/// faster, slower: the interval of the change lies below -threshold or above +threshold. same: it lies
/// between these limits. undecided: it contains a limit. lost: the case has a time in A but no time in B.
enum class Verdict { same, faster, slower, undecided, lost };

struct Pair {
  std::string name;  ///< the properties that the two compared cells have in common
  std::string a, b;  ///< values of the property `by` in the two cells
  double a_ms = 0, b_ms = 0;
  std::size_t a_processes = 0, b_processes = 0;
  bool contended = false;  ///< whether other processes disturbed the timing of A or B
  /// Typical time of B divided by the typical time of A, minus 1. 0 if a time is missing. The typical time of
  /// a case is the geometric mean of its processes' medians.
  double change = 0;
  Interval interval;      ///< confidence interval of `change`; 0 to 0 if a time is missing
  double confidence = 0;  ///< of `interval`; at least 1 - alpha, because of Holm's correction
  double p = 1;           ///< p-value of the verdict, before Holm's correction
  bool paired = false;    ///< whether the processes of A and B took turns
  bool assumed = false;   ///< whether the test assumed the spread between processes (assumed_spread)
  double detectable = 0;  ///< smallest increase that the test finds with probability 0.9; 0 if unknown
  Verdict verdict = Verdict::undecided;
};

struct CompareLimits {
  double threshold = 0.05;  ///< relative change above which B counts as faster or slower; at least 0
  double alpha = 0.05;      ///< largest probability that one or more verdicts are wrong
};

/// Pairs every cell of `a` with each cell of `b` that has the same properties. Only the property that `by`
/// names may differ. The verdicts are computed by decide() (harness/measure/difference.hpp). If `one_set` is
/// true, `a` and `b` are the same set. Of the pairs (x, y) and (y, x) of two cells, only one is then
/// returned: the one whose first cell has the smaller value of `by` (natural_less()). Throws InputError if
/// there is no pair, or if a set contains two cells that differ only in their identity (hashes of the
/// inputs).
std::vector<Pair> compare_cells(const std::vector<Cell>& a, const std::vector<Cell>& b, bool one_set,
                                const CompareBy& by, const CompareLimits& limits);

std::string_view to_text(Verdict verdict);

/// Returns 0.05 for "5%" or "0.05"; throws InputError for other texts. The error message contains `option`,
/// the name of the command-line option.
double fraction_from_text(const std::string& option, const std::string& text);

}  // namespace pelage
