#include "harness/shells/opencl/wet_stage.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "harness/prepare/water.hpp"
#include "harness/shells/opencl/program_texts.hpp"
#include "kernels/wet/params.h"

namespace pelage::shells {
namespace {

std::vector<float> droplet_rows(const std::vector<Droplet>& droplets, const std::vector<float>& rho,
                                const std::vector<std::uint32_t>& order) {
  std::vector<float> rows;
  rows.reserve(order.size() * DROP_COLUMNS);
  // A droplet without repetitions gets a number of its own, below 0.
  for (const std::uint32_t i : order) {
    const Droplet& d = droplets[i];
    const float number = d.number == Droplet::alone ? -1 - float(i) : float(d.number);
    rows.insert(rows.end(),
                {d.centre.x, d.centre.y, d.radius, rho[i], d.point.x, d.point.y, d.point.z, d.reach, number});
  }
  return rows;
}

/// Returns the indices of the droplets that are blended into the mask, in the order of blending. `rho` is the
/// present wetness of each droplet. If the water changes, dry droplets are left out.
std::vector<std::uint32_t> blending_order(const FrameInput& input, const std::vector<float>& rho,
                                          bool changes) {
  // Without the repetitions, which follow their droplet in any order.
  std::vector<std::uint32_t> own;
  for (std::size_t i = 0; i < rho.size(); ++i)
    if ((!changes || rho[i] > 0) && !repeats(input.droplets, i)) own.push_back(std::uint32_t(i));
  if (input.scene.clump.cells == "consistent")
    std::stable_sort(own.begin(), own.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return rho[a] > rho[b]; });
  std::vector<std::uint32_t> order;
  order.reserve(rho.size());
  for (std::uint32_t i : own) {
    order.push_back(i);
    while (std::size_t(i) + 1 < rho.size() && repeats(input.droplets, std::size_t(i) + 1))
      order.push_back(++i);
  }
  return order;
}

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

WetStage::WetStage(const cl::Queue& queue, const FrameInput& input, const Tuning& tuning)
    : size_(input.scene.wetness.size),
      consistent_(input.scene.clump.cells == "consistent"),
      overlap_(input.scene.wetness.blend == "overlap"),
      changes_(water_changes(input.scene.wetness, input.droplets)),
      bucket_(std::max(1, tuned(tuning, "WET_BUCKET", 8))),
      buckets_(input, bucket_, changes_),
      droplets_(queue.device(), DROP_COLUMNS * input.droplets.size()),
      surface_(cl::uploaded(queue, input.mask_surface)),
      mask_(cl::uploaded(queue,
                         std::vector<glm::vec4>(std::size_t(size_) * std::size_t(size_), glm::vec4(0)))) {
  // The buffers have room for all droplets, but a picture needs only the droplets that are wet at its time.
  row_ = cl::Buffer<std::int32_t>(queue.device(), buckets_.buckets() + 1);
  drop_ = cl::Buffer<std::int32_t>(queue.device(), buckets_.entries());
  if (!input.droplets.empty()) {
    build(queue);
    if (changes_) make_lists(queue, input);
  }
  upload_droplets(queue, input, frames_before(input.scene.dynamics) + 1);
  if (!input.droplets.empty()) run(queue);
}

void WetStage::build(const cl::Queue& queue) {
  program_.emplace(queue.device(), mask_text());
  kernel_.emplace(*program_, "wetness_mask");
}

WetParams WetStage::params() const {
  const double texel = consistent_ ? 1.0 / size_ : 0.0, half_diagonal = std::sqrt(0.5);
  return {size_, bucket_, int(overlap_), float((half_diagonal + 0.5) * texel), float(half_diagonal * texel)};
}

void WetStage::make_lists(const cl::Queue& queue, const FrameInput& input) {
  std::vector<std::uint32_t> all(input.droplets.size());
  std::iota(all.begin(), all.end(), 0u);
  upload_rows(queue, input, wetness_of_picture(input, 1), all);
  lists_.emplace(queue, *program_, params(), droplets_, row_, drop_, surface_);
  if (!lists_->short_enough()) lists_.reset();
}

void WetStage::upload_rows(const cl::Queue& queue, const FrameInput& input, const std::vector<float>& rho,
                           const std::vector<std::uint32_t>& order) {
  const BucketLists lists = buckets_.lists(order);
  droplets_.write(queue, std::span<const float>(droplet_rows(input.droplets, rho, order)));
  row_.write(queue, std::span<const std::int32_t>(lists.row));
  drop_.write(queue, std::span<const std::int32_t>(lists.drop));
}

void WetStage::upload_droplets(const cl::Queue& queue, const FrameInput& input, int frames) {
  const std::vector<float> rho = wetness_of_picture(input, frames);
  const std::vector<std::uint32_t> order = blending_order(input, rho, changes_);
  if (lists_)
    lists_->upload(queue, rho, order);
  else
    upload_rows(queue, input, rho, order);
}

cl::Event WetStage::run(const cl::Queue& queue) {
  if (lists_) return lists_->run(queue, params(), droplets_, mask_);
  if (!kernel_) build(queue);
  kernel_->with(params(), droplets_, row_, drop_, surface_, mask_);
  return kernel_->enqueue_loop(queue, std::size_t(size_) * std::size_t(size_));
}

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
                       const cl::Buffer<std::int32_t>& drop, const cl::Buffer<glm::vec3>& surface)
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
                          cl::Buffer<glm::vec4>& mask) {
  kernel_.with(params, droplets, rho_, rank_, start_, list_, mask);
  return kernel_.enqueue_loop(queue, std::size_t(params.size) * std::size_t(params.size));
}

}  // namespace pelage::shells
