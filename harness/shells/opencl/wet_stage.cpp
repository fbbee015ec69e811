#include "harness/shells/opencl/wet_stage.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "kernels/wet/params.h"

namespace pelage::shells {
namespace {

// Lists of droplets, one per bucket. A bucket is a square block of the mask's texels. The list of a bucket
// holds the droplets whose discs may touch the bucket, in the order of blending.
struct Buckets {
  std::vector<std::int32_t> row, drop;
};

Buckets in_buckets(const std::vector<Droplet>& droplets, int size, int texels) {
  const int side = (size + texels - 1) / texels;
  std::vector<std::vector<std::int32_t>> lists(std::size_t(side) * std::size_t(side));
  const auto bucket = [&](float coordinate) {
    const float texel = std::clamp(coordinate * float(size), 0.0f, float(size - 1));
    return int(texel) / texels;
  };
  // More than WetParams::rim.
  const float margin = 2.0f / float(size);
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
  // A droplet without repetitions gets a number of its own, below 0.
  for (std::size_t i = 0; i < droplets.size(); ++i) {
    const Droplet& d = droplets[i];
    const float number = d.number == Droplet::alone ? -1 - float(i) : float(d.number);
    rows.insert(rows.end(), {d.centre.x, d.centre.y, d.radius, d.wetness, d.point.x, d.point.y, d.point.z,
                             d.reach, number});
  }
  return rows;
}

std::vector<float> flat(const std::vector<glm::vec3>& points) {
  std::vector<float> values;
  values.reserve(points.size() * 3);
  for (const glm::vec3& p : points) values.insert(values.end(), {p.x, p.y, p.z});
  return values;
}

/// Returns the droplets in the order in which they are blended into the mask.
std::vector<Droplet> in_order(const FrameInput& input) {
  std::vector<Droplet> droplets = input.droplets;
  if (input.scene.clump.cells == "consistent")
    std::stable_sort(droplets.begin(), droplets.end(),
                     [](const Droplet& a, const Droplet& b) { return a.wetness > b.wetness; });
  return droplets;
}

}  // namespace

WetStage::WetStage(const cl::Queue& queue, const FrameInput& input, const Tuning& tuning)
    : size_(input.scene.wetness.size),
      bucket_(std::max(1, tuned(tuning, "WET_BUCKET", 16))),
      consistent_(input.scene.clump.cells == "consistent"),
      overlap_(input.scene.wetness.blend == "overlap"),
      droplets_(queue, std::span<const float>(droplet_rows(in_order(input)))),
      surface_(queue, std::span<const float>(flat(input.mask_surface))),
      mask_(queue, std::span<const float>(std::vector<float>(4 * std::size_t(size_) * std::size_t(size_)))) {
  const Buckets buckets = in_buckets(in_order(input), size_, bucket_);
  row_ = cl::Buffer<std::int32_t>(queue, std::span<const std::int32_t>(buckets.row));
  drop_ = cl::Buffer<std::int32_t>(queue, std::span<const std::int32_t>(buckets.drop));
  if (input.droplets.empty()) return;
  // The kernel runs twice, because the first launch includes compilation on some platforms. mask_ms_ keeps
  // the time of the second run.
  for (int i = 0; i < 2; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const cl::Event event = run(queue);
    queue.finish();
    mask_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  }
}

cl::Event WetStage::run(const cl::Queue& queue) {
  if (!kernel_) {
    program_.emplace(queue.device(), "wet/wet.cl", build_options(1, {}));
    kernel_.emplace(*program_, "wetness_mask");
  }
  const double texel = consistent_ ? 1.0 / size_ : 0.0, half_diagonal = std::sqrt(0.5);
  kernel_->with(WetParams{size_, bucket_, int(overlap_), float((half_diagonal + 0.5) * texel),
                          float(half_diagonal * texel)},
                droplets_, row_, drop_, surface_, mask_);
  return kernel_->enqueue(queue, {std::size_t(size_), std::size_t(size_)});
}

}  // namespace pelage::shells
