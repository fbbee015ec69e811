// Rivals as subjects of the harness: OpenGL alone, and OpenGL against the OpenCL pipeline, frame by frame.
#pragma once
#include <functional>
#include <string>

#include "harness/measure/subject.hpp"

namespace pelage {

/// Cases whose pipeline is "opengl" (written as the case's `opengl` says) go to the rival, "shells+opengl" to
/// a duel, all others to `shells`. Meshes stay in memory from case to case; `progress` is told what takes
/// long. Where there is no OpenGL the first two throw Unsupported.
MakeSubject with_rivals(const MakeSubject& shells, const Experiment& experiment,
                        const std::function<void(const std::string&)>& progress);

/// Draws a frame of `ours` and then one of the `rival`, again and again. The row is ours, and holds besides:
/// the rival's times as phase `phase`, the agreement of the two pictures (at least
/// tolerance::other_filter_psnr), and as metric
/// "<phase>_ratio" the median over rounds of the rival's time by ours with its 95% interval.
std::unique_ptr<Subject> duel(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> rival,
                              const std::string& phase);

}  // namespace pelage
