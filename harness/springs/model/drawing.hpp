// A picture of the topologies over a mesh, as Figures 3 to 5 of Banisch and Wuethrich 2006 show them.
#pragma once
#include <string>

#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// More triangles than this cannot be told apart on a page.
inline constexpr std::size_t most_drawn = 20000;

/// SVG of the four topologies on `mesh`, a panel each, seen from above its front: the surface, sticks in one
/// colour and the springs between tops in another; what the surface hides is hidden. Where a topology is
/// separable every triangle's own part is drawn a little smaller, so that it shows (Figure 5b). `length`, R:
/// of the sticks, above 0. Throws InputError for a mesh of more than most_drawn triangles.
std::string drawing_of(const Mesh& mesh, float length);

}  // namespace pelage::springs
