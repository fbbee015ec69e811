#include "tests/topology/shim.hpp"

namespace pelage::springs::test {

Shim::Shim(const Topology& topology, const Dynamics& dynamics)
    : dynamics_(dynamics), kind_(topology.kind), layout_(lay_out(topology, dynamics.wind)) {
  memory_.params = params(dynamics, topology.length);
  memory_.params.sticks = int(topology.sticks());
  memory_.params.blocks = layout_.blocks;
  memory_.params.blocks_per_item = 1;
  memory_.layout = &layout_;
  memory_.push.assign(layout_.rows(), glm::vec4(0));
  for (const glm::vec4& row : layout_.offset)
    for (int c = 0; c < 4; ++c) memory_.offset.push_back(double(row[c]));
  memory_.speed.assign(memory_.offset.size(), 0);
  memory_.change = memory_.speed;
  stand();
  memory_.diverged_at.assign(layout_.rows(), 0x7fffffff);
  memory_.first.assign(1, 0x7fffffff);
}

void Shim::push(const std::vector<glm::vec3>& force) {
  memory_.params.pushed = !force.empty();
  for (std::size_t i = 0; i < force.size(); ++i) memory_.push[layout_.place[i]] = glm::vec4(force[i], 0);
}

void Shim::stand() {
  memory_.tip = memory_.offset;
  for (std::size_t row = 0; row < layout_.rows(); ++row)
    for (int c = 0; c < 3; ++c) memory_.tip[4 * row + std::size_t(c)] += double(layout_.root[row][c]);
}

void Shim::advance(int substeps) {
  memory_.layout = &layout_;
  memory_.moments = moments(dynamics_, steps_, substeps);
  memory_.params.substeps = substeps;
  memory_.params.first_step = int(steps_);
  if (kind_ == Kind::prisms)
    for (int i = 0; i < substeps; ++i)
      if (dynamics_.solver == Solver::backward_euler)
        gradients_substep(memory_, i, 1e-12);
      else
        prism_substep(dynamics_.solver, memory_, i);
  else if (kind_ == Kind::separable_prisms)
    launch_triangles(dynamics_.solver, memory_);
  else
    launch_sticks(dynamics_.solver, memory_);
  steps_ += substeps;
}

void Shim::set(const std::vector<glm::dvec3>& offsets, const std::vector<glm::dvec3>& speeds) {
  for (std::size_t i = 0; i < offsets.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      memory_.offset[4 * layout_.place[i] + std::size_t(c)] = offsets[i][c];
      memory_.speed[4 * layout_.place[i] + std::size_t(c)] = speeds[i][c];
    }
  stand();
}

std::vector<glm::dvec3> Shim::by_stick(const std::vector<double>& rows) const {
  std::vector<glm::dvec3> values;
  for (const std::uint32_t place : layout_.place)
    values.emplace_back(rows[4 * place], rows[4 * place + 1], rows[4 * place + 2]);
  return values;
}

}  // namespace pelage::springs::test
