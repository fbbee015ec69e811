// Two sets of results, case by case.
#pragma once
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// "device", "variant" or "axes.KEY": what may differ between the two; "" for nothing. Throws InputError for
/// another text.
struct CompareBy {
  std::string text;
  explicit CompareBy(const std::string& by);
};

enum class Verdict { same, faster, slower, lost };  ///< lost: it had a time in A and has none in B

struct Pair {
  std::string name;  ///< what both have in common
  std::string a, b;  ///< what differs: the values of `by`
  double a_ms = 0, b_ms = 0;
  double change = 0;  ///< b / a - 1; 0 when either has no time
  Verdict verdict = Verdict::same;
};

/// Pairs every cell of A with the cells of B that are the same but for `by`. A pair counts as faster or
/// slower only when the medians differ by more than `threshold` (0.05: 5%) and their 95% intervals do not
/// overlap: noise is neither. When A and B are one set, each pair of different values of `by` is taken once.
/// Throws InputError when nothing pairs.
std::vector<Pair> compare_cells(const std::vector<Cell>& a, const std::vector<Cell>& b, bool one_set,
                                const CompareBy& by, double threshold);

std::string_view to_text(Verdict verdict);

/// "5%" or "0.05" as 0.05, else InputError.
double threshold_from_text(const std::string& text);

}  // namespace pelage
