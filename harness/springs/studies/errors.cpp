// Measures the errors of the solvers: the distances of the top masses from the exact state after one second
// from rest. Also compares the times of the solvers at equal error: each solver takes the longest time step
// with which its error stays below a limit, and the solvers simulate the same second in turns.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "harness/compare/checks.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/measure/turns.hpp"
#include "harness/springs/baselines/arrays.hpp"
#include "harness/springs/studies/base.hpp"

namespace pelage::springs {
namespace {

constexpr int frames_per_second = 60, most_steps = 1024;  // most_steps: greatest number of steps per frame

/// The exact solution, and the greatest rms error with which a row is ok.
struct ErrorLimit {
  std::shared_ptr<const Motions> exact;
  double rms;
};

/// One second with one solver.
class ErrorStudy : public Study {
 public:
  ErrorStudy(const cl::Device& device, Setting setting, ErrorLimit limit)
      : Study(device, std::move(setting)),
        limit_(std::move(limit)),
        masses_(queue_, setting_.network, setting_.dynamics) {
    add_programs(programs_, {&masses_.program()});
  }
  FrameSample frame() override { return {.wall_ms = from_rest(masses_).wall_ms}; }
  std::vector<Check> check(const Picture&) override {
    bounded(queue_, masses_);
    return {{"exact", "rms", error().rms, limit_.rms, false}};
  }
  void describe(Row& row) override {
    Study::describe(row);
    const Spread found = error();
    row.metrics["error_rms"] = {found.rms, "of the length"};
    row.metrics["error_p99"] = {found.percentile_99, "of the length"};
    row.metrics["error_worst"] = {found.worst, "of the length"};
  }

 protected:
  Spread error() const {
    return spread(masses_.offsets(queue_), limit_.exact->offset, double(setting_.network.length));
  }

  ErrorLimit limit_;
  MassSprings masses_;
};

/// One second with one of several solvers that take turns.
class SecondOfSolver : public ErrorStudy {
 public:
  SecondOfSolver(const cl::Device& device, Setting setting, const Solver& solver, int steps, ErrorLimit limit)
      : ErrorStudy(device, with(std::move(setting), solver, steps), std::move(limit)),
        name_(solver.name),
        steps_(steps) {}

  FrameSample frame() override {
    const Cost cost = from_rest(masses_);
    FrameSample sample;
    sample.wall_ms = sample.phase_wall_ms[name_] = cost.wall_ms;
    sample.cpu_ms = sample.phase_cpu_ms[name_] = cost.cpu_ms;
    return sample;
  }
  std::vector<Check> check(const Picture& none) override {
    std::vector<Check> checks = ErrorStudy::check(none);
    checks.front().metric = name_ + " rms";
    return checks;
  }
  void describe(Row& row) override {
    Study::describe(row);  // NOLINT(bugprone-parent-virtual-call): without the error of ErrorStudy
    // The metric of the base class is removed, because each solver has its own time step.
    row.metrics.erase("step_ms");
    const Spread found = error();
    row.metrics[name_ + "_steps_per_frame"] = {double(steps_), "steps"};
    row.metrics[name_ + "_step_ms"] = {1e3 * double(setting_.dynamics.step), "ms"};
    row.metrics[name_ + "_error_rms"] = {found.rms, "of the length"};
    row.metrics[name_ + "_error_p99"] = {found.percentile_99, "of the length"};
  }

  /// Simulates the second once and returns the rms error, or infinity if the simulation diverges.
  double tried() {
    frame();
    try {
      masses_.check(queue_);
    } catch (const Diverged&) {
      return std::numeric_limits<double>::infinity();
    }
    return error().rms;
  }

 private:
  static Setting with(Setting setting, const Solver& solver, int steps) {
    setting.dynamics.solver = solver;
    setting.dynamics.step = 1.0f / float(frames_per_second * steps);
    return setting;
  }

  std::string name_;
  int steps_;  // per frame
};

/// The solvers that take turns, and the rms errors of those whose error exceeds the limit even with
/// most_steps steps per frame.
struct Entrants {
  std::vector<Turn> reached;
  std::map<std::string, double> unreached_rms;
};

/// Finds the smallest number of steps per frame with which the solver's error is within the limit, and adds
/// the solver.
void enter(Entrants& entrants, const cl::Device& device, const Setting& setting, const Solver& solver,
           const ErrorLimit& limit) {
  const auto with = [&](int steps) {
    return std::make_unique<SecondOfSolver>(device, setting, solver, steps, limit);
  };
  const std::string name(solver.name);
  int enough = 1;
  double rms = with(enough)->tried();
  while (rms > limit.rms && enough < most_steps) rms = with(enough *= 2)->tried();
  if (rms > limit.rms) {
    entrants.unreached_rms[name] = rms;
    return;
  }
  for (int few = enough / 2; enough - few > 1;) {
    const int middle = (few + enough) / 2;
    (with(middle)->tried() > limit.rms ? few : enough) = middle;
  }
  entrants.reached.push_back({name, with(enough)});
}

/// The solvers in turns. The row also names the solvers that missed the limit.
class EqualError : public Turns {
 public:
  EqualError(std::unique_ptr<Subject> first, std::vector<Turn> others, TurnRules rules,
             std::map<std::string, double> unreached_rms)
      : Turns(std::move(first), std::move(others), std::move(rules)),
        unreached_rms_(std::move(unreached_rms)) {}
  void describe(Row& row) override {
    Turns::describe(row);
    for (const auto& [name, rms] : unreached_rms_)
      row.metrics[name + "_unreached_rms"] = {rms, "of the length"};
  }

