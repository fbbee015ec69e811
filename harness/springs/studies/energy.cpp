// Records the energy of a mass-spring simulation over time. In the pipeline springs-drift, the scene must
// be conservative, and the study also computes how much the energy drifts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/springs/studies/base.hpp"

namespace pelage::springs {
namespace {

constexpr double energy_seconds = 4, look_seconds = 0.05;

class EnergyStudy : public Study {
 public:
  EnergyStudy(const cl::Device& device, Setting setting, bool conservative)
      : Study(device, std::move(setting)), conservative_(conservative) {
    if (conservative_) need_conservative();
  }
  FrameSample frame() override {
    MassSprings masses(queue_, setting_.network, setting_.dynamics);
    add_programs(programs_, {&masses.program()});
    energy_.clear();
    if (conservative_) energy_[0] = energy(masses);
    double next = 0;
    const auto look = [&](double time) {
      if (time + 1e-9 < next) return true;
      bounded(queue_, masses);
      energy_[time] = energy(masses);
      next = time + look_seconds;
      return true;
    };
    const auto run = [&] { simulate(queue_, masses, setting_.dynamics, energy_seconds, 1.0 / 60, look); };
    return {.wall_ms = cost_of(run).wall_ms};
  }
  std::vector<Check> check(const Picture&) override {
    return {{"four seconds", "times", double(energy_.size()), 40, true}};
  }
  void describe(Row& row) override {
    Study::describe(row);
    if (conservative_) describe_drift(row);
    for (const auto& [time, joules] : energy_)
      row.metrics[fmt::format("{}energy_uJ_at_{:.3f}", conservative_ ? "total_" : "", time)] = {1e6 * joules,
                                                                                                "uJ"};
  }

 private:
  // Throws InputError if the scene is not conservative. In a conservative scene the energy of the exact
  // motion is constant, so every change of the energy is an error of the solver.
  void need_conservative() const {
    const Dynamics& d = setting_.dynamics;
    const auto needs_0 = [](const char* key, double value) {
      if (value != 0)
        throw InputError(fmt::format(
            "{} = {}: the pipeline springs-drift needs a conservative scene, in which this value is 0", key,
            value));
    };
    needs_0("dynamics.drag", double(d.drag));
    needs_0("dynamics.springs.damping", double(d.damping));
    needs_0("dynamics.springs.edge_damping", double(d.edge_damping));
    needs_0("dynamics.springs.return_weight", double(d.return_weight));
    needs_0("dynamics.motion.spin", double(d.motion.spin));
    needs_0("dynamics.motion.swing", double(d.motion.swing));
    needs_0("length of dynamics.motion.shake", double(glm::length(d.motion.shake)));
  }
  // Adds the metrics `drift` and `drift_most`. `drift` is the change of the energy from the start to the end
  // of the simulation. `drift_most` is the largest absolute change from the start to any recorded time. Their
  // unit is the energy that all masses would release if they fell by the fur's length.
  void describe_drift(Row& row) const {
    const double unit = double(setting_.network.sticks()) * double(setting_.dynamics.mass) *
                        double(glm::length(setting_.dynamics.gravity)) * double(setting_.network.length);
    const double start = energy_.begin()->second;
    double most = 0;
    for (const auto& [time, joules] : energy_) most = std::max(most, std::abs(joules - start));
    row.metrics["drift"] = {(energy_.rbegin()->second - start) / unit, "of m g L0"};
    row.metrics["drift_most"] = {most / unit, "of m g L0"};
  }
  double energy(const MassSprings& masses) const {
    const reference::System system{setting_.network, setting_.dynamics};
    const reference::State state =
        reference_state(setting_.network, {masses.offsets(queue_), masses.speeds(queue_)});
    return conservative_ ? reference::total_energy(system, state) : reference::energy(system, state);
  }

  bool conservative_;
  std::map<double, double> energy_;  // key: simulated time in seconds; value: energy in joules
};

}  // namespace

std::unique_ptr<Subject> solver_energy(const cl::Device& device, Setting setting, bool conservative) {
  return std::make_unique<EnergyStudy>(device, std::move(setting), conservative);
}
std::unique_ptr<Subject> make_solver_energy(SubjectContext& context, const Case& which) {
  return solver_energy(context.device, setting_of(context, scene_with_springs(context, which)), false);
}
std::unique_ptr<Subject> make_solver_drift(SubjectContext& context, const Case& which) {
  return solver_energy(context.device, setting_of(context, scene_with_springs(context, which)), true);
}

}  // namespace pelage::springs
