// A topology in the storage order of the kernels: sticks in slices of 16, each slice stored column by column.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Sticks and springs of a topology in the order of the kernels. Each stick has a place, its index in that
/// order. Places after the last stick are filled with upright sticks at the origin that have no springs to
/// others. Sticks keep the order of the topology, with two exceptions. On separable prisms, three consecutive
/// slices hold the three corners of 16 triangles. On shared prisms, sticks are sorted by degree within
/// windows of 256, so that the places of a slice have similar numbers of springs.
struct Layout {
  int corners = 1;  ///< number of slices that belong together: 3 on separable prisms, else 1
  int slices = 0;   ///< number of slices; a multiple of 3 on separable prisms, of 4 on sticks
  std::vector<std::uint32_t> place;  ///< index of each stick in the order of the kernels
  /// SITE_COLUMNS columns per place: base (R), unit normal, cosine and sine of the gust's phase at the base.
  std::vector<float> sites;
  std::vector<float> offset;  ///< 3 columns per place: q at rest, R
  /// Separable prisms only. 3 columns per triangle: the rest lengths of its sides (0, 1), (1, 2) and (2, 0),
  /// R.
  std::vector<float> sides;
  /// Shared prisms only. The springs between top masses in SELL-16 format (Kreutzer et al. 2014). Each spring
  /// occurs twice, once for each end. Entry 16 (start[s] + k) + lane is the k-th neighbour of place 16 s +
  /// lane. A place with fewer neighbours than the longest row of its slice is padded with its own index.
  std::vector<std::int32_t> start, neighbour;
  std::vector<float> rest;

  std::size_t places() const { return std::size_t(slices) * 16; }
};

/// Returns the index at which an array of `columns` columns stores column `column` of `place`.
constexpr std::size_t column_of(std::size_t place, std::size_t columns, std::size_t column) {
  return (place / 16 * columns + column) * 16 + place % 16;
}

/// Computes the layout of `topology`. `wind` determines the phases of the gusts.
Layout lay_out(const SpringNetwork& topology, const Wind& wind);

/// Returns the number of bytes of device memory that `solver` needs for the topology. It excludes the tables
/// of a launch (moments, partial sums of conjugate gradients), which take a few kilobytes.
std::size_t memory(const Layout& layout, Solver solver);

}  // namespace pelage::springs
