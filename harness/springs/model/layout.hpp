// A mass-spring topology in the order in which the kernels store it (kernels/common/slices.clh).
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Sticks and springs in the order in which the kernels store them. The place of a stick is its index in this
/// order. Slice s consists of the places 16 * s to 16 * s + 15. An array with several columns, such as x,
/// stores the values of a slice column by column. Unused places hold padding: upright sticks at the origin
/// without springs to other sticks. Sticks keep the order of the topology, with two exceptions. For
/// separable-prisms, three consecutive slices hold the sticks of 16 triangles, one slice for each corner. For
/// prisms, every 256 consecutive sticks are sorted by their number of springs, so that the sticks of a slice
/// have similar numbers of springs.
struct Layout {
  int corners = 1;  ///< number of slices that belong together: 3 for separable-prisms, otherwise 1
  /// Number of slices of 16 places, which include unused places. It is a multiple of 3 for separable-prisms,
  /// and of 4 for sticks and separable-sticks.
  int slices = 0;
  std::vector<std::uint32_t> place;  ///< for each stick, its index in the kernels' order
  /// Constants of the stick at each place, in SITE_COLUMNS columns: position of the base in R, unit normal,
  /// cosine and sine of the gust's phase at SpringNetwork::gust_at.
  std::vector<float> sites;
  std::vector<float> offset;  ///< position of the top at rest minus the base, in R, in 3 columns
  /// Only for separable-prisms: the rest lengths of each triangle's sides (0, 1), (1, 2) and (2, 0), in R, in
  /// 3 columns.
  std::vector<float> sides;
  /// Only for prisms: the springs between tops, as a sparse matrix in SELL-16 format (Kreutzer et al. 2014).
  /// Each spring occurs twice, once for each end. Spring k of the stick at the place 16 * s + lane is entry
  /// 16 * (start[s] + k) + lane: `neighbour` is the place of the stick at the other end, and `rest` the rest
  /// length in R. All sticks of a slice have equally many entries. In the unused ones, `neighbour` is the
  /// place of the stick itself.
  std::vector<std::int32_t> start, neighbour;
  std::vector<float> rest;

  std::size_t places() const { return std::size_t(slices) * 16; }
};

/// Returns the index of the value in column `column` of the stick at `place`, in an array with `columns`
/// columns.
constexpr std::size_t column_of(std::size_t place, std::size_t columns, std::size_t column) {
  return (place / 16 * columns + column) * 16 + place % 16;
}

/// Sets the phases of the gusts in the layout of `network`.
void set_phases(const SpringNetwork& network, const Wind& wind, Layout& layout);

/// Computes the layout of `network`. `wind` determines the phases of the gusts.
Layout lay_out(const SpringNetwork& network, const Wind& wind);

/// Returns the number of bytes of device memory that `solver` needs for the topology, without three buffers:
/// wind, gravity and the object's motion at every half step of 512 steps (56 KiB), or more if one call of
/// enqueue() simulates more steps; the partial sums of conjugate gradients (at most 20 KiB); and the results
/// of the kernel gradients_whole (12 bytes).
std::size_t memory(const Layout& layout, Solver solver);

}  // namespace pelage::springs
