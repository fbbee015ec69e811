#include "harness/strands/opencl/chains.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/error.hpp"
#include "kernels/strands/draw/params.h"

namespace pelage::strands {
namespace {

int lanes_of(const cl::Queue& queue, int wanted) {
  if (wanted != 0 && wanted != 1 && wanted != 16)
    throw InputError(fmt::format("lanes: {}; it must be 0, 1 or 16", wanted));
  return wanted != 0 ? wanted : queue.device().info().lanes;
}

// On a CPU the slices (16 strands each) are divided among about 8 work-items per core. On a GPU a work-item
// computes one strand.
int units_per_item(const cl::DeviceInfo& device, int lanes, int slices, int wanted) {
  if (wanted > 0) return wanted * (16 / lanes);
  if (lanes == 1) return 1;
  const int items = 8 * std::max(1, int(device.compute_units));
  return std::clamp((slices + items - 1) / items, 1, 64);
}

cl::Buffer<float> uploaded(const cl::Queue& queue, const std::vector<float>& table) {
  return cl::Buffer<float>(queue, std::span<const float>(table));
}

std::vector<ChainState> all_at_rest(const std::vector<Chain>& chains) {
  std::vector<ChainState> states;
  states.reserve(chains.size());
  for (const Chain& chain : chains) states.push_back(at_rest(chain));
  return states;
}

}  // namespace

Chains::Chains(const cl::Queue& queue, const std::vector<Chain>& chains, const ChainDynamics& dynamics,
               const ChainOptions& options)
    : strands_(chains.size()),
      dynamics_(dynamics),
      params_((check(dynamics), params(dynamics))),
      lanes_(lanes_of(queue, options.lanes)),
      program_(queue.device(), "strands/chain/chain.cl",
               fmt::format("-D LANES={} -D TURNING={}", lanes_, int(turns(dynamics)))),
      key_program_(queue.device(), "strands/draw/chain_keys.cl", fmt::format("-D LANES={}", lanes_)),
      frame_(program_, "chain_frame"),
      write_keys_(key_program_, "chain_keys"),
      constants_(uploaded(queue, strand_columns(chains, dynamics.wind))),
      states_(uploaded(queue, state_columns(all_at_rest(chains)))) {
  if (chains.empty()) throw InputError("strands: there are none; at least one is needed");
  params_.slices = int((strands_ + 15) / 16);
  params_.units_per_item =
      units_per_item(queue.device().info(), lanes_, params_.slices, options.slices_per_item);
}

void Chains::enqueue(const cl::Queue& queue, int substeps, std::vector<cl::Event>* launches) {
  if (substeps <= 0) throw InputError(fmt::format("substeps: {}; the number must be at least 1", substeps));
  if (steps_ < known_from_ || steps_ + substeps > known_to_) {
    const int count = std::max(substeps, 256);
    const std::vector<ChainMoment> table = moments(dynamics_, steps_, count);
    moments_ = cl::Buffer<ChainMoment>(queue, std::span<const ChainMoment>(table));
    known_from_ = steps_;
    known_to_ = steps_ + count;
  }
  ChainParams p = params_;
  p.substeps = substeps;
  p.first_moment = int(steps_ - known_from_);
  const std::size_t units = std::size_t(p.slices) * std::size_t(16 / lanes_);
  const std::size_t group = lanes_ == 1 ? 64 : 1;
  const std::size_t items = (units + std::size_t(p.units_per_item) - 1) / std::size_t(p.units_per_item);
  frame_.with(p, moments_, constants_, states_);
  cl::Event event = frame_.enqueue(queue, (items + group - 1) / group * group, group);
  if (launches) launches->push_back(std::move(event));
  steps_ += substeps;
}

void Chains::write_keys(const cl::Queue& queue, const cl::Buffer<float>& keys,
                        std::vector<cl::Event>* launches) {
  const std::size_t padded = std::size_t(params_.slices) * 16;
  if (keys.size() < padded * KEY_RECORD)
    throw InputError(
        fmt::format("key strands: room for {} floats; {} are needed", keys.size(), padded * KEY_RECORD));
  // moments() returns values at the ends of steps, and the end of step -1 is the time 0.
  const std::vector<ChainMoment> now = moments(dynamics_, steps_ - 1, 1);
  if (present_.size() == 0)
    present_ = cl::Buffer<ChainMoment>(queue, std::span<const ChainMoment>(now));
  else
    present_.write(queue, std::span<const ChainMoment>(now));
  const std::size_t units = padded / std::size_t(lanes_), group = lanes_ == 1 ? 64 : 1;
  write_keys_.with(std::int32_t(units), std::int32_t(0), present_, constants_, states_, keys);
  cl::Event event = write_keys_.enqueue(queue, (units + group - 1) / group * group, group);
  if (launches) launches->push_back(std::move(event));
}

void Chains::set(const cl::Queue& queue, const std::vector<ChainState>& states, long steps) {
  if (states.size() != strands_)
    throw InputError(
        fmt::format("states: {} for {} strands; both counts must be equal", states.size(), strands_));
  const std::vector<float> table = state_columns(states);
  states_.write(queue, std::span<const float>(table));
  steps_ = steps;
}

void Chains::retarget(const ChainDynamics& dynamics) {
  ChainDynamics next = dynamics_;
  next.gravity = dynamics.gravity;
  next.wind = dynamics.wind;
  next.motion = dynamics.motion;
  check(next);
  if (turns(next) && !turns(dynamics_))
    throw InputError("motion of strands: an object that did not rotate must not begin to rotate");
  dynamics_ = next;
  known_from_ = known_to_ = 0;
}

std::vector<ChainState> Chains::states(const cl::Queue& queue) const {
  return states_of(states_.read(queue), strands_);
}

}  // namespace pelage::strands
