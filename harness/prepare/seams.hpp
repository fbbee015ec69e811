// Repeats droplets on the other side of UV seams (docs/shells.md, section 2).
#pragma once
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Returns the droplets in their order, each followed by its repetitions. A droplet whose disc reaches an
/// edge on a UV seam is repeated on the other side of the edge: the similarity that maps the edge's UV on one
/// side to its UV on the other side gives the centre and the radius of the repetition. Surface point, wetness
/// and number are those of the droplet. The reach is at most 1.1 times the radius on the surface. Repetitions
/// of repetitions are included, for places at which several seams meet. A repetition that nearly equals the
/// droplet or an earlier repetition is left out.
std::vector<Droplet> across_seams(const Mesh& mesh, const std::vector<Droplet>& droplets);

}  // namespace pelage
