// Times an OpenGL baseline (docs/baselines.md) alternately with an OpenCL pipeline.
#pragma once
#include <string>

#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject that draws in every round one frame of `ours` and then one frame of the baseline
/// `rival`. In the row of results, the phase (a named list of times) "frame" contains the times of `ours`,
/// and the phase with the name `phase` contains the baseline's times. An additional check requires that the
/// PSNR between the picture of `ours` and the picture of `rival` is at least tolerance::other_filter_psnr.
/// The metric "<phase>_ratio" is the baseline's time divided by the time of `ours`: the median over the
/// rounds, with its 95% interval.
std::unique_ptr<Subject> duel(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> rival,
                              const std::string& phase);

}  // namespace pelage
