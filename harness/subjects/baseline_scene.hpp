// Measures what one change of a scene costs and how it changes the picture.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// The name of the pipeline of these subjects in experiment files.
inline constexpr std::string_view baseline_pipeline = "shells+baseline";

/// Returns a subject (an object that the harness times) that draws two frames in every round: that of the
/// case and that of the same case without the settings of its named axes (baseline_case), the phase
/// "baseline". check() checks both pictures. The metric "frame_over_baseline" is the case's time divided by
/// the other time (harness/measure/turns.hpp). "baseline_psnr" (dB) and "baseline_ssim" compare the two
/// pictures.
std::unique_ptr<Subject> against_baseline_scene(const MakeSubject& make, const Experiment& experiment,
                                                const Case& which);

}  // namespace pelage
