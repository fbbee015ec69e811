// The OpenGL baseline as a subject: timed alone, or timed alternately with the OpenCL pipeline.
#pragma once
#include <string>

#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns the OpenGL baseline alone, with the implementation options of the case's `opengl` (docs/rival.md).
/// Throws Unsupported if OpenGL is unavailable.
std::unique_ptr<Subject> make_opengl(SubjectContext& context, const Case& which);

/// Throws Unsupported if OpenGL is unavailable. Callers run this check before they prepare the mesh.
void need_opengl();

/// Returns a subject that draws in every round one frame of `ours` and then one frame of the baseline
/// `rival`. The row is that of `ours`. It also contains the baseline's times as phase `phase`, a check that
/// the two pictures agree (at least tolerance::other_filter_psnr), and the metric "<phase>_ratio": the median
/// over the rounds, with its 95% interval, of the baseline's time divided by that of `ours`.
std::unique_ptr<Subject> duel(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> rival,
                              const std::string& phase);

}  // namespace pelage
