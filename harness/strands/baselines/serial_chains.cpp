#include "harness/strands/baselines/serial_chains.hpp"

#include <algorithm>

namespace pelage::strands {
namespace {

constexpr std::size_t slice = 16;
constexpr int moments_at_once = 256;

void copy(float* to, glm::vec3 v) {
  for (int i = 0; i < 3; ++i) to[i] = v[i];
}

/// The constants in the kernels' memory layout have the same order as the members of SerialStrand.
std::vector<SerialStrand> strands_of(const std::vector<Chain>& chains, const springs::Wind& wind) {
  static_assert(sizeof(SerialStrand) == STRAND_COLUMNS * sizeof(float));
  const std::vector<float> columns = strand_columns(chains, wind);
  std::vector<SerialStrand> strands(chains.size());
  for (std::size_t i = 0; i < strands.size(); ++i) {
    auto* to = reinterpret_cast<float*>(&strands[i]);
    for (std::size_t c = 0; c < STRAND_COLUMNS; ++c)
      to[c] = columns[(i / slice * STRAND_COLUMNS + c) * slice + i % slice];
  }
  return strands;
}

std::vector<SerialState> states_of(const std::vector<Chain>& chains) {
  std::vector<SerialState> states;
  states.reserve(chains.size());
  for (const Chain& chain : chains) {
    const ChainState from = at_rest(chain);
    SerialState s{};
    copy(s.u, from.direction[0]);
    copy(s.w, from.direction[1]);
    states.push_back(s);
  }
  return states;
}

}  // namespace

SerialChains::SerialChains(const std::vector<Chain>& chains, const ChainDynamics& dynamics, SerialLoop loop)
    : dynamics_(dynamics),
      params_((check(dynamics), params(dynamics))),
      loop_(loop),
      strands_(strands_of(chains, dynamics.wind)),
      states_(states_of(chains)) {}

void SerialChains::advance(int substeps) {
  if (moments_.empty() || steps_ + substeps > known_from_ + long(moments_.size())) {
    known_from_ = steps_;
    moments_ = moments(dynamics_, steps_, std::max(substeps, moments_at_once));
  }
  params_.substeps = substeps;
  params_.first_moment = int(steps_ - known_from_);
  loop_(params_, moments_.data(), strands_.data(), states_.data(), int(strands_.size()));
  steps_ += substeps;
}

std::vector<ChainState> SerialChains::states() const {
  std::vector<ChainState> result(states_.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const SerialState& s = states_[i];
    result[i].direction = {glm::vec3(s.u[0], s.u[1], s.u[2]), glm::vec3(s.w[0], s.w[1], s.w[2])};
    result[i].rate = {glm::vec3(s.a[0], s.a[1], s.a[2]), glm::vec3(s.b[0], s.b[1], s.b[2])};
    for (std::size_t k = 0; k < 4; ++k) result[i].stop[k] = s.stop[k];
  }
  return result;
}

}  // namespace pelage::strands
