// Connected components of a surface. Each component has its own chart in the UV map.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "harness/mesh/surface.hpp"

namespace pelage {

/// Returns the component number of each triangle. Triangles that share a point belong to the same component.
/// Components are numbered from 0 in the order of their first triangles.
std::vector<std::uint32_t> components(const Surface& surface);

/// Orients the faces of every closed component outwards, and adds a message to Surface::notes if the
/// orientation of a face changes.
void turn_outwards(Surface& surface);

/// Returns one surface per component. These surfaces have no messages in Surface::notes and no UV map. The
/// order of triangles and points is preserved.
std::vector<Surface> split(const Surface& surface);

/// Packs the UV maps of the components `parts` side by side into the unit square, without overlap. Returns
/// `surface` with the packed UV map. `parts` is in the order in which split() returns the components. All
/// charts have the same ratio of UV area to surface area. For up to 163 charts, the margin around a chart is
/// 2/256 of the square's side, which is two texels of a wetness mask of 256 x 256 texels. For more charts,
/// the margin is smaller. Throws InputError if a component has no UV map.
Surface packed(const Surface& surface, const std::vector<Surface>& parts, const std::string& name);

}  // namespace pelage
