// A frame in a file: every input and every intermediate of it, for a reader who checks a stage by another
// program.
#pragma once
#include <filesystem>

#include "harness/compare/frame_output.hpp"

namespace pelage {

/// Writes the datasets of docs/frame.md, section 8, as HDF5, each with the attributes "units" and
/// "description". `output` holds tips, velocities, mask and image of the frame `input` describes. The file is
/// there whole or not at all. Throws InputError.
void dump_frame(const std::filesystem::path& path, const FrameInput& input, const FrameOutput& output);

/// Throws InputError when `path` does not end in .h5 or its folder does not exist: before the work, not after
/// it.
void check_dump_path(const std::filesystem::path& path);

}  // namespace pelage
