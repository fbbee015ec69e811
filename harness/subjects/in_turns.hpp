// Subjects that draw several pictures in turns in every round (harness/measure/turns.hpp). Their checks check
// all pictures.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// The name of the pipeline of against_baseline_scene() in experiment files.
inline constexpr std::string_view baseline_pipeline = "shells+baseline";

/// Measures what one change of a scene costs and how it changes the picture. The phase "baseline" is the case
/// without the settings of its named axes (baseline_case). The metric "frame_over_baseline" is the case's
/// time divided by the other time. "baseline_psnr" (dB) and "baseline_ssim" compare the two pictures.
std::unique_ptr<Subject> against_baseline_scene(const MakeSubject& make, const Experiment& experiment,
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

}  // namespace pelage
