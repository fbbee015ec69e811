#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage::springs {
namespace {

enum { SET_UP, PRODUCT, ADVANCE, TURN, MOVE };  // indices of the implicit solver's kernels in kernels_
// Results of the kernel gradients_whole: the total number of iterations, the greatest number in a step, and
// the greatest |r| / |b| at the end of a step.
enum { SOLVED_ALL, SOLVED_MOST, SOLVED_WORST, SOLVED };

constexpr int most_chunks = 128, most_chunks_of_one_lane = 512;

const char* file_of(const Solver& solver) {
  return solver.implicit ? "springs/gradients.cl" : "springs/prisms.cl";
}

std::vector<const char*> kernels_of(const Solver& solver, bool whole) {
  if (solver.implicit && whole) return {"gradients_whole"};
  if (solver.implicit)
    return {"gradients_set_up", "gradients_product", "gradients_advance", "gradients_turn", "gradients_move"};
  if (solver.multistage()) return {whole ? "prism_stages_whole" : "prism_stage"};
  if (whole) return {"prism_euler", "prism_euler_whole"};
  return {"prism_euler"};
}

int ceiling(int a, int b) {
  return (a + b - 1) / b;
}

template <class T>
double total(const std::vector<T>& sums, int row, int chunks) {
  double sum = 0;
  for (int k = 0; k < chunks; ++k)
    sum += double(sums[std::size_t(row) * std::size_t(chunks) + std::size_t(k)]);
  return sum;
}

// Converts vectors in columns to rows of four floats: x, y, z and 0. `columns` is the number of columns of
// `values`, and `first` is the column of x.
std::vector<float> rows(const std::vector<float>& values, std::size_t columns, std::size_t first) {
  std::vector<float> found(values.size() / columns * 4, 0.0f);
  for (std::size_t place = 0; place < values.size() / columns; ++place)
    for (std::size_t c = 0; c < 3; ++c) found[4 * place + c] = values[column_of(place, columns, first + c)];
  return found;
}

// Returns the positions of the tops, in rows. `offset` has those relative to their bases, in columns.
std::vector<float> tips(const Layout& layout, const std::vector<float>& offset) {
  std::vector<float> found = rows(layout.sites, SITE_COLUMNS, SITE_ROOT);
  const std::vector<float> above = rows(offset, 3, 0);
  for (std::size_t i = 0; i < found.size(); ++i) found[i] += above[i];
  return found;
}

}  // namespace

PrismStage::PrismStage(const cl::Queue& queue, const Layout& layout, const Dynamics& dynamics, int lanes,
                       bool whole, const MassSpringOptions& options)
    : solver_(dynamics.solver),
      whole_(whole),
      residual_(double(dynamics.residual)),
      most_iterations_(dynamics.most_iterations),
      program_(queue.device(), file_of(solver_),
               fmt::format("{} -D DOUBLE_SUMS={}", build_options(lanes, turns(dynamics.motion)),
                           int(queue.device().info().fp64))),
      group_(options.group),
      units_(layout.slices * (16 / lanes)),
      per_item_(cl::units_per_item(queue.device().info(), lanes, units_, options.blocks_per_item)),
      per_chunk_(whole ? units_ : ceiling(units_, lanes == 16 ? most_chunks : most_chunks_of_one_lane)),
      chunks_(ceiling(units_, per_chunk_)),
      double_sums_(queue.device().info().fp64),
      start_(queue, std::span(layout.start)),
      neighbour_(queue, std::span(layout.neighbour)),
      rest_(queue, std::span(layout.rest)) {
  for (const char* name : kernels_of(solver_, whole_)) kernels_.emplace_back(program_, name);
  const std::size_t places = layout.places();
  const auto floats = [&](std::size_t columns) {
    return cl::uploaded(queue, std::vector<float>(columns * places, 0.0f));
  };
  if (solver_.implicit) {
    root_ = cl::uploaded(queue, rows(layout.sites, SITE_COLUMNS, SITE_ROOT));
    reach_ = cl::uploaded(queue, rows(layout.offset, 3, 0));
    diagonal_ = floats(6), inverse_ = floats(6), change_ = floats(4), left_ = floats(3), way_ = floats(4),
    along_ = floats(3);
    coupling_ = cl::Buffer<float>(queue.device(), 3 * layout.neighbour.size());
    sums_ = cl::Memory(queue.device(),
                       std::size_t(SUM_ROWS * chunks_) * (double_sums_ ? sizeof(double) : sizeof(float)));
    solved_ = cl::Buffer<float>(queue.device(), SOLVED);
  } else {
    tip_ = cl::uploaded(queue, tips(layout, layout.offset));
    other_tip_ = floats(4), other_speed_ = floats(4);
    if (solver_.multistage())
      spare_tip_ = floats(4), spare_speed_ = floats(4), stage_offset_ = floats(3), sum_offset_ = floats(3),
      sum_speed_ = floats(3);
  }
}

