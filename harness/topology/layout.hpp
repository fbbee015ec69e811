// A topology in the kernels' order: rows of four floats per stick, sticks in slices of 16.
#pragma once
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "harness/topology/dynamics.hpp"
#include "harness/topology/topology.hpp"

namespace pelage::springs {

/// Rows past the last stick hold upright sticks at the origin that nothing is tied to. Sticks lie in their
/// own order; those of separable prisms so that the three corners of 16 triangles are slices that follow each
/// other; those of shared prisms sorted by degree within windows of 256, so that the rows of a slice have
/// nearly as many springs each.
struct Layout {
  int corners = 1;                   ///< slices that belong together: 3 on separable prisms
  int blocks = 0;                    ///< groups of that many slices
  std::vector<std::uint32_t> place;  ///< per stick, its row
  std::vector<glm::vec4> root;       ///< per row: base, R, and the cosine of the gust's phase there
  std::vector<glm::vec4> normal;     ///< per row: n, and the sine of that phase
  std::vector<glm::vec4> offset;     ///< per row: q at rest, R
  /// Separable prisms: per triangle, the rest lengths of its sides (0, 1), (1, 2), (2, 0).
  std::vector<glm::vec4> side;
  /// Shared prisms: springs between tops seen from each of their ends, as SELL-16 (Kreutzer et al. 2014).
  /// Entry 16 (start[s] + k) + lane is the k-th neighbour of row 16 s + lane; rows with fewer neighbours than
  /// their slice's longest are filled with themselves.
  std::vector<std::int32_t> start, neighbour;
  std::vector<float> rest;

  std::size_t rows() const { return root.size(); }
};

Layout lay_out(const Topology& topology, const Wind& wind);

/// Bytes of device memory that `solver` moves the topology in, but for the tables of a launch (moments, sums
/// of conjugate gradients): a few kilobytes.
std::size_t memory(const Layout& layout, Solver solver);

}  // namespace pelage::springs
