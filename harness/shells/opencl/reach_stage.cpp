#include "harness/shells/opencl/reach_stage.hpp"

#include <algorithm>
#include <utility>

namespace pelage::shells {

ReachStage::ReachStage(const cl::Queue& queue, const cl::Program& geometry, const RasterParams& params,
                       bool changes, const cl::Buffer<float>& uv, const cl::Buffer<std::int32_t>& corner)
    : changes_(changes),
      by_footprint_(!changes && params.clump_cells == CELLS_CONSISTENT && params.every_layer == 0),
      triangles_(geometry, "triangle_reach"),
      clumps_(geometry, "texel_clumps"),
      texels_(geometry, "texel_reach"),
      by_texel_(geometry, "triangle_reach_by_texel"),
      footprints_(geometry, "triangle_reach_by_footprint"),
      in_view_(geometry, "reach_in_view") {
  const cl::Device& device = queue.device();
  // Columns of the number of triangles, rounded up to a multiple of 16 (padded_triangles() in
  // footprint_reach.clh).
  if (by_footprint_)
    reaches_ =
        cl::Buffer<std::int32_t>(device, FOOTPRINTS / 2 * ((std::size_t(params.triangles) + 15) / 16 * 16));
  if (!changes) return;
  const std::size_t texels = std::size_t(params.mask_size) * std::size_t(params.mask_size);
  range_ = cl::Buffer<std::int32_t>(device, 2 * std::size_t(params.triangles));
  number_ = cl::Buffer<std::int32_t>(device, texels);
  reach_ = cl::Buffer<std::uint16_t>(device, texels);
  cl::Kernel ranges(geometry, "triangle_texels");
  ranges.with(params, uv, corner, range_);
  const cl::Event event = ranges.enqueue(queue, work_items(device, params.triangles));
}

void ReachStage::run(const cl::Queue& queue, const RasterParams& params, const cl::Buffer<float>& layer_table,
                     const cl::Buffer<float>& uv, const cl::Buffer<float>& mask,
                     cl::Buffer<std::int32_t>& corner, cl::PhaseEvents* events) {
  const auto launch = [&](cl::Kernel& kernel, int count) {
    cl::Event event = kernel.enqueue(queue, work_items(queue.device(), count));
    if (events) events->emplace_back("wet", std::move(event));
  };
  if (by_footprint_) {
    footprints_.with(params, layer_table, uv, mask, reaches_, corner);
    return launch(footprints_, params.triangles);
  }
  if (!changes_) {
    triangles_.with(params, layer_table, uv, mask, corner);
    return launch(triangles_, params.triangles);
  }
  const int texels = params.mask_size * params.mask_size;
  clumps_.with(params, mask, number_);
  launch(clumps_, texels);
  texels_.with(params, layer_table, mask, number_, reach_);
  launch(texels_, texels);
  by_texel_.with(params, range_, reach_, corner);
  launch(by_texel_, params.triangles);
}

cl::Event ReachStage::in_view(const cl::Queue& queue, const RasterParams& params,
                              const cl::Buffer<float>& record, const cl::Buffer<float>& box,
                              cl::Buffer<std::int32_t>& corner, std::size_t items) {
  in_view_.with(params, reaches_, record, box, corner);
  return in_view_.enqueue(queue, items);
}

std::size_t work_items(const cl::Device& device, int count) {
  const std::size_t all = std::size_t(count);
  return device.info().cpu ? std::min(all, 32 * std::size_t(device.info().compute_units)) : all;
}

}  // namespace pelage::shells
