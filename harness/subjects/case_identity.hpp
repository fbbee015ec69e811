// The identity of a case: hashes of all inputs of its measurement (harness/record/identity.hpp).
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns one hash for each input of a measurement. Loads the mesh of the scene from the cache, or prepares
/// it. Throws InputError if the scene or the mesh is not valid.
Identity case_identity(SubjectContext& context, const Case& which, const SamplingLimits& limits);

/// Returns the identity that a case would get now: `planned`, plus the present hashes of the programs,
/// shaders and renderer that `recorded`, the identity in the case's row, has. A program whose source file is
/// missing has no hash.
Identity present_identity(Identity planned, const Identity& recorded);

/// A row of a journal, and the case of the present experiment to which it belongs.
struct KeptRow {
  const Row* row;
  const Case* which;
};

/// Throws InputError if the inputs that a row records differ from the present inputs of its case, or if a row
/// has no identity, because an older version of pelage wrote it. The message names the journal `file`, the
/// case and the inputs that differ. `identity` returns the identity of a case without programs, shaders and
/// OpenGL renderer.
void refuse_other_inputs(const std::string& file, const std::vector<KeptRow>& kept,
                         const std::function<Identity(const Case&)>& identity);

}  // namespace pelage
