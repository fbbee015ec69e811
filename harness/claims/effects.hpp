// Divides the cells of a claim into groups, and computes one effect from each group.
#pragma once
#include <string>
#include <vector>

#include "harness/claims/cells.hpp"
#include "harness/claims/drawing.hpp"

namespace pelage::claims {

/// The cells from which one effect is computed, for instance the two cells of a ratio. A claim may have
/// several parts; Claim::combine determines how their effects decide the claim.
struct Part {
  /// The values of the axes that distinguish this part from the others, such as "lion 64"; may be empty.
  std::string name;
  /// Indices of the cells, whose number depends on the effect. level: one cell; ratio and ratio_by_phase:
  /// `of` and `to`; elasticity and linearity: the cells in increasing order of the axis; ratio_trend: `of`
  /// and `to` for each value of the axis `across`; share_of_cases: all cells.
  std::vector<std::size_t> cells;
  /// For slopes, the axis values as numbers: one per cell, or for ratio_trend one per pair of cells.
  std::vector<double> x;
};

/// Returns the parts of the claim. Adds the names of cells that belong to no part, such as a cell without the
/// other cell of its ratio, to `left_out`, with the reason.
std::vector<Part> parts_of(const Claim& claim, const std::vector<Cell>& cells,
                           std::vector<std::string>& left_out);

/// Returns the effect of one part. `values` has one value per cell of the claim, in the order of the cells.
double effect_of(const Claim& claim, const Part& part, const std::vector<Value>& values);

/// Returns the mean, geometric mean or median of the effects, as Claim::combine specifies. Claim::combine
/// must not be `every`.
double combined(const Claim& claim, const std::vector<double>& effects);

}  // namespace pelage::claims
