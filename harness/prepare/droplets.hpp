// The droplets that Algorithm 1 (S 3.3, W 3.1) draws into the wetness mask. S and W are the papers that
// docs/frame.md lists.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// Returns the scene's explicit droplets in their order, followed by the random droplets. A droplet given by
/// a point in space is moved to the nearest surface point. A droplet given by a uv outside all charts is
/// moved to the nearest chart. The centres of random droplets are uniformly distributed over the surface. The
/// distance between the centres of two random droplets, in UV and in space, is at least `spacing` times the
/// radius of the droplet that was placed later.
std::vector<Droplet> make_droplets(const std::shared_ptr<const Mesh>& mesh, const Skin& skin,
                                   const WetnessScene& wetness);

}  // namespace pelage
