// The colour of the fur over the body.
#pragma once
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// The coat in the atlas: a picture, or a pattern that is a function of the surface point and so has no
/// seams. Throws InputError for an unknown pattern.
CoatTexture make_coat(const Mesh& mesh, const CoatScene& coat);

}  // namespace pelage
