// The device buffers that the drawing kernel of every mapping takes as arguments.
#pragma once
#include <cstdint>
#include <glm/vec4.hpp>

#include "harness/cl/program.hpp"
#include "kernels/rasterize/params.h"

namespace pelage::shells {

/// kernels/rasterize/buffers.clh declares these buffers in the same order as this struct.
struct RasterBuffers {
  cl::Buffer<float> layer_table;
  /// Four values per triangle: three vertex indices, and the number of layers in which the triangle is drawn.
  cl::Buffer<std::int32_t> corner;
  cl::Buffer<float> screen, box;
  cl::Buffer<float> vertex;                ///< VERTEX_COLUMNS columns, each with one float per vertex
  const cl::Buffer<float>* tip = nullptr;  ///< tip offset B (docs/shells.md, section 3), columns x, y, z
  cl::Buffer<float> dry;
  cl::Buffer<std::int32_t> list_start, list;
  cl::Buffer<float> record, tangent, curl;
  cl::Buffer<std::int32_t> fur, coat;
  const cl::Buffer<glm::vec4>* mask = nullptr;  ///< one value per texel
  cl::Buffer<glm::vec4> image;
  cl::Buffer<std::uint32_t> covered;

  /// Sets all arguments of a drawing kernel: `params`, the buffers, then `more`.
  template <class... More>
  void set(cl::Kernel& kernel, const RasterParams& params, const More&... more) const {
    kernel.with(params, layer_table, corner, screen, box, vertex, *tip, dry, list_start, list, record,
                tangent, curl, fur, coat, *mask, image, covered, more...);
  }
};

}  // namespace pelage::shells
