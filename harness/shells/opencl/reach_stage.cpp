#include "harness/shells/opencl/raster_stage.hpp"

namespace pelage::shells {

ReachStage::ReachStage(const cl::Queue& queue, const cl::ProgramText& text, int lanes,
                       const RasterParams& params, bool changes, const cl::Buffer<float>& uv,
                       const cl::Buffer<std::int32_t>& corner)
    : lanes_(lanes),
      changes_(changes),
      by_footprint_(!changes && params.clump_cells == CELLS_CONSISTENT && params.every_layer == 0),
      program_(queue.device(), text),
      dryness_(program_, "vertex_dryness"),
      triangles_(program_, "triangle_reach"),
      clumps_(program_, "texel_clumps"),
      texels_(program_, "texel_reach"),
      by_texel_(program_, "triangle_reach_by_texel"),
      repeats_(program_, "mask_repeats"),
      footprints_(program_, "triangle_reach_by_footprint"),
      in_view_(program_, "reach_in_view") {
  const cl::Device& device = queue.device();
  // Columns of the number of triangles, rounded up to a multiple of 16 (padded_triangles() in
  // footprint_reach.clh).
  if (by_footprint_)
    reaches_ =
        cl::Buffer<std::int32_t>(device, FOOTPRINTS / 2 * ((std::size_t(params.triangles) + 15) / 16 * 16));
  if (by_footprint_)
    repeat_ = cl::Buffer<std::uint32_t>(
        device, 2 * std::size_t(REPEAT_WORDS(params.mask_size)) * std::size_t(params.mask_size));
  if (!changes) return;
  const std::size_t texels = std::size_t(params.mask_size) * std::size_t(params.mask_size);
  range_ = cl::Buffer<std::int32_t>(device, 2 * std::size_t(params.triangles));
  number_ = cl::Buffer<std::int32_t>(device, texels);
  reach_ = cl::Buffer<std::uint16_t>(device, texels);
  cl::Kernel ranges(program_, "triangle_texels");
  ranges.with(params, uv, corner, range_);
  const cl::Event event = ranges.enqueue_loop(queue, std::size_t(params.triangles));
}

void ReachStage::dry(const cl::Queue& queue, const RasterParams& params, const cl::Buffer<float>& mask_uv,
                     RasterBuffers& buffers, cl::PhaseEvents* events) {
  dryness_.with(params, mask_uv, *buffers.mask, buffers.dry);
  cl::keep(events, "wet", dryness_.enqueue(queue, std::size_t(params.vertices / lanes_)));
}

void ReachStage::run(const cl::Queue& queue, const RasterParams& params, const cl::Buffer<float>& uv,
                     RasterBuffers& buffers, cl::PhaseEvents* events) {
  const cl::Buffer<float>& layer_table = buffers.layer_table;
  const cl::Buffer<glm::vec4>& mask = *buffers.mask;
  cl::Buffer<std::int32_t>& corner = buffers.corner;
  const auto launch = [&](cl::Kernel& kernel, int count) {
    cl::keep(events, "wet", kernel.enqueue_loop(queue, std::size_t(count)));
  };
  if (depends_on_view()) {
    repeats_.with(params, mask, repeat_);
    launch(repeats_, REPEAT_WORDS(params.mask_size) * params.mask_size);
    footprints_.with(params, layer_table, uv, mask, repeat_, reaches_, corner);
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
                              cl::Buffer<std::int32_t>& corner, std::size_t blocks) {
  in_view_.with(params, reaches_, record, box, corner);
  return in_view_.enqueue_loop(queue, blocks);
}

}  // namespace pelage::shells
