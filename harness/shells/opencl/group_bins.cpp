#include "harness/shells/opencl/group_bins.hpp"

#include <fmt/format.h>

#include <bit>
#include <limits>

#include "harness/error.hpp"

namespace pelage::shells {
namespace {

constexpr std::size_t scan_items = 64, scan_block = scan_items * 16;
constexpr std::size_t sort_items = 64, sort_run = 32;
constexpr int sort_bits = 4;

std::size_t ceil_div(std::size_t a, std::size_t b) {
  return (a + b - 1) / b;
}

// A quarter more than asked for: the next frame's lists are about as long.
void grow(const cl::Queue& queue, cl::Buffer<std::int32_t>& buffer, std::size_t count) {
  if (count > buffer.size()) buffer = cl::Buffer<std::int32_t>(queue.device(), count + count / 4);
}

void keep(PhaseEvents* events, cl::Event event) {
  if (events) events->emplace_back("bin", std::move(event));
}

}  // namespace

GroupSort::GroupSort(const cl::Device& device)
    : program_(device, "common/sort.cl",
               fmt::format("-D LANES=1 -D SCAN_ITEMS={} -D SCAN_EACH={} -D SORT_BITS={} -D SORT_RUN={}",
                           scan_items, scan_block / scan_items, sort_bits, sort_run)),
      blocks_(program_, "scan_blocks"),
      add_(program_, "scan_add"),
      count_(program_, "sort_count"),
      move_(program_, "sort_move") {}

std::int32_t GroupSort::scan(const cl::Queue& queue, const cl::Buffer<std::int32_t>& value, std::size_t count,
                             PhaseEvents* events, bool read_sum) {
  // Sums of blocks, then of blocks of blocks, until one block is left; then back.
  std::vector<std::size_t> length{count};
  std::size_t level = 0;
  do {
    const std::size_t blocks = std::max<std::size_t>(ceil_div(length[level], scan_block), 1);
    if (sums_.size() == level) sums_.emplace_back();
    grow(queue, sums_[level], blocks);
    blocks_.with(std::int32_t(length[level]), level == 0 ? value : sums_[level - 1], sums_[level]);
    keep(events, blocks_.enqueue(queue, blocks * scan_items, scan_items));
    length.push_back(blocks);
    ++level;
  } while (length[level] > 1);
  for (std::size_t i = level - 1; i-- > 0;) {
    add_.with(std::int32_t(length[i]), sums_[i], i == 0 ? value : sums_[i - 1]);
    keep(events, add_.enqueue(queue, length[i]));
  }
  std::array<std::int32_t, 1> sum{};
  if (read_sum) sums_[level - 1].read(queue, sum);
  return sum[0];
}

void GroupSort::sort(const cl::Queue& queue, cl::Buffer<std::int32_t>& key, cl::Buffer<std::int32_t>& value,
                     std::size_t count, int bits, PhaseEvents* events) {
  if (count == 0) return;
  const std::size_t runs = ceil_div(count, sort_run), digits = runs << sort_bits;
  const std::size_t items = ceil_div(runs, sort_items) * sort_items;
  grow(queue, digits_, digits);
  grow(queue, other_key_, count);
  grow(queue, other_value_, count);
  for (int shift = 0; shift < bits; shift += sort_bits) {
    count_.with(std::int32_t(count), shift, key, digits_);
    keep(events, count_.enqueue(queue, items, sort_items));
    scan(queue, digits_, digits, events, false);
    move_.with(std::int32_t(count), shift, digits_, key, value, other_key_, other_value_);
    keep(events, move_.enqueue(queue, items, sort_items));
    std::swap(key, other_key_);
    std::swap(value, other_value_);
  }
}

GroupBins::GroupBins(const cl::Device& device, const RasterParams& p, const std::string& options)
    : program_(device, "rasterize/workgroup/bin.cl", options),
      count_(program_, "group_count"),
      emit_(program_, "group_emit"),
      starts_(program_, "group_starts"),
      sort_(device),
      offset_(device, std::size_t(p.groups) * std::size_t(p.triangles)) {
  if (offset_.size() > std::size_t(std::numeric_limits<std::int32_t>::max()))
    throw DeviceError(fmt::format(
        "{} groups of layers of {} triangles: the kernels count below 2^31; more layers to a group "
        "(axis GROUP)",
        p.groups, p.triangles));
}

void GroupBins::make(const cl::Queue& queue, const RasterParams& p, const cl::Buffer<std::int32_t>& corner,
                     const cl::Buffer<float>& box, const cl::Buffer<std::int32_t>& start,
                     cl::Buffer<std::int32_t>& list, PhaseEvents* events) {
  const std::size_t items = std::size_t(p.groups) * std::size_t(p.triangles);
  count_.with(p, corner, box, offset_);
  keep(events, count_.enqueue(queue, items));
  const std::int32_t total = sort_.scan(queue, offset_, items, events, true);
  // Beyond, an int no longer says where a run of the sort ends.
  if (total > std::numeric_limits<std::int32_t>::max() - 4096)
    throw DeviceError(
        "the bins would hold 2^31 triangles or more: draw a smaller picture, or more layers "
        "to a bin (axis GROUP)");
  const auto count = std::size_t(total);
  grow(queue, key_, count + 1);
  grow(queue, list, count + 1);
  emit_.with(p, corner, box, offset_, key_, list);
  keep(events, emit_.enqueue(queue, items));
  const auto lists = std::uint32_t(start.size() - 1);
  sort_.sort(queue, key_, list, count, int(std::bit_width(lists - 1)), events);
  starts_.with(p, total, key_, start);
  keep(events, starts_.enqueue(queue, count + 1));
}

}  // namespace pelage::shells
