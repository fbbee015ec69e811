#include <fmt/format.h>

#include <algorithm>

#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage::springs {
namespace {

// Returns the name of the solver's kernel in kernels/springs/blocks.cl, such as "rk4_frame".
std::string frame_kernel(const Solver& solver) {
  std::string name(solver.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name + "_frame";
}

// Returns the number of slices from which a work-item takes sticks at the same time: one for each corner of a
// triangle, otherwise 1 or 2. An explicit or semi-implicit Euler step of a stick is a short chain of
// dependent operations, so with 16 lanes (CPU) one slice does not keep the vector unit of a core busy. The
// other solvers would need too many registers for two slices.
int corners_of(const Layout& layout, Solver solver, int lanes) {
  const bool brief = !solver.implicit && !solver.multistage();
  return layout.corners == 1 && lanes == 16 && brief ? 2 : layout.corners;
}

}  // namespace

// The limits below were measured with `pelage run topology-solvers` on the models of Banisch and Wuethrich
// 2006 (results/notes.md). One work-item uses one core. Waking a second core takes some
// microseconds, which is more than the second core saves on a small model.
bool whole_suits(const cl::DeviceInfo& device, Kind kind, Solver solver, std::size_t sticks) {
  // llvmpipe (platform rusticl) ends a loop after 65535 iterations and reports no error, so one work-item
  // cannot compute all steps of a whole model.
  if (!device.cpu || device.platform == "rusticl") return false;
  if (!kind.shared_edges()) return sticks <= 2048;
  return sticks <= (solver.implicit ? 4096u : 2048u);
}

std::string build_options(int lanes, bool turning) {
  return fmt::format("-D LANES={} -D TURNING={}", lanes, int(turning));
}

BlockStage::BlockStage(const cl::Queue& queue, const Layout& layout, const Dynamics& dynamics, int lanes,
                       bool whole, const MassSpringOptions& options)
    : program_(queue.device(), "springs/blocks.cl",
               fmt::format("{} -D CORNERS={} -D EDGES={}", build_options(lanes, turns(dynamics.motion)),
                           corners_of(layout, dynamics.solver, lanes), int(layout.corners == 3))),
      frame_(program_, frame_kernel(dynamics.solver)),
      sides_(queue, std::span(layout.sides)),
      group_(options.group),
      blocks_(layout.slices / corners_of(layout, dynamics.solver, lanes)),
      units_(blocks_ * (16 / lanes)),
      per_item_(whole ? units_
                      : cl::units_per_item(queue.device().info(), lanes, units_, options.blocks_per_item)) {}

void BlockStage::enqueue(const cl::Queue& queue, TopologyParams params, const Buffers& buffers,
                         std::vector<cl::Event>* launches) {
  params.blocks = blocks_;
  params.blocks_per_item = per_item_;
  const std::size_t items = std::size_t((units_ + per_item_ - 1) / per_item_);
  frame_.with(params, buffers.moments, buffers.sites, buffers.push, sides_, buffers.offset, buffers.speed,
              buffers.diverged_at, buffers.first);
  cl::Event event = frame_.enqueue(queue, items, group_);
  if (launches) launches->push_back(std::move(event));
}

}  // namespace pelage::springs
