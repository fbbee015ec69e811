#include "harness/strands/opencl/skin_drawer.hpp"

#include <fmt/format.h>

#include <span>
#include <vector>

#include "harness/error.hpp"

namespace pelage::strands {
namespace {

constexpr std::size_t vertex_record = 6;  // VERTEX_RECORD of skin.cl

std::vector<float> flat(const std::vector<glm::vec3>& vectors) {
  std::vector<float> values;
  values.reserve(3 * vectors.size());
  for (const glm::vec3& v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
  return values;
}

std::vector<std::int32_t> flat(const std::vector<glm::uvec3>& triangles) {
  std::vector<std::int32_t> values;
  values.reserve(3 * triangles.size());
  for (const glm::uvec3& t : triangles)
    values.insert(values.end(), {std::int32_t(t.x), std::int32_t(t.y), std::int32_t(t.z)});
  return values;
}

template <class T>
cl::Buffer<T> on_device(const cl::Queue& queue, const std::vector<T>& values) {
  return cl::Buffer<T>(queue, std::span<const T>(values));
}

}  // namespace

SkinDrawer::SkinDrawer(const cl::Queue& queue, const DrawParams& params, const SkinSurface& skin,
                       const std::string& options)
    : vertices_(int(skin.position.size())),
      triangles_(int(skin.triangle.size())),
      program_(queue.device(), "strands/draw/skin.cl", options + " -D LANES=1"),
      make_vertices_(program_, "skin_vertices"),
      clear_(program_, "skin_clear"),
      find_depth_(program_, "skin_depth"),
      find_owner_(program_, "skin_owner"),
      colour_pixels_(program_, "skin_colours") {
  if (triangles_ == 0) throw InputError("skin of the strands: no triangles; give at least one");
  const cl::Device& device = queue.device();
  const std::size_t pixels = std::size_t(params.width) * std::size_t(params.height);
  position_ = on_device(queue, flat(skin.position));
  normal_ = on_device(queue, flat(skin.normal));
  colour_ = on_device(queue, flat(skin.colour));
  index_ = on_device(queue, flat(skin.triangle));
  vertex_ = cl::Buffer<float>(device, skin.position.size() * vertex_record);
  owner_ = cl::Buffer<std::int32_t>(device, pixels);
  depth_ = cl::Buffer<std::uint32_t>(device, pixels);
  pixels_ = cl::Buffer<glm::vec4>(device, pixels);
}

void SkinDrawer::enqueue(const cl::Queue& queue, const DrawParams& params, const cl::Buffer<glm::vec2>& map,
                         cl::PhaseEvents* events) {
  const auto launch = [&](const cl::Kernel& kernel, std::size_t items) {
    cl::Event event = kernel.enqueue(queue, (items + 63) / 64 * 64, 64);
    if (events) events->emplace_back("skin", std::move(event));
  };
  make_vertices_.with(params, vertices_, position_, normal_, colour_, map, vertex_);
  launch(make_vertices_, std::size_t(vertices_));
  clear_.with(int(depth_.size()), depth_, owner_);
  launch(clear_, depth_.size());
  find_depth_.with(params, triangles_, index_, vertex_, depth_);
  launch(find_depth_, std::size_t(triangles_));
  find_owner_.with(params, triangles_, index_, vertex_, depth_, owner_);
  launch(find_owner_, std::size_t(triangles_));
  colour_pixels_.with(params, index_, vertex_, depth_, owner_, pixels_);
  launch(colour_pixels_, depth_.size());
}

}  // namespace pelage::strands
