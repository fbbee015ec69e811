// By default, backward Euler omits some derivatives of the forces. This study measures how much the omission
// changes the error of backward Euler. The double-precision reference simulates once with the pruned
// Jacobian, which omits these derivatives, and once with the full Jacobian.
#include <algorithm>
#include <cmath>

#include "harness/compare/checks.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/springs/studies/base.hpp"

namespace pelage::springs {
namespace {

class JacobianStudy : public Study {
 public:
  JacobianStudy(const cl::Device& device, Setting setting, const Motions& exact)
      : Study(device, std::move(setting)), exact_(exact) {}

  FrameSample frame() override {
    FrameSample sample;
    sample.wall_ms = cost_of([&] { pruned_ = error(false); }).wall_ms;
    sample.phase_wall_ms["full"] = cost_of([&] { full_ = error(true); }).wall_ms;
    return sample;
  }
  std::vector<Check> check(const Picture&) override {
    return {{"exact", "pruned rms", pruned_.rms, tolerance::lost_run, false},
            {"exact", "full rms", full_.rms, tolerance::lost_run, false}};
  }
  void describe(Row& row) override {
    Study::describe(row);
    for (const auto& [name, found] : {std::pair("pruned", pruned_), std::pair("full", full_)}) {
      row.metrics[std::string(name) + "_error_rms"] = {found.rms, "of the length"};
      row.metrics[std::string(name) + "_error_p99"] = {found.percentile_99, "of the length"};
    }
  }

 private:
  // Simulates one second with the reference and returns the errors of the positions.
  Spread error(bool full) const {
    const SpringNetwork& topology = setting_.topology;
    Dynamics dynamics = setting_.dynamics;
    dynamics.solver =
        *std::find_if(solvers.begin(), solvers.end(), [](const Solver& s) { return s.implicit; });
    dynamics.full_jacobian = full;
    const long steps = std::lround(1 / double(dynamics.step));
    return spread(reference_offsets(topology, dynamics, rest_motions(topology), 0, steps), exact_.offset,
                  double(topology.length));
  }
  Motions exact_;
  Spread pruned_, full_;
};

}  // namespace

std::unique_ptr<Subject> solver_jacobian(const cl::Device& device, Setting setting, const Motions& exact) {
  return std::make_unique<JacobianStudy>(device, std::move(setting), exact);
}
std::unique_ptr<Subject> make_solver_jacobian(SubjectContext& context, const Case& which) {
  const Scene scene = scene_with_springs(context, which);
  const Setting setting = setting_of(context, scene);
  return solver_jacobian(context.device, setting, exact_of(context, scene, setting));
}

}  // namespace pelage::springs
