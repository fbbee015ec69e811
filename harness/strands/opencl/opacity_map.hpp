// The opacity map of the key light on an OpenCL device. docs/strands.md, section Shadow, defines the map.
#pragma once
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/opencl/program_texts.hpp"
#include "harness/strands/opencl/tile_lists.hpp"

namespace pelage::strands {

/// The buffers of a picture that its opacity map also uses.
struct PictureBuffers {
  const cl::Buffer<float>&constants, &keys;
  const cl::Buffer<std::int32_t>&layers, &film;
};

class OpacityMap {
 public:
  /// `kinds`, `picture`: of the picture for which the map is made. params.chunks and runs must be set, and
  /// `padded` is the number of strands, rounded up to a multiple of 16.
  OpacityMap(const cl::Queue& queue, const DrawParams& params, const LightView& view,
             const PictureKinds& kinds, const DrawerLayout& picture, std::size_t padded);

  /// Enqueues the kernels that draw the map, all in the phase `shadow`. `params` describes the picture.
  void enqueue(const cl::Queue& queue, const DrawParams& params, const LightView& view,
               const PictureBuffers& buffers, cl::PhaseEvents* events);

  /// The texels, row by row: least depth of the fragments in R (NO_DEPTH: none), 1 / D in 1/R
  /// (docs/strands.md, section Shadow), transmittance 1 - A, and 0.
  const cl::Buffer<glm::vec4>& texels() const { return texels_; }
  std::size_t listed() const { return lists_.listed(); }  ///< see Drawer::listed()
  std::vector<const cl::Program*> programs() const;

 private:
  DrawerLayout layout_;
  PictureTexts texts_;
  cl::Program key_program_, draw_program_;
  cl::Kernel make_keys_, draw_;
  TileLists lists_;
  cl::Buffer<float> rows_, curves_;
  cl::Buffer<std::uint64_t> blocks_;
  cl::Buffer<cl::Pair> pairs_;
  cl::Buffer<std::int32_t> live_, total_;
  cl::Buffer<glm::vec4> texels_, no_map_;
  cl::Buffer<glm::vec4> no_skin_;
  int strands_ = -1;  ///< the number in total_
};

/// Sets the rows of `params` with which a kernel finds a point of the picture in the opacity map.
void set_map_rows(DrawParams& params, const Camera& camera, const Look& look);

}  // namespace pelage::strands
