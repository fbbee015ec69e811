// The OpenGL baseline as a subject of the harness: alone, and against the OpenCL pipeline, frame by frame.
#pragma once
#include <string>

#include "harness/measure/subject.hpp"

namespace pelage {

/// The OpenGL baseline by itself, written as the case's `opengl` says. Throws Unsupported where there is no
/// OpenGL.
std::unique_ptr<Subject> make_opengl(SubjectContext& context, const Case& which);

/// Throws Unsupported where there is no OpenGL. Fast: call it before a mesh is prepared.
void need_opengl();

/// Draws a frame of `ours` and then one of the `rival`, again and again. The row is ours, and holds besides:
/// the rival's times as phase `phase`, the agreement of the two pictures (at least
/// tolerance::other_filter_psnr), and as metric
/// "<phase>_ratio" the median over rounds of the rival's time by ours with its 95% interval.
std::unique_ptr<Subject> duel(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> rival,
                              const std::string& phase);

}  // namespace pelage
