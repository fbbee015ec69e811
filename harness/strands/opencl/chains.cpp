#include "harness/strands/opencl/chains.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/error.hpp"
#include "harness/strands/opencl/program_texts.hpp"
#include "kernels/strands/draw/params.h"

namespace pelage::strands {
namespace {

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
      lanes_(cl::lanes_of(queue.device().info(), options.lanes)),
      own_damping_(has_own_damping(chains)),
      program_(queue.device(), chain_text(dynamics, lanes_, false, own_damping_)),
      key_program_(queue.device(), chain_keys_text(lanes_)),
      frame_(program_, "chain_frame"),
      write_keys_(key_program_, "chain_keys"),
      constants_(cl::uploaded(queue, strand_columns(chains, dynamics.wind))),
      states_(cl::uploaded(queue, state_columns(all_at_rest(chains)))) {
  if (chains.empty()) throw InputError("strands: there are none; at least one is needed");
  params_.slices = int((strands_ + 15) / 16);
  params_.units_per_item =
      cl::units_per_item(queue.device().info(), lanes_, params_.slices, options.slices_per_item);
  // With one lane, the kernel does not use the room, but a buffer cannot be empty.
  const int per_item = params_.units_per_item;
  room_ = lanes_ == 1 ? 16 : 16 * std::size_t((params_.slices + per_item - 1) / per_item);
  some_constants_ = cl::Buffer<float>(queue.device(), room_ * STRAND_COLUMNS);
  some_states_ = cl::Buffer<float>(queue.device(), room_ * CHAIN_COLUMNS);
  if (!dynamics.body) return;
  chains_ = chains;
  field_ = cl::uploaded(queue, dynamics.body->distance);
  body_ = cl::uploaded(queue, body_columns(chains, dynamics, all_at_rest(chains)));
  some_body_ = cl::Buffer<float>(queue.device(), room_ * BODY_COLUMNS);
}

Chains::MovingSkin::MovingSkin(const cl::Device& device, const cl::ProgramText& text, std::size_t room)
    : program(device, text),
      frame(program, "chain_frame"),
      some_from(device, room * STRAND_COLUMNS),
      some_to(device, room * STRAND_COLUMNS) {}

void Chains::set_skin(const cl::Queue& queue, const SkinFrame& from, const SkinFrame& to, int substeps) {
  if (substeps <= 0) throw InputError(fmt::format("substeps: {}; the number must be at least 1", substeps));
  if (dynamics_.body)
    throw InputError("skin of the strands: the distance field of a body does not follow a skin that deforms");
  const springs::Motion& m = dynamics_.motion;
  if (springs::turns(dynamics_.motion) || m.velocity != glm::vec3(0) || m.shake != glm::vec3(0))
    throw InputError("skin of the strands: its frames contain the motion, so the object must not move");
  const std::vector<float> first = skin_columns(from, strands_), last = skin_columns(to, strands_);
  if (!skin_) skin_.emplace(queue.device(), chain_text(dynamics_, lanes_, true, own_damping_), room_);
  skin_->from = cl::uploaded(queue, first);
  skin_->to = cl::uploaded(queue, last);
  skin_->first_step = steps_;
  skin_->last_step = steps_ + substeps;
}

void Chains::set_forces(const cl::Queue& queue, const std::vector<Chain>& chains,
                        const ChainDynamics& dynamics) {
  check(dynamics);
  dynamics_.gravity = dynamics.gravity;
  dynamics_.wind = dynamics.wind;
  known_from_ = known_to_ = 0;
  constants_.write(queue, strand_columns(chains, dynamics.wind));
}

void Chains::enqueue(const cl::Queue& queue, int substeps, cl::PhaseEvents* events) {
  if (substeps <= 0) throw InputError(fmt::format("substeps: {}; the number must be at least 1", substeps));
  if (skin_ && (steps_ < skin_->first_step || steps_ + substeps > skin_->last_step))
    throw InputError(fmt::format("substeps: {}; the frames of the skin have {} more steps", substeps,
                                 std::max(0L, skin_->last_step - steps_)));
  if (steps_ < known_from_ || steps_ + substeps > known_to_) {
    const int count = std::max(substeps, 256);
    moments_ = cl::uploaded(queue, moments(dynamics_, steps_, count));
    known_from_ = steps_;
    known_to_ = steps_ + count;
  }
  ChainParams p = params_;
  p.substeps = substeps;
  p.first_moment = int(steps_ - known_from_);
  if (contact_) {
    p.substeps = 1;
    for (int i = 0; i < substeps; ++i, ++p.first_moment) {
      launch(queue, p, events);
      contact_->kernel.with(p, i, constants_, states_, contact_->stage.table(), contact_->stage.field());
      cl::keep(events, "simulate",
               contact_->kernel.enqueue(queue, std::size_t(p.slices) * std::size_t(16 / lanes_)));
    }
  } else {
    launch(queue, p, events);
  }
  steps_ += substeps;
}

void Chains::launch(const cl::Queue& queue, const ChainParams& params, cl::PhaseEvents* events) {
  ChainParams p = params;
  const std::size_t units = std::size_t(p.slices) * std::size_t(16 / lanes_);
  const std::size_t items = (units + std::size_t(p.units_per_item) - 1) / std::size_t(p.units_per_item);
  if (skin_) {
    p.skin_step = 1 / float(skin_->last_step - skin_->first_step);
    p.skin_from = float(steps_ - skin_->first_step) * p.skin_step;
    skin_->frame.with(p, moments_, constants_, states_, some_constants_, some_states_, skin_->from, skin_->to,
                      skin_->some_from, skin_->some_to);
  } else if (dynamics_.body) {
    frame_.with(p, moments_, constants_, states_, some_constants_, some_states_, field_, body_, some_body_);
  } else {
    frame_.with(p, moments_, constants_, states_, some_constants_, some_states_);
  }
  cl::keep(events, "simulate", (skin_ ? skin_->frame : frame_).enqueue(queue, items));
}

void Chains::collide(const cl::Queue& queue, const Scene& scene, const ContactFields& fields) {
  cl::Program program(queue.device(), chain_contact_text(scene.contact, lanes_));
  cl::Kernel kernel(program, "chain_contact");
  contact_ = Contact{ContactStage(queue, scene, fields), std::move(program), std::move(kernel)};
}

std::vector<const cl::Program*> Chains::programs() const {
  std::vector<const cl::Program*> all{&program_, &key_program_};
  if (skin_) all.push_back(&skin_->program);
  if (contact_) all.push_back(&contact_->program);
  return all;
}

void Chains::write_keys(const cl::Queue& queue, const cl::Buffer<float>& keys, cl::PhaseEvents* events) {
  const std::size_t padded = std::size_t(params_.slices) * 16;
  if (keys.size() < padded * KEY_RECORD)
    throw InputError(
        fmt::format("key strands: room for {} floats; {} are needed", keys.size(), padded * KEY_RECORD));
  // moments() returns values at the ends of steps, and the end of step -1 is the time 0.
  const std::vector<ChainMoment> now = moments(dynamics_, steps_ - 1, 1);
  if (present_.size() == 0)
    present_ = cl::uploaded(queue, now);
  else
    present_.write(queue, now);
  const std::size_t units = padded / std::size_t(lanes_);
  write_keys_.with(std::int32_t(units), std::int32_t(0), present_, skin_ ? skin_->to : constants_, states_,
                   keys);
  cl::keep(events, "keys", write_keys_.enqueue(queue, units));
}

void Chains::set(const cl::Queue& queue, const std::vector<ChainState>& states, long steps) {
  if (states.size() != strands_)
    throw InputError(
        fmt::format("states: {} for {} strands; both counts must be equal", states.size(), strands_));
  states_.write(queue, state_columns(states));
  if (dynamics_.body) body_.write(queue, body_columns(chains_, dynamics_, states));
  steps_ = steps;
}

std::vector<ChainState> Chains::states(const cl::Queue& queue) const {
  std::vector<ChainState> states = states_of(states_.read(queue), strands_);
  if (!dynamics_.body) return states;
  const std::vector<float> body = body_.read(queue);
  for (std::size_t i = 0; i < states.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k)
      states[i].body[k] = body[(i / 16 * BODY_COLUMNS + BODY_STOP + k) * 16 + i % 16];
  return states;
}

}  // namespace pelage::strands
