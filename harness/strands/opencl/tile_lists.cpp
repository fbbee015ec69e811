#include <array>
#include <limits>
#include <vector>

#include "harness/error.hpp"
#include "harness/strands/opencl/drawer.hpp"

namespace pelage::strands {

TileLists::TileLists(const cl::Queue& queue, const DrawParams& params, const cl::ProgramText& text)
    : program_(queue.device(), text),
      count_(program_, "strand_bin_count"),
      sum_(program_, "strand_bin_sum"),
      start_(program_, "strand_bin_start"),
      fill_(program_, "strand_bin_fill") {
  const cl::Device& device = queue.device();
  const std::size_t tiles = std::size_t(params.tiles_x) * std::size_t(params.tiles_y);
  chunk_count_ = cl::Buffer<std::int32_t>(device, tiles * std::size_t(params.chunks));
  length_ = cl::Buffer<std::int32_t>(device, tiles);
  list_start_ = cl::Buffer<std::int32_t>(device, tiles + 1);
  taken_ = cl::Buffer<std::int32_t>(device, 1);
  blank_ = cl::uploaded(queue, std::vector<std::uint16_t>(tiles * 16, 0));  // a number for each row of blocks
}

void TileLists::enqueue(const cl::Queue& queue, const DrawParams& params,
                        const cl::Buffer<std::int32_t>& total, const cl::Buffer<std::uint64_t>& blocks,
                        const cl::Buffer<cl::Pair>& pairs, const char* phase, cl::PhaseEvents* events) {
  const auto keep = [&](cl::Event event) {
    if (events) events->emplace_back(phase, std::move(event));
  };
  const auto chunks = std::size_t(params.chunks);
  count_.with(params, total, blocks, pairs, chunk_count_);
  keep(count_.enqueue(queue, chunks, 1));
  sum_.with(params, chunk_count_, length_);
  keep(sum_.enqueue(queue, length_.size()));
  start_.with(params, length_, list_start_, taken_);
  keep(start_.enqueue(queue, 1));
  std::array<std::int32_t, 1> sum{};
  list_start_.read(queue, sum, length_.size());
  if (sum[0] == std::numeric_limits<std::int32_t>::max())
    throw DeviceError(
        "the strand lists of the tiles would have 2^31 entries or more: use a smaller picture or fewer "
        "strands");
  listed_ = std::size_t(sum[0]);
  // The kernels load up to 16 elements from any place of a list.
  if (list_.size() < listed_ + 16) {
    list_ = {};  // frees the memory before the larger buffers are allocated
    spot_ = {};
    list_ = cl::Buffer<std::int32_t>(queue.device(), listed_ + listed_ / 4 + 16);
    spot_ = cl::Buffer<std::uint16_t>(queue.device(), listed_ + listed_ / 4 + 16);
  }
  fill_.with(params, total, blocks, pairs, list_start_, chunk_count_, list_, spot_);
  keep(fill_.enqueue(queue, chunks, 1));
}

}  // namespace pelage::strands
