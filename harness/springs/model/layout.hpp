// A mass-spring topology in the order in which the kernels store it. The sticks are divided into slices of
// 16. In each slice, an array stores one component (a column, such as x) of all 16 sticks before the next
// component. R is the radius of the mesh's bounding sphere.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Sticks and springs of a topology in the order in which the kernels store them. The place of a stick is its
/// index in this order. Slice s consists of the places 16 * s to 16 * s + 15. An array with several columns
/// stores the values of a slice column by column. Unused places hold padding: upright sticks at the origin
/// that have no springs to other sticks. Sticks keep the order of the topology, with two exceptions. For the
/// topology separable-prisms, three consecutive slices hold the sticks of 16 triangles. The first of these
/// slices holds the stick at corner 0 of each triangle, the second slice the stick at corner 1, and the third
/// slice the stick at corner 2. For the topology prisms, every 256 consecutive sticks are sorted by their
/// number of springs, so that the sticks of a slice have similar numbers of springs.
struct Layout {
  /// 3 for the topology separable-prisms, in which three consecutive slices hold the sticks at the three
  /// corners of the same 16 triangles. 1 for all other topologies.
  int corners = 1;
  /// Number of slices of 16 places, which include unused places. It is a multiple of 3 for separable-prisms,
  /// and of 4 for sticks and separable-sticks.
  int slices = 0;
  std::vector<std::uint32_t> place;  ///< for each stick, its index in the kernels' order
  /// Constants of the stick at each place, in SITE_COLUMNS columns: position of the base in R, unit normal,
  /// cosine and sine of the gust's phase at SpringNetwork::gust_at.
  std::vector<float> sites;
  /// Position of the top mass at rest minus the position of the stick's base, in R. The three columns are the
  /// components x, y and z.
  std::vector<float> offset;
  /// Only for the topology separable-prisms: the rest lengths of each triangle's sides (0, 1), (1, 2) and (2,
  /// 0), in R, in 3 columns.
  std::vector<float> sides;
  /// Only for the topology prisms: the springs between top masses, as a sparse matrix in SELL-16 format
  /// (Kreutzer et al. 2014). Each spring occurs twice, once for each end. Consider the stick in slice s at
  /// the place 16 * s + lane. Its spring k is entry 16 * (start[s] + k) + lane. In this entry, `neighbour` is
  /// the place of the stick at the spring's other end, and `rest` is the spring's rest length in R. All
  /// sticks of a slice have equally many entries. In the unused entries of a stick, `neighbour` is the place
  /// of this stick.
  std::vector<std::int32_t> start, neighbour;
  std::vector<float> rest;

  std::size_t places() const { return std::size_t(slices) * 16; }
};

/// Returns the index of one value in an array that stores `columns` values per stick, in columns. The value
/// is in column `column` and belongs to the stick at `place` (the stick's index in the order of the kernels).
constexpr std::size_t column_of(std::size_t place, std::size_t columns, std::size_t column) {
  return (place / 16 * columns + column) * 16 + place % 16;
}

/// Computes the layout of `topology`. `wind` determines the phases of the gusts.
Layout lay_out(const SpringNetwork& topology, const Wind& wind);

/// Returns the number of bytes of device memory that `solver` needs for the topology. The number excludes
/// three buffers. The first holds wind, gravity and the object's motion at every half step; it covers 512
/// steps (56 KiB), or more if one call of enqueue() simulates more steps. The second holds the partial sums
/// of conjugate gradients and has at most 20 KiB. The third holds the results of the kernel gradients_whole
/// and has 12 bytes.
std::size_t memory(const Layout& layout, Solver solver);

}  // namespace pelage::springs
