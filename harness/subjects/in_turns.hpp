// Subjects that draw several pictures in turns in every round (harness/measure/turns.hpp). Their checks check
// all pictures.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// How the names of the pipelines of against_control_scene() end in experiment files.
inline constexpr std::string_view control_suffix = "+baseline";

/// Measures what one change of a scene costs and how it changes the picture. The phase "baseline" is the case
/// without the settings of its named axes (control_case). The metric "frame_over_baseline" is the case's
/// time divided by the other time. "baseline_psnr" (dB) and "baseline_ssim" compare the two pictures.
std::unique_ptr<Subject> against_control_scene(const MakeSubject& make, const Experiment& experiment,
                                               const Case& which);

/// Measures the cost of more layers: the phases "half" and "quarter" draw with half and with a quarter of the
/// `layers` of the case's scene (metrics "frame_over_half" and "frame_over_quarter"). `make` makes a subject
/// for each number of layers. Throws InputError if `layers` is not a multiple of 4.
std::unique_ptr<Subject> fewer_layers(const MakeSubject& make, const Case& which, int layers);

/// Times `ours` in turns with an OpenGL baseline that draws the same picture, the phase "opengl". An
/// additional check requires that the PSNR between the two pictures is at least tolerance::other_filter_psnr.
/// The row also has the baseline's identity and provenance, and the time of its build as the metric
/// "opengl_build_ms".
std::unique_ptr<Subject> with_opengl(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> theirs);

// Compares a timed picture of fur with a ray-cast picture of the scene's strands.

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
