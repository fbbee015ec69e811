#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "harness/strands/opencl/drawer.hpp"

namespace pelage::strands {
namespace {

using cl::copy;

/// The parameters of the map. `params` are those of the picture.
DrawParams map_params(DrawParams params, const LightView& view, int lanes, int tile) {
  params.width = params.height = view.size;
  params.tiles_x = params.tiles_y = (view.size + tile - 1) / tile;
  copy(params.row_x, view.row_x);
  copy(params.row_y, view.row_y);
  copy(params.row_w, view.row_z);
  params.near_depth = -NO_DEPTH;  // the near plane cuts no strand
  params.pixel = view.texel;
  params.half_per_width = 0.5f / view.texel;
  // All strands are listed, so that the lists of the runs follow each other without gaps.
  params.capacity = params.units_per_run * lanes;
  params.keep_curves = 0;
  return params;
}

}  // namespace

OpacityMap::OpacityMap(const cl::Queue& queue, const DrawParams& params, const LightView& view,
                       const PictureKinds& kinds, const DrawerLayout& picture, std::size_t padded)
    : layout_(map_layout(picture)),
      texts_(picture_texts(kinds, layout_, true, false)),
      key_program_(queue.device(), texts_.keys),
      draw_program_(queue.device(), texts_.draw),
      make_keys_(key_program_, "strand_keys"),
      draw_(draw_program_, layout_.group ? "strand_group" : "strand_tiles"),
      lists_(queue, map_params(params, view, layout_.lanes, layout_.tile), texts_.lists) {
  const cl::Device& device = queue.device();
  rows_ = cl::Buffer<float>(device, padded * STRAND_ROW);
  curves_ = cl::Buffer<float>(device, 1);
  blocks_ = cl::Buffer<std::uint64_t>(device, padded);
  pairs_ = cl::Buffer<cl::Pair>(device, std::size_t(params.capacity) * std::size_t(params.runs));
  live_ = cl::Buffer<std::int32_t>(device, std::size_t(params.runs));
  total_ = cl::Buffer<std::int32_t>(device, 1);
  no_map_ = cl::Buffer<glm::vec4>(device, 1);
  no_skin_ = cl::Buffer<glm::vec4>(device, 1);
  texels_ = cl::Buffer<glm::vec4>(device, std::size_t(view.size) * std::size_t(view.size));
}

void OpacityMap::enqueue(const cl::Queue& queue, const DrawParams& params, const LightView& view,
                         const PictureBuffers& buffers, cl::PhaseEvents* events) {
  const DrawParams p = map_params(params, view, layout_.lanes, layout_.tile);
  if (p.strands != strands_) {
    const std::array<std::int32_t, 1> total{p.strands};
    total_.write(queue, total);
    strands_ = p.strands;
  }
  make_keys_.with(p, buffers.constants, buffers.keys, buffers.layers, rows_, blocks_, pairs_, live_, curves_);
  cl::Event made = make_keys_.enqueue(queue, std::size_t(p.runs));
  if (events) events->emplace_back("shadow", std::move(made));
  lists_.enqueue(queue, p, total_, blocks_, pairs_, "shadow", events);
  // The kernels that draw the map read neither a map nor a skin.
  cl::Event drawn = lists_.draw(queue, draw_, layout_.group, layout_.tile, p, rows_, buffers.film, no_map_,
                                no_skin_, texels_);
  if (events) events->emplace_back("shadow", std::move(drawn));
}

std::vector<const cl::Program*> OpacityMap::programs() const {
  return {&key_program_, &lists_.program(), &draw_program_};
}

void set_map_rows(DrawParams& params, const Camera& camera, const Look& look) {
  const LightView light = light_view(look);
  // The columns of a matrix of GLM are the rows of the camera, so `camera_of` transposed maps (p, 1) to
  // (X, Y, W, 1).
  const glm::dmat4 camera_of(glm::dvec4(camera.row_x), glm::dvec4(camera.row_y), glm::dvec4(camera.row_w),
                             glm::dvec4(0, 0, 0, 1));
  const glm::dmat4 inverse = glm::inverse(camera_of);
  // row . (p, 1) = (row M^-1) . (X, Y, W, 1), with the matrix M whose rows are those of the camera.
  const auto from_view = [&](glm::dvec4 row) { return inverse * row; };
  const glm::dvec4 centre(0, 0, 0, 0.5 * light.size - 0.5);
  copy(params.map_x, glm::vec4(from_view(glm::dvec4(light.row_x)) + centre));
  copy(params.map_y, glm::vec4(from_view(glm::dvec4(light.row_y)) + centre));
  copy(params.map_z, glm::vec4(from_view(glm::dvec4(light.row_z))));
  params.map_size = light.size;
  params.per_shadow_length = 1 / look.shadow.length;
}

}  // namespace pelage::strands
