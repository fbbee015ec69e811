// Writes all inputs and intermediate results of a frame to a file, so that another program can check each
// stage.
#pragma once
#include <filesystem>

#include "harness/compare/frame_output.hpp"

namespace pelage {

/// Writes the datasets of docs/dump.md as HDF5, each with the attributes "units" and
/// "description". `output` holds tips, velocities, mask and image of the frame that `input` describes. If
/// writing fails, no partial file remains. Throws InputError if the file cannot be written.
void dump_frame(const std::filesystem::path& path, const FrameInput& input, const FrameOutput& output);

/// Throws InputError if `path` does not end in .h5 or .hdf5, or if its folder does not exist. Call this
/// function before the frame is computed, so that a bad path is reported early.
void check_dump_path(const std::filesystem::path& path);

}  // namespace pelage
