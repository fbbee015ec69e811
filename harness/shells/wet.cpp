#include <algorithm>
#include <chrono>
#include <cmath>

#include "harness/shells/stages.hpp"
#include "kernels/wet/params.h"

namespace pelage::shells {
namespace {

constexpr int bucket_texels = 16;

// Droplets by square of texels that their disc may reach, in their own order.
struct Buckets {
  std::vector<std::int32_t> row, drop;
};

Buckets in_buckets(const std::vector<Droplet>& droplets, int size) {
  const int side = (size + bucket_texels - 1) / bucket_texels;
  std::vector<std::vector<std::int32_t>> lists(std::size_t(side) * std::size_t(side));
  const auto bucket = [&](float coordinate) {
    const float texel = std::clamp(coordinate * float(size), 0.0f, float(size - 1));
    return int(texel) / bucket_texels;
  };
  const float margin = 1.0f / float(size);
  for (std::size_t i = 0; i < droplets.size(); ++i) {
    const Droplet& d = droplets[i];
    const float reach = d.radius + margin;
    for (int y = bucket(d.centre.y - reach); y <= bucket(d.centre.y + reach); ++y)
      for (int x = bucket(d.centre.x - reach); x <= bucket(d.centre.x + reach); ++x)
        lists[std::size_t(y) * std::size_t(side) + std::size_t(x)].push_back(std::int32_t(i));
  }
  Buckets b;
  b.row.push_back(0);
  for (const auto& list : lists) {
    b.drop.insert(b.drop.end(), list.begin(), list.end());
    b.row.push_back(std::int32_t(b.drop.size()));
  }
  return b;
}

std::vector<float> droplet_rows(const std::vector<Droplet>& droplets) {
  std::vector<float> rows;
  for (const Droplet& d : droplets)
    rows.insert(rows.end(),
                {d.centre.x, d.centre.y, d.radius, d.wetness, d.point.x, d.point.y, d.point.z, d.reach});
  return rows;
}

std::vector<float> flat(const std::vector<glm::vec3>& points) {
  std::vector<float> values;
  values.reserve(points.size() * 3);
  for (const glm::vec3& p : points) values.insert(values.end(), {p.x, p.y, p.z});
  return values;
}

}  // namespace

WetStage::WetStage(const cl::Queue& queue, const FrameInput& input)
    : program_(queue.device(), "wet/wet.cl", build_options(queue.device(), 1, {})) {
  const int size = input.scene.wetness.size;
  const auto texels = std::size_t(size) * std::size_t(size);
  const Buckets buckets = in_buckets(input.droplets, size);
  const cl::Buffer<float> droplets(queue, std::span<const float>(droplet_rows(input.droplets)));
  const cl::Buffer<std::int32_t> row(queue, std::span<const std::int32_t>(buckets.row));
  const cl::Buffer<std::int32_t> drop(queue, std::span<const std::int32_t>(buckets.drop));
  const cl::Buffer<float> surface(queue, std::span<const float>(flat(input.mask_surface)));
  mask_ = cl::Buffer<float>(queue.device(), 4 * texels);
  const WetParams params{size, bucket_texels};
  cl::Kernel kernel(program_, "wetness_mask");
  kernel.with(params, droplets, row, drop, surface, mask_);
  // Twice: the first launch also compiles on some platforms.
  for (int i = 0; i < 2; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const cl::Event event = kernel.enqueue(queue, {std::size_t(size), std::size_t(size)});
    queue.finish();
    mask_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  }
}

}  // namespace pelage::shells
