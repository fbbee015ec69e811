// The OpenCL pipeline as a subject that the harness can time.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject that draws the case's scene on the context's device with the case's mapping of pixels to
/// work-items. Its check() compares a timed picture with the reference renderer's picture.
std::unique_ptr<Subject> make_shells(SubjectContext& context, const Case& which);

}  // namespace pelage
