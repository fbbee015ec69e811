#include <array>
#include <limits>

#include "harness/cl/radix_sort.hpp"
#include "harness/error.hpp"
#include "harness/shells/opencl/mapping.hpp"

namespace pelage::shells {

TileBins::TileBins(const cl::Program& geometry)
    : count_(geometry, "bin_count"),
      sum_(geometry, "bin_sum"),
      start_(geometry, "bin_start"),
      fill_(geometry, "bin_fill") {}

void TileBins::make(const cl::Queue& queue, const RasterParams& p, RasterBuffers& b,
                    cl::PhaseEvents* events) {
  const auto keep = [&](cl::Event event) { cl::keep(events, "bin", std::move(event)); };
  const auto chunks = std::size_t(p.chunks);
  const std::size_t tiles = std::size_t(p.tiles_x) * std::size_t(p.tiles_y);
  if (length_.size() == 0) {
    chunk_count_ = cl::Buffer<std::int32_t>(queue.device(), tiles * chunks);
    length_ = cl::Buffer<std::int32_t>(queue.device(), tiles);
    next_tile_ = cl::Buffer<std::int32_t>(queue.device(), 1);
  }
  if (b.list_start.size() < tiles + 1) b.list_start = cl::Buffer<std::int32_t>(queue.device(), tiles + 1);
  count_.with(p, b.corner, b.box, chunk_count_);
  keep(count_.enqueue(queue, chunks, 1));
  sum_.with(p, chunk_count_, length_);
  keep(sum_.enqueue(queue, tiles));
  start_.with(p, length_, b.list_start, next_tile_);
  keep(start_.enqueue(queue, 1));
  // The host reads the total length of the lists, to allocate space for all entries.
  std::array<std::int32_t, 1> total{};
  b.list_start.read(queue, total, tiles);
  if (total[0] == std::numeric_limits<std::int32_t>::max())
    throw DeviceError(
        "the triangle lists of the tiles would have 2^31 entries or more: use a smaller picture or mesh");
  cl::grow(queue, b.list, std::size_t(total[0]));
  fill_.with(p, b.corner, b.box, chunk_count_, b.list_start, b.list);
  keep(fill_.enqueue(queue, chunks, 1));
}

}  // namespace pelage::shells
