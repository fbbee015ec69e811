// The lists of the strands that each tile of a picture may show (kernels/strands/draw/bins.cl).
#pragma once
#include <algorithm>
#include <glm/vec4.hpp>
#include <string>

#include "harness/cl/pair_sort.hpp"
#include "harness/cl/program.hpp"
#include "kernels/strands/draw/params.h"

namespace pelage::strands {

/// The memory on the device that the drawing of a picture reads and writes besides the strands.
class TileLists {
 public:
  /// `options`: build options of the kernels, for one lane. params.tiles_x, tiles_y and chunks must be set.
  TileLists(const cl::Queue& queue, const DrawParams& params, const cl::ProgramText& text);

  /// Enqueues the kernels that write the lists. They read the first total[0] pairs. The launches belong to
  /// the phase `phase`. The host waits once, because it needs the total length of the lists to allocate them.
  /// Throws DeviceError if the total length is 2^31 or more.
  void enqueue(const cl::Queue& queue, const DrawParams& params, const cl::Buffer<std::int32_t>& total,
               const cl::Buffer<std::uint64_t>& blocks, const cl::Buffer<cl::Pair>& pairs, const char* phase,
               cl::PhaseEvents* events);

  /// Enqueues the kernel that draws the tiles. `group`: a work-group draws a tile of `tile` x `tile` pixels;
  /// otherwise a work-item draws one tile after the other. rows, film, map, skin: see strand_tiles
  /// (tile.cl).
  cl::Event draw(const cl::Queue& queue, cl::Kernel& kernel, bool group, int tile, const DrawParams& params,
                 const cl::Buffer<float>& rows, const cl::Buffer<std::int32_t>& film,
                 const cl::Buffer<glm::vec4>& map, const cl::Buffer<glm::vec4>& skin,
                 cl::Buffer<glm::vec4>& image) {
    kernel.with(params, rows, film, map, list_start_, list_, spot_, skin, image, taken_, blank_);
    // With one tile per work-item, a work-item draws tiles until no tile is left.
    const std::size_t tiles = length_.size(), pixels = std::size_t(tile) * std::size_t(tile);
    const std::size_t items = std::min(tiles, 32 * std::size_t(queue.device().info().compute_units));
    return group ? kernel.enqueue(queue, tiles * pixels, pixels) : kernel.enqueue(queue, items, 1);
  }

  /// Number of strands in the lists. A strand counts once per tile.
  std::size_t listed() const { return listed_; }
  const cl::Program& program() const { return program_; }

 private:
  cl::Program program_;
  cl::Kernel count_, sum_, start_, fill_;
  cl::Buffer<std::int32_t> chunk_count_, length_, list_start_, list_, taken_;
  cl::Buffer<std::uint16_t> spot_, blank_;
  std::size_t listed_ = 0;
};

}  // namespace pelage::strands
