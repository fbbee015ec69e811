// Compares the timed picture of strands with a ray-cast picture of the same strands.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject that draws the frames of `strands`, a subject of the case's strands. Its row has four
/// more metrics. They compare the timed picture with a ray-cast picture of the strands at rest as cones
/// (harness/strands/raycast). The ray-cast picture has no shadow map. It contains the strands that a picture
/// of all strands shows, which do not include those that face away from the camera. `raycast_psnr` is the
/// PSNR in dB. `raycast_mean` is the mean over the fur pixels of the timed picture's luma minus the ray-cast
/// picture's luma. `raycast_overdraw` is the mean number of strands that a ray of a fur pixel enters.
/// `overdraw` is the mean number of fragments per fur pixel of the timed picture.
std::unique_ptr<Subject> against_raycast(SubjectContext& context, const Case& which,
                                         std::unique_ptr<Subject> strands);

}  // namespace pelage
