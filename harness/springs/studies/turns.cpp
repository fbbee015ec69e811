// Compares the times of the solvers at equal error. Each solver takes the longest time step with which its
// error stays below a limit. One after the other, the solvers simulate the same second
// from rest.
#include <fmt/format.h>

#include <algorithm>

#include "harness/compare/masses.hpp"
#include "harness/error.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/springs/studies/base.hpp"

namespace pelage::springs {
namespace {

constexpr int frames_per_second = 60, most_steps = 1024;  // most_steps: greatest number of steps per frame

class TurnsStudy : public Study {
 public:
  TurnsStudy(const cl::Device& device, Setting setting, const Motions& exact, double most_error)
      : Study(device, std::move(setting)), exact_(exact), most_error_(most_error) {
    if (!(most_error_ > 0))
      throw InputError(
          "dynamics.tolerance = 0: the pipeline springs-turns needs the largest permitted rms error, as a "
          "fraction of fur.length; give a tolerance above 0");
    enter(default_solver);  // the first entrant: the other solvers' times are divided by its time
    for (const Solver& solver : solvers)
      if (solver != default_solver) enter(solver);
    if (entrants_.empty())
      throw OutOfBounds(fmt::format("no solver has an rms error of at most {} with {} steps per frame",
                                    most_error_, most_steps));
  }

  FrameSample frame() override {
    FrameSample sample;
    // Each round begins with a different solver, so that no solver is always the first or the last.
    const std::size_t first = round_++ % entrants_.size();
    for (std::size_t i = 0; i < entrants_.size(); ++i) {
      Entrant& one = entrants_[(first + i) % entrants_.size()];
      begin(one);
      const Cost cost = cost_of([&] { simulate(queue_, one.masses, one.dynamics, 1); });
      sample.phase_wall_ms[one.name] = cost.wall_ms;
      sample.phase_cpu_ms[one.name] = cost.cpu_ms;
    }
    sample.wall_ms = sample.phase_wall_ms[entrants_.front().name];
    return sample;
  }

  std::vector<Check> check(const Picture&) override {
    std::vector<Check> checks;
    for (Entrant& one : entrants_) {
      bounded(queue_, one.masses);
      checks.push_back({"exact", one.name + " rms", error(one).rms, most_error_, false});
    }
    return checks;
  }

  void describe(Row& row) override {
    Study::describe(row);
    // Removes the metric of the base class, because each solver has its own time step.
    row.metrics.erase("step_ms");
    for (Entrant& one : entrants_) {
      const Spread found = error(one);
      row.metrics[one.name + "_steps_per_frame"] = {double(one.steps), "steps"};
      row.metrics[one.name + "_step_ms"] = {1e3 * double(one.dynamics.step), "ms"};
      row.metrics[one.name + "_error_rms"] = {found.rms, "of the length"};
      row.metrics[one.name + "_error_p99"] = {found.percentile_99, "of the length"};
      if (&one != &entrants_.front())
        row.metrics[one.name + "_ratio"] =
            median_ratio(row.samples[one.name].wall_ms, row.samples[entrants_.front().name].wall_ms);
    }
    for (const auto& [name, rms] : unreached_) row.metrics[name + "_unreached_rms"] = {rms, "of the length"};
  }

 private:
  struct Entrant {
    std::string name;
    Dynamics dynamics;
    int steps;  // per frame
    MassSprings masses;
  };

  void begin(Entrant& one) {
    const Motions start = rest_motions(setting_.topology);
    one.masses.set(queue_, start.offset, start.speed);
    queue_.finish();
  }
  Spread error(const Entrant& one) const {
    return spread(one.masses.offsets(queue_), exact_.offset, double(setting_.topology.length));
  }
  Entrant entrant(const Solver& solver, int steps) {
    Dynamics dynamics = setting_.dynamics;
    dynamics.solver = solver;
    dynamics.step = 1.0f / float(frames_per_second * steps);
    return {std::string(solver.name), dynamics, steps, MassSprings(queue_, setting_.topology, dynamics)};
  }
  // Simulates one second with `steps` steps per frame, and returns the rms error. Returns infinity if
  // the simulation diverges.
  double tried(const Solver& solver, int steps) {
    Entrant one = entrant(solver, steps);
    simulate(queue_, one.masses, one.dynamics, 1);
    try {
      one.masses.check(queue_);
    } catch (const Diverged&) {
      return std::numeric_limits<double>::infinity();
    }
    return error(one).rms;
  }
  // Finds the smallest number of steps per frame with which the solver's rms error is at most most_error_.
  // Then adds the solver to entrants_, the list of solvers that are timed.
  void enter(const Solver& solver) {
    int enough = 1;
    double rms = tried(solver, enough);
    while (rms > most_error_ && enough < most_steps) rms = tried(solver, enough *= 2);
    if (rms > most_error_) {
      unreached_[std::string(solver.name)] = rms;
      return;
    }
    for (int few = enough / 2; enough - few > 1;) {
      const int middle = (few + enough) / 2;
      (tried(solver, middle) > most_error_ ? few : enough) = middle;
    }
    entrants_.push_back(entrant(solver, enough));
    add_programs(programs_, {&entrants_.back().masses.program()});
  }

  Motions exact_;
  double most_error_;
  std::vector<Entrant> entrants_;
  // Rms errors of the solvers whose error exceeds most_error_ even with most_steps steps per frame.
  std::map<std::string, double> unreached_;
  std::size_t round_ = 0;
};

}  // namespace

std::unique_ptr<Subject> solver_turns(const cl::Device& device, Setting setting, const Motions& exact,
                                      double most_error) {
  return std::make_unique<TurnsStudy>(device, std::move(setting), exact, most_error);
}

}  // namespace pelage::springs
