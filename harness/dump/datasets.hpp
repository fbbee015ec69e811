// The datasets of a dump, group by group: what docs/frame.md, section 8, lists.
#pragma once
#include <span>
#include <vector>

#include "harness/compare/frame_output.hpp"
#include "harness/picture/hdf5_file.hpp"

namespace pelage::dump {

/// Vectors of floats (or bytes, or indices) as one flat array.
template <class Scalar, class Vector>
std::span<const Scalar> flat(const std::vector<Vector>& values) {
  static_assert(sizeof(Vector) % sizeof(Scalar) == 0);
  return {reinterpret_cast<const Scalar*>(values.data()), values.size() * (sizeof(Vector) / sizeof(Scalar))};
}

void write_scene_text(Hdf5File& file, const Scene& scene);
void write_mesh(Hdf5File& file, const FrameInput& input);
void write_strands(Hdf5File& file, const FrameInput& input, const FrameOutput& output);
void write_wetness(Hdf5File& file, const FrameInput& input, const FrameOutput& output);
void write_textures(Hdf5File& file, const FrameInput& input);
void write_camera(Hdf5File& file, const Camera& camera);

/// Where the layers lie: computed by the double-precision reference from the scene's strands, or from the
/// output's tips where a topology moves the fur.
void write_layers(Hdf5File& file, const FrameInput& input, const FrameOutput& output);

}  // namespace pelage::dump
