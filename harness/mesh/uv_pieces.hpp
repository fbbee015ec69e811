// Finds the triangles that overlap in a UV map, and divides the map into parts that do not overlap.
// Finds places for charts in its free space.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/mesh/surface.hpp"

namespace pelage {

constexpr std::uint32_t no_face = 0xffffffffu;

/// For each triangle, the triangles at its edges; edge k connects the corners k and k + 1. no_face if there
/// is none.
using Neighbours = std::vector<std::array<std::uint32_t, 3>>;

/// Returns the neighbours on the surface. If `in_uv` is true, triangles whose UVs differ at the common edge
/// are no neighbours.
Neighbours neighbours_of(const Surface& surface, bool in_uv);

using Faces = std::vector<std::uint32_t>;  ///< indices of triangles, in ascending order

/// Parts of the UV map, each connected. No two triangles of `rest` overlap. Both lists are empty if nothing
/// must be cut out.
struct Pieces {
  std::vector<Faces> piece;  ///< parts that are cut out
  std::vector<Faces> rest;   ///< parts that stay
};

struct PieceRules {
  /// Length on the surface by which a piece is larger than the triangles that must be cut out. Also, parts of
  /// the rest that are smaller than a disc of twice this radius become parts of pieces.
  double growth = 0;
  /// Triangles are cut out, too, if their ratio of UV area to surface area, divided by the same ratio of the
  /// whole map, is above this number or below its reciprocal. 0: no limit.
  double most_stretch = 0;
};

/// Chooses the pieces. Flipped triangles are cut out. Of triangles that overlap each other, those of one side
/// are cut out: the side with the smaller area on the surface. The kept triangles then do not overlap. If the
/// map has neither overlaps nor flipped triangles nor triangles beyond the limit of stretch, there are no
/// pieces.
Pieces choose_pieces(const Surface& surface, const PieceRules& rules);

/// Returns the area of a triangle on the surface.
double surface_area(const Surface& surface, std::uint32_t f);

/// Returns the pairs (a, b), a < b, of triangles that overlap in UV, in ascending order. `uv` contains the
/// corners of each triangle. Two triangles overlap if no translation by less than 1e-9 separates them, so
/// triangles that only touch at an edge or a corner do not overlap.
std::vector<std::pair<std::uint32_t, std::uint32_t>> uv_overlaps(const std::vector<Surface::Corners>& uv);

/// The free space of the UV square. Charts keep a distance of 2/256 of the square's side from its border, and
/// an added chart keeps a distance of 4/256 from other charts, as the charts of packed() do.
class FreeSpace {
 public:
  FreeSpace();
  /// Marks the space that a triangle takes.
  void take(const Surface::Corners& uv);
  /// Finds a place for the bounding box of a chart, marks its space as taken, and returns its lower corner.
  /// Returns nothing if there is no place. `size` is the size of the box in UV.
  std::optional<glm::dvec2> place(glm::dvec2 size);

 private:
  std::vector<char> taken_;
};

// Cuts the parts of a UV map that overlap out of their charts and gives them charts of their own.

/// Removes the overlaps of a UV map in the unit square, and its flipped triangles. choose_pieces() in
/// uv_pieces.hpp chooses parts of the surface. They become charts in the free space of the square; all other
/// triangles keep their UV. A part without overlaps keeps its shape in UV. Other parts are flattened again.
/// In each new chart, UV area divided by surface area is the same as in the whole map. If the space is too
/// small, the whole map is made smaller, by at most a half; if this does not help, the map stays as it is. A
/// map without overlaps and flipped triangles stays as it is. With `even`, a part of the surface that the map
/// enlarges or shrinks by more than a factor of 1.6 in area gets a chart of its own, too. Appends a note
/// about the new charts. Returns true if the map or the notes have changed.
bool recut(Surface& surface, bool even, const std::string& name);

}  // namespace pelage
