// Connected components of a surface. Each component has its own chart in the UV map.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "harness/mesh/surface.hpp"

namespace pelage {

/// The component number of each triangle. Triangles that share a point belong to the same component.
/// Components are numbered from 0 in the order of their first triangles.
std::vector<std::uint32_t> components(const Surface& surface);

/// Orients the faces of every closed component outwards and adds a note if it changes any.
void turn_outwards(Surface& surface);

/// Returns one surface per component, without notes and UV. The order of triangles and points is preserved.
std::vector<Surface> split(const Surface& surface);

/// Returns `surface` with the UV maps of its components `parts`, in the order of split(), packed side by side
/// into the unit square without overlap. All charts have the same ratio of UV area to surface area. Up to 163
/// charts have margins of 2 texels of a 256 x 256 mask; with more charts the margins are smaller. Throws
/// InputError if a component has no UV map.
Surface packed(const Surface& surface, const std::vector<Surface>& parts, const std::string& name);

}  // namespace pelage
