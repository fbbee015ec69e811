#include <fmt/format.h>

#include <algorithm>

#include "harness/error.hpp"
#include "harness/strands/opencl/drawer.hpp"

namespace pelage::strands {
namespace {

constexpr std::size_t vertex_record = 8;  // VERTEX_RECORD of skin.cl

/// Room for `count` elements in groups of at most 16.
std::size_t padded(std::size_t count) {
  return (count + 15) / 16 * 16;
}

}  // namespace

SkinDrawer::SkinDrawer(const cl::Queue& queue, const DrawParams& params, const SkinSurface& skin, int lanes,
                       const cl::ProgramText& text)
    : vertices_(int(skin.position.size())),
      triangles_(int(skin.triangle.size())),
      pixel_count_(params.width * params.height),
      lanes_(lanes),
      program_(queue.device(), text),
      make_vertices_(program_, "skin_vertices"),
      clear_(program_, "skin_clear"),
      find_depth_(program_, "skin_depth"),
      find_owner_(program_, "skin_owner"),
      colour_pixels_(program_, "skin_colours") {
  if (triangles_ == 0) throw InputError("skin of the strands: no triangles; give at least one");
  const cl::Device& device = queue.device();
  const std::size_t pixels = padded(std::size_t(params.width) * std::size_t(params.height));
  position_ = cl::uploaded(queue, skin.position);
  normal_ = cl::uploaded(queue, skin.normal);
  colour_ = cl::uploaded(queue, skin.colour);
  index_ = cl::uploaded(queue, skin.triangle);
  vertex_ = cl::Buffer<float>(device, padded(skin.position.size()) * vertex_record);
  owner_ = cl::Buffer<std::int32_t>(device, pixels);
  depth_ = cl::Buffer<std::uint32_t>(device, pixels);
  pixels_ = cl::Buffer<glm::vec4>(device, pixels);
}

void SkinDrawer::deform(const cl::Queue& queue, const SkinSurface& skin) {
  if (int(skin.position.size()) != vertices_ || int(skin.normal.size()) != vertices_)
    throw InputError(fmt::format("skin of the strands: {} positions and {} normals for {} vertices",
                                 skin.position.size(), skin.normal.size(), vertices_));
  position_.write(queue, skin.position);
  normal_.write(queue, skin.normal);
}

void SkinDrawer::enqueue(const cl::Queue& queue, const DrawParams& params, const cl::Buffer<glm::vec4>& map,
                         cl::PhaseEvents* events) {
  const cl::DeviceInfo& device = queue.device().info();
  // PoCL copies the parameters of a kernel for each work-item, so on a CPU a work-item computes many groups
  // of `lanes_` elements. There are enough work-items to distribute them evenly over the cores.
  const auto per_item = [&](int count) {
    const int groups = (count + lanes_ - 1) / lanes_;
    const int items = device.cpu ? 32 * int(device.compute_units) : groups;
    return std::max(1, (groups + items - 1) / items);
  };
  const auto launch = [&](const cl::Kernel& kernel, int count) {
    const int each = lanes_ * per_item(count);
    cl::keep(events, "skin", kernel.enqueue(queue, std::size_t((count + each - 1) / each)));
  };
  make_vertices_.with(params, per_item(vertices_), vertices_, position_, normal_, colour_, map, vertex_);
  launch(make_vertices_, vertices_);
  clear_.with(per_item(pixel_count_), pixel_count_, depth_, owner_);
  launch(clear_, pixel_count_);
  find_depth_.with(params, per_item(triangles_), triangles_, index_, vertex_, depth_);
  launch(find_depth_, triangles_);
  find_owner_.with(params, per_item(triangles_), triangles_, index_, vertex_, depth_, owner_);
  launch(find_owner_, triangles_);
  colour_pixels_.with(params, per_item(pixel_count_), pixel_count_, index_, vertex_, depth_, owner_, pixels_);
  launch(colour_pixels_, pixel_count_);
}

}  // namespace pelage::strands
