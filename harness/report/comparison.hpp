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

enum class Verdict { same, faster, slower, lost };  ///< lost: the case has a time in A but no time in B

struct Pair {
  std::string name;  ///< the common properties of both cells
  std::string a, b;  ///< the two values of the property `by`
  double a_ms = 0, b_ms = 0;
  double change = 0;  ///< b_ms / a_ms - 1; 0 if a time is missing
  Verdict verdict = Verdict::same;
};

/// Pairs every cell of A with the cells of B that differ at most in `by`. A pair counts as faster or slower
/// only if the medians differ by more than `threshold` (0.05: 5%) and their 95% intervals do not overlap, so
/// noise counts as neither. If A and B are the same set, each pair of different values of `by` is compared
/// once. Throws InputError if there is no pair.
std::vector<Pair> compare_cells(const std::vector<Cell>& a, const std::vector<Cell>& b, bool one_set,
                                const CompareBy& by, double threshold);

std::string_view to_text(Verdict verdict);

/// Returns 0.05 for "5%" or "0.05"; throws InputError for other texts.
double threshold_from_text(const std::string& text);

}  // namespace pelage
