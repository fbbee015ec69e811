// The shell pipeline as a subject of the harness.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// The case's scene on the context's device by the case's mapping; every timed frame is compared with the
/// reference.
std::unique_ptr<Subject> make_shells(SubjectContext& context, const Case& which);

}  // namespace pelage
