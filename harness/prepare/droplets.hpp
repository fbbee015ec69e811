// The droplets of the wetness mask. Algorithm 1 (S 3.3, W 3.1) draws them into the mask. Droplets are
// repeated on the other side of UV seams (docs/shells.md, section 2).
#pragma once
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// Returns the scene's explicit droplets in their order, followed by the random droplets. A droplet given by
/// a point in space is moved to the nearest surface point. A droplet given by a uv outside all charts is
/// moved to the nearest chart. Random positions, uniformly distributed over the surface, are candidates for
/// the centres of random droplets. A candidate is rejected if it is outside the areas in which the scene
/// permits random droplets, or too close to the centre of an earlier random droplet. In UV, the least
/// distance between two centres is `spacing` times the radius of the later droplet. In space, their least
/// distance is this UV distance times the smaller component of mesh.length_per_uv. With wetness.unit
/// "surface", radii in UV are those in R, divided by the local length per unit of UV. With
/// wetness.seams "joined", each droplet is followed by its repetitions across UV seams. Droplets
/// that never arrive (water.hpp) are left out.
std::vector<Droplet> make_droplets(const std::shared_ptr<const Mesh>& mesh, const Skin& skin,
                                   const WetnessScene& wetness);

/// Returns the droplets in their order, each followed by its repetitions. A droplet whose disc reaches an
/// edge on a UV seam is repeated on the other side of the edge: the similarity that maps the edge's UV on one
/// side to its UV on the other side gives the centre and the radius of the repetition. Surface point, wetness
/// and number are those of the droplet. The reach is at most 1.1 times the radius on the surface. Repetitions
/// of repetitions are included, for places at which several seams meet. A repetition that nearly equals the
/// droplet or an earlier repetition is left out.
std::vector<Droplet> across_seams(const Mesh& mesh, const std::vector<Droplet>& droplets);

}  // namespace pelage
