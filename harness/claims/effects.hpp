// Divides the cells of a claim into groups, and computes one effect from each group.
#pragma once
#include <string>
#include <vector>

#include "harness/claims/cells.hpp"

namespace pelage::claims {

/// The cells from which one effect is computed. Claim::combine determines how the effects of several parts
/// decide the claim.
struct Part {
  /// The values of the axes that distinguish this part from the others, such as "lion 64"; may be empty.
  std::string name;
  /// Indices of the cells that the effect uses:
  /// - level: one cell;
  /// - ratio and ratio_by_phase: the cell at the axis value Claim::of, then the cell at Claim::to;
  /// - elasticity and linearity: the cells in increasing order of the axis value;
  /// - ratio_trend: the cells at Claim::of and at Claim::to, for each value of the axis Claim::across;
  /// - share_of_cases: all cells.
  std::vector<std::size_t> cells;
  /// For slopes, the axis values as numbers: one per cell, or for ratio_trend one per pair of cells.
  std::vector<double> x;
};

/// Returns the parts of the claim. If an effect cannot be computed, adds the name of a cell and the reason to
/// `left_out`. An effect that needs the axis values `of` and `to` ignores the cells with other values of
/// Claim::axis.
std::vector<Part> parts_of(const Claim& claim, const std::vector<Cell>& cells,
                           std::vector<std::string>& left_out);

/// Returns the effect of one part. `values` has one value per cell of the claim, in their order.
double effect_of(const Claim& claim, const Part& part, const std::vector<Value>& values);

/// Combines the effects as Claim::combine, which must not be `every`, specifies.
double combined(const Claim& claim, const std::vector<double>& effects);

}  // namespace pelage::claims
