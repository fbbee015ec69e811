#include "tests/springs/opencl/shim.hpp"
// clang-format off: the next header must be the last one, because its macros would break other headers
#include "tests/springs/support/in_double.hpp"
// clang-format on

namespace pelage::prisms_in_double {
namespace {
using namespace in_double;
// clang-format off
#include "springs/prisms.cl"
// clang-format on
}  // namespace
}  // namespace pelage::prisms_in_double

namespace pelage::springs::test {
void prism_substep(Solver solver, Memory& m, int substep) {
  namespace kernels = prisms_in_double;
  const Layout& l = *m.layout;
  const int number = m.params.first_step + substep;
  const auto each = [&](const auto& kernel) {
    for (in_double::work_item = 0; in_double::work_item < 16 * l.slices; ++in_double::work_item) kernel();
  };
  std::vector<double> tip = m.tip, speed = m.speed, next_tip = m.tip, next_speed = m.speed;
  if (!solver.multistage()) {
    each([&] {
      kernels::prism_euler(m.params, solver == Solver::semi_implicit_euler, 2 * substep, number,
                           m.moments.data(), m.sites.data(), m.push.data(), l.start.data(),
                           l.neighbour.data(), m.rest.data(), m.tip.data(), m.speed.data(), m.offset.data(),
                           next_tip.data(), next_speed.data(), m.diverged_at.data(), m.first.data());
    });
    m.tip = next_tip, m.speed = next_speed;
    return;
  }
  std::vector<double> offset = m.offset, sum_offset = m.offset, sum_speed = m.offset, next_offset = m.offset;
  for (int stage = 0; stage < solver.stages; ++stage) {
    const int moment = kernels::stage_of(solver.stages, stage, 1).moment;
    each([&] {
      kernels::prism_stage(m.params, solver.stages, stage, 2 * substep + moment, number, m.moments.data(),
                           m.sites.data(), m.push.data(), l.start.data(), l.neighbour.data(), m.rest.data(),
                           tip.data(), speed.data(), offset.data(), m.offset.data(), m.speed.data(),
                           sum_offset.data(), sum_speed.data(), next_tip.data(), next_speed.data(),
                           next_offset.data(), m.diverged_at.data(), m.first.data());
    });
    tip = next_tip, speed = next_speed, offset = next_offset;
  }
  m.tip = tip;
}

void prisms_whole(Solver solver, Memory& m) {
  namespace kernels = prisms_in_double;
  const Layout& l = *m.layout;
  in_double::work_item = 0;
  std::vector<double> other_tip = m.tip, other_speed = m.speed;
  if (solver.multistage()) {
    std::vector<double> spare_tip = m.tip, spare_speed = m.speed, offset = m.offset, sum = m.offset,
                        rate = m.offset;
    kernels::prism_stages_whole(m.params, solver.stages, m.moments.data(), m.sites.data(), m.push.data(),
                                l.start.data(), l.neighbour.data(), m.rest.data(), m.tip.data(),
                                m.speed.data(), m.offset.data(), other_tip.data(), other_speed.data(),
                                spare_tip.data(), spare_speed.data(), offset.data(), sum.data(), rate.data(),
                                m.diverged_at.data(), m.first.data());
    return;
  }
  kernels::prism_euler_whole(m.params, solver == Solver::semi_implicit_euler, m.moments.data(),
                             m.sites.data(), m.push.data(), l.start.data(), l.neighbour.data(), m.rest.data(),
                             m.tip.data(), m.speed.data(), m.offset.data(), other_tip.data(),
                             other_speed.data(), m.diverged_at.data(), m.first.data());
  if (m.params.substeps % 2 == 1) m.tip = other_tip, m.speed = other_speed;
}

}  // namespace pelage::springs::test
