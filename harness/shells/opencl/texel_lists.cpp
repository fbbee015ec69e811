#include "harness/shells/opencl/texel_lists.hpp"

#include <algorithm>
#include <limits>

namespace pelage::shells {

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
