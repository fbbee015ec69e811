// Where the fur is wet: the droplets that Algorithm 1 (S 3.3, W 3.1) draws into the wetness mask.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// The scene's explicit droplets in their order, then the random ones. A droplet given by a point of space
/// lands on the nearest surface point; one given by uv outside every chart, on the nearest chart. Random
/// centres fall evenly over the surface, no two closer than `spacing` radii, in UV or across the surface.
std::vector<Droplet> make_droplets(const std::shared_ptr<const Mesh>& mesh, const Skin& skin,
                                   const WetnessScene& wetness);

}  // namespace pelage