void PrismStage::set(const cl::Queue& queue, const Layout& layout, const std::vector<float>& offset) {
  if (!solver_.implicit) return tip_.write(queue, tips(layout, offset));
  reach_.write(queue, rows(offset, 3, 0));
  change_.write(queue, std::vector<float>(change_.size(), 0.0f));
}

void PrismStage::set_skin(const cl::Queue& queue, const Layout& layout, const std::vector<float>& offset) {
  rest_.write(queue, layout.rest);
  if (solver_.implicit)
    root_.write(queue, rows(layout.sites, SITE_COLUMNS, SITE_ROOT));
  else
    tip_.write(queue, tips(layout, offset));
}

void PrismStage::launch(const cl::Queue& queue, const cl::Kernel& kernel, int items) const {
  cl::Event event = kernel.enqueue(queue, std::size_t(items), group_);
  if (launches_) launches_->push_back(std::move(event));
}

void PrismStage::enqueue(const cl::Queue& queue, TopologyParams params, Buffers& buffers,
                         std::vector<cl::Event>* launches) {
  launches_ = launches;
  params.blocks = int(buffers.diverged_at.size() / 16);
  params.blocks_per_item = solver_.implicit ? per_chunk_ : per_item_;
  // A single Euler step is one launch even with many work-items, which are faster than one, because several
  // cores read in parallel the data that the host has written.
  const bool one_launch = !solver_.implicit && !solver_.multistage() && params.substeps == 1;
  if (whole_ && !one_launch) {
    whole(queue, params, buffers);
    launches_ = nullptr;
    return;
  }
  for (int i = 0; i < params.substeps; ++i) {
    if (solver_.multistage())
      stages(queue, params, buffers, i);
    else if (solver_.implicit)
      backward_euler(queue, params, buffers, i);
    else
      euler(queue, params, buffers, i);
  }
  launches_ = nullptr;
}

void PrismStage::whole(const cl::Queue& queue, const TopologyParams& params, Buffers& b) {
  if (solver_.implicit) return whole_gradients(queue, params, b);
  cl::Kernel& kernel = kernels_.back();
  if (solver_.multistage()) {
    kernel.with(params, solver_.stages, b.moments, b.sites, b.push, start_, neighbour_, rest_, tip_, b.speed,
                b.offset, other_tip_, other_speed_, spare_tip_, spare_speed_, stage_offset_, sum_offset_,
                sum_speed_, b.diverged_at, b.first);
    return launch(queue, kernel, 1);
  }
  kernel.with(params, int(solver_.in_turn), b.moments, b.sites, b.push, start_, neighbour_, rest_, tip_,
              b.speed, b.offset, other_tip_, other_speed_, b.diverged_at, b.first);
  launch(queue, kernel, 1);
  if (params.substeps % 2 == 0) return;
  std::swap(tip_, other_tip_);
  std::swap(b.speed, other_speed_);
}

void PrismStage::whole_gradients(const cl::Queue& queue, const TopologyParams& params, Buffers& b) {
  kernels_[0].with(params, most_iterations_, float(residual_), b.moments, b.sites, b.push, start_, neighbour_,
                   rest_, root_, reach_, b.offset, b.speed, change_, diagonal_, inverse_, coupling_, left_,
                   way_, along_, sums_, b.diverged_at, b.first, solved_);
  launch(queue, kernels_[0], 1);
  std::array<float, SOLVED> solved{};
  solved_.read(queue, solved);
  solves_.solves += params.substeps;
  solves_.iterations += std::lround(solved[SOLVED_ALL]);
  solves_.most_iterations = std::max(solves_.most_iterations, int(solved[SOLVED_MOST]));
  solves_.worst_residual = std::max(solves_.worst_residual, double(solved[SOLVED_WORST]));
}

void PrismStage::euler(const cl::Queue& queue, const TopologyParams& params, Buffers& b, int substep) {
  const int in_turn = solver_.in_turn;
  kernels_[0].with(params, in_turn, params.first_moment + 2 * substep, params.first_step + substep, b.moments,
                   b.sites, b.push, start_, neighbour_, rest_, tip_, b.speed, b.offset, other_tip_,
                   other_speed_, b.diverged_at, b.first);
  launch(queue, kernels_[0], ceiling(units_, per_item_));
  std::swap(tip_, other_tip_);
  std::swap(b.speed, other_speed_);
}

