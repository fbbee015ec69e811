// Pictures of strands as a subject that the harness can time.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject that simulates the case's scene as single strands on the context's device and draws
/// them. Its check() compares a time step of the chains, the curves, the order and a timed picture with the
/// reference.
std::unique_ptr<Subject> make_strand_frames(SubjectContext& context, const Case& which);

/// Returns a subject that draws, in every round, a picture by the device and a picture by the OpenGL baseline
/// (harness/strands/opengl/ribbons.hpp), as with_opengl() does. Both draw the same key strands, and neither
/// time contains a simulation. The case's field `opengl` has the baseline's options (ribbon_options()).
/// Throws Unsupported if OpenGL is unavailable, or if the scene has other lights than the key light and
/// ambient light, or a shadow, which the baseline does not draw.
std::unique_ptr<Subject> make_strands_against_opengl(SubjectContext& context, const Case& which);

}  // namespace pelage
