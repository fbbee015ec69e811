#include "harness/shells/opencl/droplet_buckets.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace pelage::shells {
namespace {

/// True if a texel of the bucket at (x, y) is in the droplet's disc, enlarged by `margin`, and in its reach.
bool reaches(const FrameInput& input, const Droplet& d, int x, int y, int texels, float margin) {
  const int size = input.scene.wetness.size;
  const float most = d.radius + margin;
  constexpr float rounding = 1.001f;  // the kernel computes the same distances in other operations
  for (int j = y * texels; j < std::min((y + 1) * texels, size); ++j)
    for (int i = x * texels; i < std::min((x + 1) * texels, size); ++i) {
      const glm::vec2 centre((float(i) + 0.5f) / float(size), (float(j) + 0.5f) / float(size));
      if (!(glm::distance(centre, d.centre) <= most)) continue;
      const glm::vec3& point = input.mask_surface[std::size_t(j) * std::size_t(size) + std::size_t(i)];
      if (glm::distance(point, d.point) <= rounding * d.reach) return true;
    }
  return false;
}

}  // namespace

DropletBuckets::DropletBuckets(const FrameInput& input, int texels, bool near) {
  const int size = input.scene.wetness.size, side = (size + texels - 1) / texels;
  count_ = std::size_t(side) * std::size_t(side);
  const auto bucket = [&](float coordinate) {
    const float texel = std::clamp(coordinate * float(size), 0.0f, float(size - 1));
    return int(texel) / texels;
  };
  // More than WetParams::rim.
  const float margin = 2.0f / float(size);
  row_.push_back(0);
  for (const Droplet& d : input.droplets) {
    const float reach = d.radius + margin;
    for (int y = bucket(d.centre.y - reach); y <= bucket(d.centre.y + reach); ++y)
      for (int x = bucket(d.centre.x - reach); x <= bucket(d.centre.x + reach); ++x)
        if (!near || reaches(input, d, x, y, texels, margin))
          bucket_.push_back(std::uint32_t(y) * std::uint32_t(side) + std::uint32_t(x));
    row_.push_back(std::uint32_t(bucket_.size()));
  }
}

BucketLists DropletBuckets::lists(const std::vector<std::uint32_t>& order) const {
  BucketLists b;
  b.row.assign(count_ + 1, 0);
  const auto for_each_bucket = [&](std::uint32_t droplet, const auto& use) {
    for (std::uint32_t k = row_[droplet]; k < row_[droplet + 1]; ++k) use(bucket_[k]);
  };
  for (const std::uint32_t droplet : order)
    for_each_bucket(droplet, [&](std::uint32_t bucket) { ++b.row[bucket + 1]; });
  for (std::size_t i = 0; i < count_; ++i) b.row[i + 1] += b.row[i];
  b.drop.resize(std::size_t(b.row.back()));
  std::vector<std::int32_t> next(b.row.begin(), b.row.end() - 1);
  for (std::size_t i = 0; i < order.size(); ++i)
    for_each_bucket(order[i],
                    [&](std::uint32_t bucket) { b.drop[std::size_t(next[bucket]++)] = std::int32_t(i); });
  return b;
}

TexelLists::TexelLists(const cl::Queue& queue, const cl::Program& program, const WetParams& params,
                       const cl::Buffer<float>& droplets, const cl::Buffer<std::int32_t>& row,
                       const cl::Buffer<std::int32_t>& drop, const cl::Buffer<float>& surface)
    : kernel_(program, "wetness_mask_by_texel") {
  const cl::Device& device = queue.device();
  const std::size_t texels = std::size_t(params.size) * std::size_t(params.size);
  std::vector<std::int32_t> start(texels + 1, 0);
  start_ = cl::Buffer<std::int32_t>(queue, std::span<const std::int32_t>(start));
  list_ = cl::Buffer<std::int32_t>(device, 1);
  cl::Buffer<std::int32_t> count(device, texels);
  cl::Kernel lists(program, "texel_droplets");
  const auto make = [&] {
    lists.with(params, droplets, row, drop, surface, start_, count, list_);
    const cl::Event event = lists.enqueue_loop(queue, texels);
  };
  make();  // without room for entries, this counts them
  const std::vector<std::int32_t> counts = count.read(queue);
  std::int64_t entries = 0;
  for (const std::int32_t n : counts) entries += n;
  short_enough_ = entries <= most_entries && *std::max_element(counts.begin(), counts.end()) <= most;
  if (!short_enough_) return;
  for (std::size_t i = 0; i < texels; ++i) start[i + 1] = start[i] + counts[i];
  start_.write(queue, std::span<const std::int32_t>(start));
  list_ = cl::Buffer<std::int32_t>(device, std::size_t(entries));
  make();
  queue.finish();
  const std::size_t drops = droplets.size() / DROP_COLUMNS;
  rho_ = cl::Buffer<float>(device, drops);
  rank_ = cl::Buffer<std::int32_t>(device, drops);
}

void TexelLists::upload(const cl::Queue& queue, const std::vector<float>& rho,
                        const std::vector<std::uint32_t>& order) {
  std::vector<std::int32_t> rank(rho.size(), std::numeric_limits<std::int32_t>::max());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = std::int32_t(i);
  rho_.write(queue, std::span<const float>(rho));
  rank_.write(queue, std::span<const std::int32_t>(rank));
}

cl::Event TexelLists::run(const cl::Queue& queue, const WetParams& params, const cl::Buffer<float>& droplets,
                          cl::Buffer<float>& mask) {
  kernel_.with(params, droplets, rho_, rank_, start_, list_, mask);
  return kernel_.enqueue_loop(queue, std::size_t(params.size) * std::size_t(params.size));
}

}  // namespace pelage::shells
