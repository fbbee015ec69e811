// Times a pipeline in turns with an OpenGL baseline that draws the same picture.
#pragma once
#include <memory>

#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject that draws in every round one frame of `ours` and then one frame of the baseline
/// `theirs`, the phase "opengl" (harness/measure/turns.hpp). An additional check requires that the PSNR
/// between the two pictures is at least tolerance::other_filter_psnr. The row also has the baseline's
/// identity and provenance, and the time of its build as the metric "opengl_build_ms".
std::unique_ptr<Subject> with_opengl(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> theirs);

}  // namespace pelage
