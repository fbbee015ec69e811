// Draws the skin below strands on an OpenCL device. docs/strands.md, section Skin, defines the picture.
#pragma once
#include <glm/vec4.hpp>
#include <string>

#include "harness/cl/program.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "kernels/strands/draw/params.h"

namespace pelage::strands {

class SkinDrawer {
 public:
  /// `params.width` and `params.height` must be set. `lanes`: number of vertices, triangles or pixels that a
  /// work-item computes at a time, 1 or 16. `text`: skin_text() with the same `lanes`. Throws InputError if
  /// the surface has no triangles.
  SkinDrawer(const cl::Queue& queue, const DrawParams& params, const SkinSurface& skin, int lanes,
             const cl::ProgramText& text);

  /// Enqueues the kernels that draw the skin. Their launches belong to the phase `skin`. `map` has the texels
  /// of the opacity map.
  void enqueue(const cl::Queue& queue, const DrawParams& params, const cl::Buffer<glm::vec4>& map,
               cl::PhaseEvents* events);

  /// Replaces the positions and normals of the vertices. Throws InputError if their number is wrong.
  void deform(const cl::Queue& queue, const SkinSurface& skin);

  /// Returns the pixels, row by row. A pixel has red, green, blue and the view depth in R. The depth is
  /// NO_DEPTH if the pixel has no skin.
  const cl::Buffer<glm::vec4>& pixels() const { return pixels_; }
  const cl::Program& program() const { return program_; }
  std::size_t vertices() const { return std::size_t(vertices_); }

 private:
  int vertices_, triangles_, pixel_count_, lanes_;
  cl::Program program_;
  cl::Kernel make_vertices_, clear_, find_depth_, find_owner_, colour_pixels_;
  cl::Buffer<float> position_, normal_, colour_, vertex_;
  cl::Buffer<std::int32_t> index_, owner_;
  cl::Buffer<std::uint32_t> depth_;
  cl::Buffer<glm::vec4> pixels_;
};

}  // namespace pelage::strands
