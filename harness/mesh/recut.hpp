// Cuts the parts of a UV map that overlap out of their charts and gives them charts of their own.
#pragma once
#include <string>

#include "harness/mesh/surface.hpp"

namespace pelage {

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
