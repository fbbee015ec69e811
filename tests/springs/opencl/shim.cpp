#include "tests/springs/opencl/shim.hpp"

namespace pelage::springs::test {

Shim::Shim(const SpringNetwork& network, const Dynamics& dynamics)
    : dynamics_(dynamics), kind_(network.kind), layout_(lay_out(network, dynamics.wind)) {
  memory_.params = params(dynamics, network.length);
  memory_.params.sticks = int(network.sticks());
  memory_.params.blocks = layout_.slices / layout_.corners;
  memory_.params.blocks_per_item = 1;
  memory_.layout = &layout_;
  memory_.sites.assign(layout_.sites.begin(), layout_.sites.end());
  memory_.sides.assign(layout_.sides.begin(), layout_.sides.end());
  memory_.rest.assign(layout_.rest.begin(), layout_.rest.end());
  memory_.offset.assign(layout_.offset.begin(), layout_.offset.end());
  memory_.push.assign(3 * layout_.places(), 0);
  memory_.speed.assign((kind_ == Kind::prisms ? 4 : 3) * layout_.places(), 0);
  memory_.change.assign(4 * layout_.places(), 0);
  memory_.diverged_at.assign(layout_.places(), 0x7fffffff);
  memory_.first.assign(1, 0x7fffffff);
  stand();
}

std::size_t Shim::at(std::size_t stick, std::size_t c, bool rows) const {
  return rows ? std::size_t{4} * layout_.place[stick] + c : column_of(layout_.place[stick], 3, c);
}

void Shim::push(const std::vector<glm::vec3>& force) {
  memory_.params.pushed = !force.empty();
  for (std::size_t i = 0; i < force.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) memory_.push[at(i, c, false)] = double(force[i][int(c)]);
}

void Shim::stand() {
  for (std::vector<double>* rows : {&memory_.tip, &memory_.root, &memory_.reach})
    rows->assign(4 * layout_.places(), 0);
  for (std::size_t place = 0; place < layout_.places(); ++place)
    for (std::size_t c = 0; c < 3; ++c) {
      memory_.root[4 * place + c] = memory_.sites[column_of(place, SITE_COLUMNS, SITE_ROOT + c)];
      memory_.reach[4 * place + c] = memory_.offset[column_of(place, 3, c)];
      memory_.tip[4 * place + c] = memory_.root[4 * place + c] + memory_.reach[4 * place + c];
    }
}

void Shim::advance(int substeps, bool whole) {
  memory_.layout = &layout_;
  memory_.moments = moments(dynamics_, steps_, substeps);
  memory_.params.substeps = substeps;
  memory_.params.first_step = int(steps_);
  if (whole)
    dynamics_.solver == Solver::backward_euler ? gradients_whole(memory_, 1e-12)
                                               : prisms_whole(dynamics_.solver, memory_);
  else if (kind_ == Kind::prisms)
    for (int i = 0; i < substeps; ++i)
      if (dynamics_.solver == Solver::backward_euler)
        gradients_substep(memory_, i, 1e-12);
      else
        prism_substep(dynamics_.solver, memory_, i);
  else if (kind_ == Kind::separable_prisms)
    launch_blocks(triangle_kernels(), dynamics_.solver, memory_);
  else
    launch_blocks(stick_kernels(), dynamics_.solver, memory_);
  steps_ += substeps;
}

void Shim::set(const std::vector<glm::dvec3>& offsets, const std::vector<glm::dvec3>& speeds) {
  for (std::size_t i = 0; i < offsets.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      memory_.offset[at(i, c, false)] = offsets[i][int(c)];
      memory_.speed[at(i, c, kind_ == Kind::prisms)] = speeds[i][int(c)];
    }
  stand();
}

std::vector<glm::dvec3> Shim::by_stick(const std::vector<double>& values, bool rows) const {
  std::vector<glm::dvec3> found;
  found.reserve(layout_.place.size());
  for (std::size_t i = 0; i < layout_.place.size(); ++i)
    found.emplace_back(values[at(i, 0, rows)], values[at(i, 1, rows)], values[at(i, 2, rows)]);
  return found;
}

}  // namespace pelage::springs::test