 private:
  std::map<std::string, double> unreached_rms_;
};

}  // namespace

Motions exact_second(const SpringNetwork& network, const Dynamics& dynamics, float step) {
  Dynamics fine = dynamics;
  fine.solver = highest_order;
  fine.step = step;
  const long steps = std::lround(1 / double(step));
  const auto run = serial_in_double(network, fine);
  run->set(rest_motions(network));
  for (long done = 0; done < steps; done += 1000) {
    const int count = int(std::min(1000L, steps - done));
    run->advance(moments(fine, done, count), count);
  }
  return run->state();
}

std::unique_ptr<Subject> solver_error(const cl::Device& device, Setting setting, const Motions& exact) {
  const ErrorLimit limit{std::make_shared<Motions>(exact), tolerance::lost_run};
  return std::make_unique<ErrorStudy>(device, std::move(setting), limit);
}

std::unique_ptr<Subject> solver_turns(const cl::Device& device, const Setting& setting, const Motions& exact,
                                      double most_error) {
  if (!(most_error > 0))
    throw InputError(
        "dynamics.tolerance = 0: the pipeline springs-turns needs the largest permitted rms error, as a fraction of fur.length; give a tolerance above 0");
  const ErrorLimit limit{std::make_shared<Motions>(exact), most_error};
  Entrants entrants;
  enter(entrants, device, setting, default_solver, limit);  // the other times are divided by its time
  for (const Solver& solver : solvers)
    if (solver != default_solver) enter(entrants, device, setting, solver, limit);
  if (entrants.reached.empty())
    throw OutOfBounds(fmt::format("no solver has an rms error of at most {} with {} steps per frame",
                                  most_error, most_steps));
  std::unique_ptr<Subject> first = std::move(entrants.reached.front().subject);
  entrants.reached.erase(entrants.reached.begin());
  TurnRules rules;
  rules.check = [](const Turn& other, const Picture& none) { return other.subject->check(none); };
  rules.describe = [](const Turn& other, Row& row) { other.subject->describe(row); };
  rules.rotate = true;
  return std::make_unique<EqualError>(std::move(first), std::move(entrants.reached), std::move(rules),
                                      std::move(entrants.unreached_rms));
}

/// Throws InputError if no whole number of steps makes one second. The simulation would end at another time
/// than the exact solution, and the difference would count as an error of the solver.
void refuse_uneven_step(double step) {
  constexpr double rounding = 1e-6;  // s; that of the step, in all steps together
  const double steps = std::max(1.0, std::round(1 / step));
  if (std::abs(steps * step - 1) > rounding)
    throw InputError(fmt::format(
        "dynamics.step = {:.6g}: {:.0f} steps end at {:.6g} s, but the study compares states after exactly one second; "
        "give {:.10g}, or another step that divides one second",
        step, steps, steps * step, 1 / steps));
}

std::unique_ptr<Subject> make_solver_error(SubjectContext& context, const Case& which) {
  const Scene scene = scene_with_springs(context, which);
  refuse_uneven_step(double(scene.dynamics.step));
  const Setting setting = setting_of(context, scene);
  return solver_error(context.device, setting, exact_of(context, scene, setting));
}
std::unique_ptr<Subject> make_solver_turns(SubjectContext& context, const Case& which) {
  const Scene scene = scene_with_springs(context, which);
  const Setting setting = setting_of(context, scene);
  return solver_turns(context.device, setting, exact_of(context, scene, setting),
                      double(scene.dynamics.tolerance));
}

// By default, backward Euler omits some derivatives of the forces. This study measures how much the omission
// changes the error of backward Euler. The double-precision reference simulates once with the pruned
// Jacobian, which omits these derivatives, and once with the full Jacobian.

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
    const SpringNetwork& network = setting_.network;
    Dynamics dynamics = setting_.dynamics;
    dynamics.solver = *std::ranges::find_if(solvers, [](const Solver& s) { return s.implicit; });
    dynamics.full_jacobian = full;
    const long steps = std::lround(1 / double(dynamics.step));
    return spread(reference_offsets(network, dynamics, rest_motions(network), 0, steps), exact_.offset,
                  double(network.length));
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
  refuse_uneven_step(double(scene.dynamics.step));
  const Setting setting = setting_of(context, scene);
  return solver_jacobian(context.device, setting, exact_of(context, scene, setting));
}

}  // namespace pelage::springs
