// A topology in the kernels' order: sticks in slices of 16, the columns of a slice one after another.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Places past the last stick hold upright sticks at the origin that nothing is tied to. Sticks lie in their
/// own order; those of separable prisms so that the three corners of 16 triangles are slices that follow each
/// other; those of shared prisms sorted by degree within windows of 256, so that the places of a slice have
/// nearly as many springs each.
struct Layout {
  int corners = 1;                   ///< slices that belong together: 3 on separable prisms
  int slices = 0;                    ///< a multiple of `corners`; of sticks by themselves a multiple of 4
  std::vector<std::uint32_t> place;  ///< per stick
  std::vector<float> sites;          ///< SITE_COLUMNS: base, R; n; cosine and sine of the gust's phase there
  std::vector<float> offset;         ///< 3 columns, q at rest, R
  /// Separable prisms: 3 columns per triangle, the rest lengths of its sides (0, 1), (1, 2), (2, 0).
  std::vector<float> sides;
  /// Shared prisms: springs between tops seen from each of their ends, as SELL-16 (Kreutzer et al. 2014).
  /// Entry 16 (start[s] + k) + lane is the k-th neighbour of place 16 s + lane; places with fewer neighbours
  /// than their slice's longest are filled with themselves.
  std::vector<std::int32_t> start, neighbour;
  std::vector<float> rest;

  std::size_t places() const { return std::size_t(slices) * 16; }
};

/// Where column `column` of `columns` holds the value of `place`.
constexpr std::size_t column_of(std::size_t place, std::size_t columns, std::size_t column) {
  return (place / 16 * columns + column) * 16 + place % 16;
}

Layout lay_out(const SpringNetwork& topology, const Wind& wind);

/// Bytes of device memory that `solver` moves the topology in, but for the tables of a launch (moments, sums
/// of conjugate gradients): a few kilobytes.
std::size_t memory(const Layout& layout, Solver solver);

}  // namespace pelage::springs
