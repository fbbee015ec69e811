#include <array>
#include <chrono>
#include <thread>

#include "harness/compare/masses.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/springs/reference/reference.hpp"
#include "harness/springs/studies/base.hpp"
#include "harness/springs/studies/shape.hpp"

namespace pelage::springs {
namespace {

// Backward Euler is compared with the double-precision reference up to this number of sticks. For larger
// models the reference's sparse factorization is too slow.
constexpr std::size_t most_factored = 20000;

class Duel : public Subject {
 public:
  Duel(const cl::Device& device, Setting setting, int substeps, bool rivals)
      : queue_(device),
        setting_(std::move(setting)),
        substeps_(substeps),
        cores_(device.info().cpu ? std::max(1u, device.info().compute_units) : 1),
        masses_(queue_, setting_.topology, setting_.dynamics),
        moments_(moments(setting_.dynamics, setting_.steps, substeps)),
        measure_(device, "measure/measure.cl", "-D LANES=1"),
        nothing_(measure_, "nothing_of_seven") {
    for (cl::Buffer<float>& one : nowhere_) one = cl::Buffer<float>(device, 1);
    if (rivals) rivals_ = solver_rivals(setting_.topology, setting_.dynamics);
    processor_.resize(rivals_.size() + 1);
  }

  FrameSample frame() override {
    FrameSample sample;
    const Motions& start = setting_.start;
    enqueue_.push_back(cost_of([&] {
                         auto& [a, b, c, d, e, f, g] = nowhere_;
                         const cl::Event event = nothing_.with(a, b, c, d, e, f, g).enqueue(queue_, 1);
                         queue_.finish();
                       }).wall_ms);
    masses_.set(queue_, start.offset, start.speed, setting_.steps);
    queue_.finish();
    const Cost own = cost_of([&] {
      masses_.enqueue(queue_, substeps_);
      queue_.finish();
    });
    sample.wall_ms = own.wall_ms;
    sample.cpu_ms = own.cpu_ms;
    processor_.back().push_back(own.cpu_ms);
    for (std::size_t i = 0; i < rivals_.size(); ++i) {
      auto& [name, rival] = rivals_[i];
      rival->set(start);
      const Cost theirs = cost_of([&, &one = *rival] { one.advance(moments_, substeps_); });
      sample.phase_wall_ms[name] = theirs.wall_ms;
      sample.phase_cpu_ms[name] = theirs.cpu_ms;
      processor_[i].push_back(theirs.cpu_ms);
      // Baselines whose names end in "-2" use two OpenMP threads. After their work these threads wait in a
      // loop for a short time, which uses CPU time. The pause of 10 ms keeps this CPU time out of the next
      // measurement.
      if (name.ends_with("-2")) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return sample;
  }

  Picture read() override { return {}; }

  std::vector<Check> check(const Picture&) override {
    bounded(queue_, masses_);
    const Kind kind = setting_.topology.kind;
    const double length = double(setting_.topology.length);
    const std::vector<glm::vec3> ours = masses_.offsets(queue_);
    std::vector<Check> checks;
    const auto held = [&](const std::string& against, const std::vector<glm::vec3>& theirs) {
      for (const Check& one : agreement_checks(kind, against, spread(ours, theirs, length)))
        checks.push_back(one);
    };
    if (!setting_.dynamics.solver.implicit || setting_.topology.sticks() <= most_factored)
      held(against_reference, reference_offsets());
    for (const auto& [name, rival] : rivals_) held(name, rival->state().offset);
    if (checks.empty() && substeps_ == 1) checks = step_checks(ours);
    return checks;
  }

  void describe(Row& row) override {
    const SpringNetwork& topology = setting_.topology;
    row.build_ms = masses_.program().build_ms();
    add_programs(row.identity, {&masses_.program()});
    row.provenance["kernel_hash"] = cl::hash_of({&masses_.program()});
    row.metrics["triangles"] = {double(topology.corner.size()), "triangles"};
    row.metrics["sticks"] = {double(topology.sticks()), "sticks"};
    row.metrics["stick_area"] = {topology.stick_area, "R^2"};
    row.metrics["springs"] = {double(topology.spring.size()), "springs"};
    row.metrics["device_bytes"] = {double(masses_.bytes()), "bytes"};
    row.metrics["substeps"] = {double(substeps_), "steps"};
    row.metrics["step_ms"] = {1e3 * double(setting_.dynamics.step), "ms"};
    row.metrics["enqueue_ms"] = {median(enqueue_), "ms"};
    row.metrics["processor_ms"] = {median(processor_.back()), "ms"};
    if (masses_.solves().solves > 0)
      row.metrics["iterations"] = {double(masses_.solves().iterations) / double(masses_.solves().solves),
                                   "iterations"};
    describe_gap(shape_of(topology, masses_.offsets(queue_)), row);
    const std::vector<double>& own = row.samples["frame"].wall_ms;
    for (std::size_t i = 0; i < rivals_.size(); ++i) {
      const std::string& name = rivals_[i].name;
      const std::vector<double>& theirs = row.samples[name].wall_ms;
      std::vector<double> excess;
      for (std::size_t k = 0; k < own.size(); ++k)
        excess.push_back(own[k] - theirs[k] - enqueue_[enqueue_.size() - own.size() + k]);
      row.metrics[name + "_ratio"] = median_ratio(theirs, own);
      row.metrics[name + "_excess_ms"] = median_metric(excess, "ms");
      row.metrics[name + "_processor_ms"] = {median(processor_[i]), "ms"};
      const double shared = median(processor_.back()) / double(cores_);
      if (!name.ends_with("-2"))
        row.metrics[name + "_processor_ratio"] = {median(processor_[i]) / shared, "times"};
      if (rivals_[i].rival->iterations() > 0)
        row.metrics[name + "_iterations"] = {
            double(rivals_[i].rival->iterations()) / double(substeps_) / double(processor_[i].size()),
            "iterations"};
    }
  }

 private:
  reference::State start() const { return reference_state(setting_.topology, setting_.start); }

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
        reference::residual({setting_.topology, setting_.dynamics}, start(), setting_.steps, change);
    return {{against_reference, "residual", left, tolerance::step_residual, false},
            {"own speeds", "worst", spread(offsets, moved, double(setting_.topology.length)).worst,
             tolerance::stick_top, false}};
  }

  std::vector<glm::vec3> reference_offsets() const {
    const SpringNetwork& topology = setting_.topology;
    reference::State state = start();
    const reference::System system{topology, setting_.dynamics};
    for (int i = 0; i < substeps_; ++i) state = reference::step(system, state, setting_.steps + i);
    std::vector<glm::vec3> offsets;
    for (const glm::dvec3& q : reference::offsets(topology, state)) offsets.emplace_back(q);
    return offsets;
  }

  cl::Queue queue_;
  Setting setting_;
  int substeps_;
  unsigned cores_;
  MassSprings masses_;
  std::vector<Moment> moments_;
  cl::Program measure_;
  cl::Kernel nothing_;
  std::array<cl::Buffer<float>, 7> nowhere_;
  std::vector<double> enqueue_;  // wall times in ms of launches of an empty kernel, warm-up included
  std::vector<NamedRival> rivals_;
  // CPU times in ms: one list per baseline, followed by one list for the device.
  std::vector<std::vector<double>> processor_;
};

}  // namespace

std::unique_ptr<Subject> solver_duel(const cl::Device& device, Setting setting, int substeps, bool rivals) {
  return std::make_unique<Duel>(device, std::move(setting), substeps, rivals);
}

}  // namespace pelage::springs