void PrismStage::stages(const cl::Queue& queue, const TopologyParams& params, Buffers& b, int substep) {
  // The buffers that the stages read. The tips and speeds at the start of the step stay in tip_ and b.speed
  // until the last stage overwrites them with the result.
  cl::Buffer<float>*tips[] = {&tip_, &other_tip_, &spare_tip_, &other_tip_},
  *speeds[] = {&b.speed, &other_speed_, &spare_speed_, &other_speed_};
  for (int stage = 0; stage < solver_.stages; ++stage) {
    const int half_steps = solver_.stages == 4 ? (stage + 1) / 2
                           : stage == 0        ? 0
                                               : 2;  // stage_of() of the kernels
    const int at = params.first_moment + 2 * substep + half_steps, next = (stage + 1) % solver_.stages;
    kernels_[0].with(params, solver_.stages, stage, at, params.first_step + substep, b.moments, b.sites,
                     b.push, start_, neighbour_, rest_, *tips[stage], *speeds[stage],
                     stage == 0 ? b.offset : stage_offset_, b.offset, b.speed, sum_offset_, sum_speed_,
                     *tips[next], *speeds[next], stage_offset_, b.diverged_at, b.first);
    launch(queue, kernels_[0], ceiling(units_, per_item_));
  }
}

bool PrismStage::converged(const cl::Queue& queue) {
  double rr = 0, bb = 0;
  const auto read = [&]<class T>(T) {
    std::vector<T> sums(std::size_t(SUM_ROWS * chunks_));
    sums_.read(queue, sums.data(), sums.size() * sizeof(T));
    rr = total(sums, SUM_RR, chunks_), bb = total(sums, SUM_BB, chunks_);
  };
  if (double_sums_)
    read(0.0);
  else
    read(0.0f);
  if (!std::isfinite(rr) || !std::isfinite(bb))
    return true;  // the masses diverged; the kernel gradients_move stores the step number in diverged_at
  const bool done = rr <= residual_ * residual_ * bb;
  last_residual_ = bb > 0 ? std::sqrt(rr / bb) : 0;
  return done;
}

void PrismStage::backward_euler(const cl::Queue& queue, const TopologyParams& params, Buffers& b,
                                int substep) {
  kernels_[SET_UP].with(params, chunks_, params.first_moment + 2 * substep + 2, b.moments, b.sites, b.push,
                        start_, neighbour_, rest_, root_, reach_, b.speed, change_, diagonal_, inverse_,
                        coupling_, left_, way_, sums_);
  launch(queue, kernels_[SET_UP], chunks_);
  int done = 0;
  const auto iterate = [&] {
    const int odd = done++ % 2;
    kernels_[PRODUCT].with(params, chunks_, start_, neighbour_, diagonal_, coupling_, way_, along_, sums_);
    launch(queue, kernels_[PRODUCT], chunks_);
    kernels_[ADVANCE].with(params, chunks_, odd, inverse_, along_, left_, sums_);
    launch(queue, kernels_[ADVANCE], chunks_);
    kernels_[TURN].with(params, chunks_, odd, along_, way_, change_, sums_);
    launch(queue, kernels_[TURN], chunks_);
  };
  // A convergence test waits for the queue, so the first expected_ iterations of a step run without a test:
  // two fewer than in the previous step, but at least two. Then every second iteration is tested.
  for (int i = 0; i < std::min(expected_, most_iterations_); ++i) iterate();
  while (!converged(queue) && done < most_iterations_)
    for (int i = 0; i < 2; ++i) iterate();
  expected_ = std::max(2, done - 2);
  ++solves_.solves;
  solves_.iterations += done;
  solves_.most_iterations = std::max(solves_.most_iterations, done);
  solves_.worst_residual = std::max(solves_.worst_residual, last_residual_);
  kernels_[MOVE].with(params, chunks_, params.first_step + substep, change_, b.offset, b.speed, reach_,
                      b.diverged_at, b.first);
  launch(queue, kernels_[MOVE], chunks_);
}

std::size_t PrismStage::bytes() const {
  std::size_t values = start_.size() + neighbour_.size() + rest_.size();
  for (const cl::Buffer<float>* buffer :
       {&root_, &reach_, &tip_, &other_tip_, &other_speed_, &spare_tip_, &spare_speed_, &stage_offset_,
        &sum_offset_, &sum_speed_, &diagonal_, &inverse_, &coupling_, &change_, &left_, &way_, &along_})
    values += buffer->size();
  return 4 * values;
}

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

void BlockStage::set_skin(const cl::Queue& queue, const Layout& layout) {
  if (sides_.size() == layout.sides.size()) sides_.write(queue, layout.sides);
}

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
