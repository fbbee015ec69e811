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
  std::string name;  ///< the properties that the two compared cells have in common
  std::string a, b;  ///< values of the property `by` in the two cells
  double a_ms = 0, b_ms = 0;
  double change = 0;  ///< b_ms / a_ms - 1; 0 if a time is missing
  Verdict verdict = Verdict::same;
};

/// Pairs every cell of `a` with each cell of `b` that has the same properties. Only the property that `by`
/// names may differ. A pair counts as faster or slower only if the medians differ by more than `threshold`
/// (0.05 is 5%) and their 95% intervals do not overlap. If `one_set` is true, `a` and `b` are the same set.
/// If this set then contains the pair (x, y), the pair (y, x) is left out. Throws InputError if there is no
/// pair, or if a set contains two cells that differ only in their identity.
std::vector<Pair> compare_cells(const std::vector<Cell>& a, const std::vector<Cell>& b, bool one_set,
                                const CompareBy& by, double threshold);

std::string_view to_text(Verdict verdict);

/// Returns 0.05 for "5%" or "0.05"; throws InputError for other texts.
double threshold_from_text(const std::string& text);

}  // namespace pelage
