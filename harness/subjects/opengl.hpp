// The OpenGL baseline as an object that the harness times: alone, or alternately with the OpenCL pipeline.
#pragma once
#include <string>

#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject that times only the OpenGL baseline. The field `opengl` of `which` contains the
/// baseline's implementation options (docs/rival.md). Throws Unsupported if OpenGL is unavailable.
std::unique_ptr<Subject> make_opengl(SubjectContext& context, const Case& which);

/// Throws Unsupported if OpenGL is unavailable. Callers run this check before they prepare the mesh.
void need_opengl();

/// Returns a subject that draws in every round one frame of `ours` and then one frame of the baseline
/// `rival`. The row of results contains the times of `ours`. It also contains three additions: the baseline's
/// times as the phase `phase`; a check that the two pictures agree (at least tolerance::other_filter_psnr);
/// and the metric "<phase>_ratio". This metric is the baseline's time divided by the time of `ours`: the
/// median over the rounds, with its 95% interval.
std::unique_ptr<Subject> duel(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> rival,
                              const std::string& phase);

}  // namespace pelage
