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

/// The same parameters with the capacity of the picture, which suffices for all strands in every view.
DrawParams with_capacity(DrawParams map, const DrawParams& picture) {
  map.capacity = picture.capacity;
  return map;
}

}  // namespace

OpacityMap::OpacityMap(const cl::Queue& queue, const DrawParams& params, const LightView& view,
                       const PictureKinds& kinds, const DrawerLayout& picture, std::size_t padded)
    : layout_(map_layout(picture)),
      pass_(queue, with_capacity(map_params(params, view, layout_.lanes, layout_.tile), params),
            picture_texts(kinds, layout_, true, false), layout_, padded),
      total_(queue.device(), 1),
      nothing_(queue.device(), 1) {}

void OpacityMap::enqueue(const cl::Queue& queue, const DrawParams& params, const LightView& view,
                         const PictureBuffers& buffers, cl::PhaseEvents* events) {
  const DrawParams p = map_params(params, view, layout_.lanes, layout_.tile);
  if (p.strands != strands_) {
    const std::array<std::int32_t, 1> total{p.strands};
    total_.write(queue, total);
    strands_ = p.strands;
  }
  pass_.make_keys(queue, p, buffers.constants, buffers.keys, buffers.layers, "shadow", events);
  pass_.draw(queue, p, total_, buffers.film, nothing_, nothing_, "shadow", "shadow", events);
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
