// Surfaces of several components, each of which gets a chart of its own.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "harness/mesh/surface.hpp"

namespace pelage {

/// The component of each triangle, numbered from 0 in the order of the triangles: triangles that share
/// points.
std::vector<std::uint32_t> components(const Surface& surface);

/// Turns the faces of every closed component outwards; says so in the notes.
void turn_outwards(Surface& surface);

/// One surface per component, without notes and UV; triangles and points in their order.
std::vector<Surface> split(const Surface& surface);

/// `surface` with the UV maps of its components, as split() numbers them, side by side in the unit square: at
/// one scale of UV area to surface area, without overlap, at least 2 texels of a 256 mask around each where
/// there are few. Throws InputError when a component has no map.
Surface packed(const Surface& surface, const std::vector<Surface>& parts, const std::string& name);

}  // namespace pelage
