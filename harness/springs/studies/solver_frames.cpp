// The steps of one frame: alone on the device, or in turns with the baselines.
#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <thread>

#include "harness/compare/checks.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/measure/turns.hpp"
#include "harness/springs/studies/base.hpp"
#include "harness/springs/studies/study.hpp"

namespace pelage::springs {
namespace {

// Backward Euler is compared with the double-precision reference up to this number of sticks. For larger
// models the reference's sparse factorization is too slow.
constexpr std::size_t most_factored = 20000;

/// The steps of one frame on the device. Each frame() also measures the launch of an empty kernel.
class SolverFrames : public Study {
 public:
  /// `alone`: no baseline solves the same system.
  SolverFrames(const cl::Device& device, Setting setting, int substeps, bool alone)
      : Study(device, std::move(setting)),
        substeps_(substeps),
        alone_(alone),
        masses_(queue_, setting_.network, setting_.dynamics),
        measure_(device, "measure/measure.cl", "-D LANES=1"),
        nothing_(measure_, "nothing_of_seven") {
    for (cl::Buffer<float>& one : nowhere_) one = cl::Buffer<float>(device, 1);
    add_programs(programs_, {&masses_.program()});
  }

  FrameSample frame() override {
    const Motions& start = setting_.start;
    enqueue_.push_back(cost_of([&] {
                         auto& [a, b, c, d, e, f, g] = nowhere_;
                         const cl::Event event = nothing_.with(a, b, c, d, e, f, g).enqueue(queue_, 1);
                         queue_.finish();
                       }).wall_ms);
    masses_.set(queue_, start.offset, start.speed, setting_.steps);
    queue_.finish();
    const Cost cost = cost_of([&] {
      masses_.enqueue(queue_, substeps_);
      queue_.finish();
    });
    return {.wall_ms = cost.wall_ms, .cpu_ms = cost.cpu_ms};
  }

  std::vector<Check> check(const Picture&) override {
    bounded(queue_, masses_);
    if (!setting_.dynamics.solver.implicit || setting_.network.sticks() <= most_factored)
      return agreement(against_reference, reference_offsets(setting_.network, setting_.dynamics,
                                                            setting_.start, setting_.steps, substeps_));
    return alone_ && substeps_ == 1 ? step_checks(masses_.offsets(queue_)) : std::vector<Check>{};
  }

  /// Returns the checks of our positions against others.
  std::vector<Check> agreement(const std::string& against, const std::vector<glm::vec3>& theirs) const {
    return agreement_checks(setting_.network.kind, against,
                            spread(masses_.offsets(queue_), theirs, double(setting_.network.length)));
  }

  void describe(Row& row) override {
    Study::describe(row);
    row.build_ms = masses_.program().build_ms();
    row.provenance["kernel_hash"] = cl::hash_of({&masses_.program()});
    row.metrics["springs"] = {double(setting_.network.spring.size()), "springs"};
    row.metrics["device_bytes"] = {double(masses_.bytes()), "bytes"};
    row.metrics["substeps"] = {double(substeps_), "steps"};
    row.metrics["enqueue_ms"] = {median(enqueue_), "ms"};
    row.metrics["processor_ms"] = {median(row.samples["frame"].cpu_ms), "ms"};
    if (masses_.solves().solves > 0)
      row.metrics["iterations"] = {double(masses_.solves().iterations) / double(masses_.solves().solves),
                                   "iterations"};
    describe_gap(shape_of(setting_.network, masses_.offsets(queue_)), row);
  }

  /// Returns the times of the launches of an empty kernel in the last `count` rounds, in ms.
  std::span<const double> launches(std::size_t count) const { return std::span(enqueue_).last(count); }

 private:
  // Checks one step of backward Euler. This check is used for models that are too large for the reference's
  // factorization. Let A x = b be the reference's linear equations for the change x of the velocities. The
  // check inserts the device's change of the velocities as x and computes the relative residual |b - A x| /
  // |b|. Also checks that each new position is the old position plus the time step times the new velocity.
  std::vector<Check> step_checks(const std::vector<glm::vec3>& offsets) const {
    const std::vector<glm::vec3> speeds = masses_.speeds(queue_);
    const Motions& before = setting_.start;
    std::vector<glm::dvec3> change;
    std::vector<glm::vec3> moved;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      change.push_back(glm::dvec3(speeds[i]) - glm::dvec3(before.speed[i]));
      moved.push_back(before.offset[i] + setting_.dynamics.step * speeds[i]);
    }
    const double left =
        reference::residual({setting_.network, setting_.dynamics}, reference_state(setting_.network, before),
                            setting_.steps, change);
    return {{against_reference, "residual", left, tolerance::step_residual, false},
            {"own speeds", "worst", spread(offsets, moved, double(setting_.network.length)).worst,
             tolerance::stick_top, false}};
  }

