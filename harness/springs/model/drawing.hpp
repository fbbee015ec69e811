// Draws the four mass-spring topologies over a mesh, like Figures 3 to 5 of Banisch and Wuethrich 2006.
#pragma once
#include <string>

#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Largest number of triangles that drawing_of accepts. In larger meshes the triangles are too small to
/// distinguish on a page.
inline constexpr std::size_t most_drawn = 20000;

/// Returns an SVG with one panel per topology. Each panel shows the surface of `mesh` from the front and
/// slightly from above, the sticks in one colour and the springs between tops in another. Sticks and springs
/// behind the surface are hidden. Of the separable topologies, each mass is drawn nearer to the centre of its
/// triangle, so that gaps between the triangles are visible, as in Figure 5b of the paper. `length` is the
/// rest length of the sticks in R, above 0. Throws InputError if the mesh has more than most_drawn triangles.
std::string drawing_of(const Mesh& mesh, float length);

}  // namespace pelage::springs
