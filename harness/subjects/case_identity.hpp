// The identity of a case: hashes of all inputs of its measurement (harness/journal/identity.hpp).
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns the parts scene, mesh, variant, tuning, sampling and device. Loads the mesh of the scene, and
/// prepares it if the cache does not contain it. Throws InputError if the scene or the mesh is not valid.
Identity case_identity(SubjectContext& context, const Case& which, const SamplingLimits& limits);

/// Returns the identity that the case would get now: `planned` and the present hashes of the programs and
/// shaders that `recorded` contains. A program whose file is missing gets no part.
Identity present_identity(Identity planned, const Identity& recorded);

/// A row of a journal and the case that would be run now under the same key.
struct KeptRow {
  const Row* row;
  const Case* which;
};

/// Throws InputError if a row measured other inputs than its case has now, or has no identity because an
/// older version wrote it. `file` is the journal's path. The message names it, the case and the parts that
/// differ. `identity` returns the identity of a case without programs.
void refuse_other_inputs(const std::string& file, const std::vector<KeptRow>& kept,
                         const std::function<Identity(const Case&)>& identity);

}  // namespace pelage
