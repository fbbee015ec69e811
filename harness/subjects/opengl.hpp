// Times the OpenGL baseline (docs/rival.md): the OpenGL pipeline of the papers by Silva et al. 2010.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject that times only the OpenGL baseline. The field `opengl` of `which` contains the
/// baseline's implementation options (docs/rival.md). Throws Unsupported if OpenGL is unavailable.
std::unique_ptr<Subject> make_opengl(SubjectContext& context, const Case& which);

}  // namespace pelage
