#include "harness/shells/opencl/reach_stage.hpp"

#include <algorithm>
#include <utility>

namespace pelage::shells {

ReachStage::ReachStage(const cl::Queue& queue, const cl::Program& geometry, const RasterParams& params,
                       bool changes, const cl::Buffer<float>& uv, const cl::Buffer<std::int32_t>& corner)
    : changes_(changes),
      triangles_(geometry, "triangle_reach"),
      clumps_(geometry, "texel_clumps"),
      texels_(geometry, "texel_reach"),
      by_texel_(geometry, "triangle_reach_by_texel") {
  if (!changes) return;
  const cl::Device& device = queue.device();
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

std::size_t work_items(const cl::Device& device, int count) {
  const std::size_t all = std::size_t(count);
  return device.info().cpu ? std::min(all, 32 * std::size_t(device.info().compute_units)) : all;
}

}  // namespace pelage::shells
