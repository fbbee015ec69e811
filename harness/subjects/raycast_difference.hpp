// Compares a timed picture of fur with a ray-cast picture of the scene's strands.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject that draws the frames of `drawn`, the case's fur as strands or as layers, with five more
/// metrics. They compare the timed picture with a ray-cast picture of the scene's strands at rest as cones
/// (harness/strands/raycast), above the skin if the scene's strands have one, without a shadow map and
/// without strands that face away from the camera.
/// - `raycast_psnr` is the PSNR in dB.
/// - `raycast_coarse_psnr` is the PSNR of the means of squares of 8 x 8 pixels. It compares the colour, the
///   shape and the coverage of two coats whose single hairs have different places.
/// - `raycast_mean` is the mean over the fur pixels of the timed picture's luma minus the ray-cast one's.
/// - `raycast_overdraw` is the mean number of strands that a ray of a fur pixel enters.
/// - `overdraw` is the mean number of fragments per fur pixel of the timed picture.
std::unique_ptr<Subject> against_raycast(SubjectContext& context, const Case& which,
                                         std::unique_ptr<Subject> drawn);

}  // namespace pelage