  int substeps_;
  bool alone_;
  MassSprings masses_;
  cl::Program measure_;
  cl::Kernel nothing_;
  std::array<cl::Buffer<float>, 7> nowhere_;
  std::vector<double> enqueue_;  // wall times in ms of launches of an empty kernel, warm-up included
};

/// The steps of one frame by a baseline.
class BaselineFrames : public Subject {
 public:
  BaselineFrames(NamedBaseline baseline, Motions start, std::vector<Moment> moments, int substeps)
      : baseline_(std::move(baseline)),
        start_(std::move(start)),
        moments_(std::move(moments)),
        substeps_(substeps) {}

  FrameSample frame() override {
    baseline_.solver->set(start_);
    const Cost cost = cost_of([&] { baseline_.solver->advance(moments_, substeps_); });
    ++frames_;
    // After their work, OpenMP threads wait in a loop for a short time, which uses CPU time. The pause of 10
    // ms keeps this CPU time out of the next measurement.
    if (baseline_.threads > 1) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return {.wall_ms = cost.wall_ms, .cpu_ms = cost.cpu_ms};
  }
  Picture read() override { return {}; }
  std::vector<Check> check(const Picture&) override { return {}; }
  void describe(Row& row) override {
    if (baseline_.solver->iterations() > 0)
      row.metrics[baseline_.name + "_iterations"] = {
          double(baseline_.solver->iterations()) / double(substeps_) / double(frames_), "iterations"};
  }

  std::vector<glm::vec3> offsets() const { return baseline_.solver->state().offset; }
  int threads() const { return baseline_.threads; }

 private:
  NamedBaseline baseline_;
  Motions start_;
  std::vector<Moment> moments_;
  int substeps_;
  std::size_t frames_ = 0;
};

/// Adds the metrics of the baseline `name` that compare its times with ours. `cores` is the number of cores
/// that share our CPU time.
void compare_times(Row& row, const std::string& name, const SolverFrames& ours, const BaselineFrames& theirs,
                   unsigned cores) {
  const PhaseSamples &frame = row.samples["frame"], &phase = row.samples[name];
  const std::span<const double> launches = ours.launches(frame.wall_ms.size());
  std::vector<double> excess;
  for (std::size_t i = 0; i < launches.size(); ++i)
    excess.push_back(frame.wall_ms[i] - phase.wall_ms[i] - launches[i]);
  row.metrics[name + "_excess_ms"] = median_metric(excess, "ms");
  const double cpu = median(phase.cpu_ms), shared = median(frame.cpu_ms) / double(cores);
  row.metrics[name + "_processor_ms"] = {cpu, "ms"};
  if (theirs.threads() == 1) row.metrics[name + "_processor_ratio"] = {cpu / shared, "times"};
}

/// Makes a subject that times the steps of one frame on the device and, if `baselines` is set, in turns with
/// every baseline solver. All start from `setting.start`.
std::unique_ptr<Subject> solver_frames(const cl::Device& device, Setting setting, int substeps,
                                       bool baselines) {
  std::vector<Turn> others;
  if (baselines)
    for (NamedBaseline& one : solver_baselines(setting.network, setting.dynamics)) {
      const std::string name = one.name;
      others.push_back({name, std::make_unique<BaselineFrames>(
                                  std::move(one), setting.start,
                                  moments(setting.dynamics, setting.steps, substeps), substeps)});
    }
  auto ours = std::make_unique<SolverFrames>(device, std::move(setting), substeps, others.empty());
  const unsigned cores = device.info().cpu ? std::max(1u, device.info().compute_units) : 1;
  TurnRules rules;
  rules.check = [&first = *ours](const Turn& other, const Picture&) {
    return first.agreement(other.name, dynamic_cast<BaselineFrames&>(*other.subject).offsets());
  };
  rules.describe = [&first = *ours, cores](const Turn& other, Row& row) {
    compare_times(row, other.name, first, dynamic_cast<BaselineFrames&>(*other.subject), cores);
    other.subject->describe(row);
  };
  return std::make_unique<Turns>(std::move(ours), std::move(others), std::move(rules));
}

std::unique_ptr<Subject> solver_after_start(SubjectContext& context, const Case& which, bool baselines) {
  const Scene scene = scene_with_springs(context, which);
  Setting setting = setting_of(context, scene);
  setting.start = rest_motions(setting.network);
  if (scene.dynamics.time > 0) {
    const cl::Queue queue(context.device);
    MassSprings before(queue, setting.network, setting.dynamics);
    simulate(queue, before, setting.dynamics, double(scene.dynamics.time));
    setting.start = {before.offsets(queue), before.speeds(queue)};
    setting.steps = before.steps();
  }
  return solver_frames(context.device, std::move(setting), scene.dynamics.substeps, baselines);
}

}  // namespace

std::unique_ptr<Subject> make_solver(SubjectContext& context, const Case& which) {
  return solver_after_start(context, which, false);
}
std::unique_ptr<Subject> make_solver_against_baselines(SubjectContext& context, const Case& which) {
  return solver_after_start(context, which, true);
}

}  // namespace pelage::springs
