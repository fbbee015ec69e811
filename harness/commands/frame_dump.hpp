// Every intermediate of a frame, for whoever wants to check a stage on their own.
#pragma once
#include <filesystem>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// What a pipeline computed of a frame.
struct FrameOutput {
  std::string pipeline;         ///< "shells on DEVICE" or "reference"
  int frames = 0;               ///< frames of strand motion since rest, this one included
  std::vector<glm::vec3> tips;  ///< F, p minus root, R
  std::vector<glm::vec4> mask;  ///< wetness.size^2: c_u, c_v, r, rho
  Picture image;
};

/// Tips and mask by the double-precision reference; no image.
FrameOutput reference_motion(const FrameInput& input, int frames);

/// The same with the image.
FrameOutput reference_output(const FrameInput& input, int frames, bool eight_bit);

/// Writes an HDF5 file: mesh, strand, mask, fur, colour, layer, camera, image; each dataset with units and a
/// description, the scene as TOML in the file's attributes. Whole or absent. Throws InputError.
void dump_frame(const std::filesystem::path& path, const FrameInput& input, const FrameOutput& output);

/// Throws InputError when `path` does not end in .h5 or its folder does not exist: before the work, not after
/// it.
void check_dump_path(const std::filesystem::path& path);

}  // namespace pelage
