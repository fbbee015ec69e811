// Makes objects that time the OpenGL baseline (docs/baselines.md), alone or alternately with the OpenCL
// pipeline. The baseline is the OpenGL pipeline of the papers by Silva et al. 2010.
#pragma once
#include <string>

#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject that times only the OpenGL baseline. The field `opengl` of `which` contains the
/// baseline's implementation options (docs/baselines.md). Throws Unsupported if OpenGL is unavailable.
std::unique_ptr<Subject> make_opengl(SubjectContext& context, const Case& which);

/// Throws Unsupported if OpenGL is unavailable. Callers run this check before they prepare the mesh.
void need_opengl();

/// The phase of a row that has the times of an OpenGL baseline which draws in turns with OpenCL.
inline constexpr const char* opengl_phase = "opengl";

/// Returns a subject that draws in every round one frame of `ours` and then one frame of the baseline
/// `rival`. In the row of results, the phase (a named list of times) "frame" contains the times of `ours`,
/// and the phase with the name `phase` contains the baseline's times. An additional check requires that the
/// PSNR between the picture of `ours` and the picture of `rival` is at least tolerance::other_filter_psnr.
/// The metric "<phase>_ratio" is the baseline's time divided by the time of `ours`: the median over the
/// rounds, with its 95% interval.
std::unique_ptr<Subject> duel(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> rival,
                              const std::string& phase);

}  // namespace pelage
