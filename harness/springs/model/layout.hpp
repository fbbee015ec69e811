// A mass-spring topology in the order in which the kernels store it. The sticks are divided into slices of
// 16, and each slice is stored column by column.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Sticks and springs of a topology in the order of the kernels. The place of a stick is its index in this
/// order. Unused places hold padding: upright sticks at the origin that have no springs to other sticks.
/// Sticks keep the order of the topology, with two exceptions. On separable prisms, three consecutive slices
/// hold the three corners of 16 triangles. On shared (not separable) prisms, the sticks of each window of 256
/// are sorted by their number of springs, so that the sticks of a slice have similar numbers of springs.
struct Layout {
  int corners = 1;  ///< slices that belong together: 3 on separable prisms (one per corner), else 1
  int slices = 0;   ///< number of slices, padded to a multiple of 3 (separable prisms) or 4 (sticks)
  std::vector<std::uint32_t> place;  ///< for each stick, its index in the kernels' order
  /// Constants of the stick at each place, in SITE_COLUMNS columns: base in R, unit normal, cosine and sine
  /// of the gust's phase at the base.
  std::vector<float> sites;
  std::vector<float> offset;  ///< top mass relative to its base at rest, in R, 3 columns per place
  /// Only on separable prisms: the rest lengths of each triangle's sides (0, 1), (1, 2) and (2, 0), in R, in
  /// 3 columns.
  std::vector<float> sides;
  /// Only on shared prisms: the springs between top masses, as a sparse matrix in SELL-16 format (Kreutzer et
  /// al. 2014). Each spring occurs twice, once for each end. Entry 16 * (start[s] + k) + lane of `neighbour`
  /// is the place at the other end of spring k of place 16 * s + lane. If a place has fewer neighbours than
  /// another place of its slice, its remaining entries hold its own index.
  std::vector<std::int32_t> start, neighbour;
  std::vector<float> rest;

  std::size_t places() const { return std::size_t(slices) * 16; }
};

/// Returns the array index of column `column` of `place`, for an array with `columns` columns per place.
constexpr std::size_t column_of(std::size_t place, std::size_t columns, std::size_t column) {
  return (place / 16 * columns + column) * 16 + place % 16;
}

/// Computes the layout of `topology`. `wind` determines the phases of the gusts.
Layout lay_out(const SpringNetwork& topology, const Wind& wind);

/// Returns the number of bytes of device memory that `solver` needs for the topology. The number excludes the
/// tables of a launch (wind and motion per half step, partial sums of conjugate gradients), which take a few
/// kilobytes.
std::size_t memory(const Layout& layout, Solver solver);

}  // namespace pelage::springs
