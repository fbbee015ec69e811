// The identity of a case: hashes of all inputs of its measurement (harness/record/identity.hpp).
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns one hash for each input of a measurement: scene, mesh, variant, tuning, sampling, device and
/// build. Loads the mesh of the scene from the cache, or prepares the mesh if the cache does not contain it.
/// Throws InputError if the scene or the mesh is not valid.
Identity case_identity(SubjectContext& context, const Case& which, const SamplingLimits& limits);

/// Returns the identity that a case would get now. `planned` is this identity without the hashes of programs,
/// shaders and OpenGL renderer. `recorded` is the identity in the case's row of a journal (a file of
/// results). If `recorded` has the hash of a program, of the shaders or of the renderer, the function adds
/// the present hash to `planned`. If the source file of a program is missing, the identity has no hash for
/// this program.
Identity present_identity(Identity planned, const Identity& recorded);

/// A row of a journal (a file of results), and the case of the present experiment to which the row belongs.
struct KeptRow {
  const Row* row;
  const Case* which;
};

/// Throws InputError if the inputs that a row records differ from the present inputs of the row's case. Also
/// throws InputError if a row has no identity, because an older version of pelage wrote the row. `file` is
/// the path of the journal. The message names the journal, the case and the inputs that differ. `identity`
/// returns the identity of a case without the hashes of programs, shaders and OpenGL renderer.
void refuse_other_inputs(const std::string& file, const std::vector<KeptRow>& kept,
                         const std::function<Identity(const Case&)>& identity);

}  // namespace pelage
