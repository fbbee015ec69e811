// The dump of a picture of strands as an HDF5 file. docs/dump.md, section Strands, lists the datasets.
#pragma once
#include <filesystem>
#include <string>

#include "harness/compare/strands.hpp"

namespace pelage {

/// Writes all inputs and intermediate arrays of a picture of strands. `pipeline` names the pipeline that
/// computed the frame, and `frames` is the number of frames simulated from rest. Throws InputError if the
/// file cannot be written.
void dump_strands(const std::filesystem::path& path, const strands::StrandInput& input,
                  const StrandFrame& frame, const std::string& pipeline, int frames);

}  // namespace pelage
