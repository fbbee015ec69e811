#include "harness/springs/studies/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/masses.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/springs/baselines/arrays.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/springs/reference/reference.hpp"

namespace pelage::springs {
namespace {

Motions rest(const SpringNetwork& topology) {
  Motions state;
  for (const glm::vec3& n : topology.normal) state.offset.push_back(topology.length * n);
  state.speed.assign(topology.sticks(), glm::vec3(0));
  return state;
}

// Simulates `seconds` of motion in launches that cover 1/60 s each. After each launch, calls `after` with the
// simulated time in seconds.
void simulate(const cl::Queue& queue, MassSprings& masses, const Dynamics& dynamics, double seconds,
              const std::function<void(double)>& after = {}) {
  const long steps = std::max(1L, std::lround(seconds / double(dynamics.step)));
  const int launch = int(std::clamp(std::lround(1.0 / 60 / double(dynamics.step)), 1L, 20000L));
  for (long done = 0; done < steps;) {
    const int count = int(std::min<long>(launch, steps - done));
    masses.enqueue(queue, count);
    done += count;
    if (after) after(double(done) * double(dynamics.step));
  }
  queue.finish();
}

// Base class of the studies. Each call of frame() makes one whole measurement.
class Study : public Subject {
 public:
  Study(const cl::Device& device, Setting setting) : queue_(device), setting_(std::move(setting)) {}
  Picture read() override { return {}; }
  void describe(Row& row) override {
    row.metrics["triangles"] = {double(setting_.topology.corner.size()), "triangles"};
    row.metrics["sticks"] = {double(setting_.topology.sticks()), "sticks"};
    row.metrics["step_ms"] = {1e3 * double(setting_.dynamics.step), "ms"};
    row.identity.insert(programs_.begin(), programs_.end());
  }

 protected:
  double second(MassSprings& masses) const {
    const auto from = std::chrono::steady_clock::now();
    simulate(queue_, masses, setting_.dynamics, 1);
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count();
  }
  cl::Queue queue_;
  Setting setting_;
  Identity programs_;  // the parts of the programs that ran; the studies add them with add_programs()
};

class ErrorStudy : public Study {
 public:
  ErrorStudy(const cl::Device& device, Setting setting, const Motions& exact)
      : Study(device, std::move(setting)),
        exact_(exact),
        masses_(queue_, setting_.topology, setting_.dynamics) {
    add_programs(programs_, {&masses_.program()});
  }
  FrameSample frame() override {
    const Motions start = rest(setting_.topology);
    masses_.set(queue_, start.offset, start.speed);
    FrameSample sample;
    sample.wall_ms = second(masses_);
    return sample;
  }
  std::vector<Check> check(const Picture&) override {
    try {
      masses_.check(queue_);
    } catch (const Diverged& error) {
      throw OutOfBounds(error.what());
    }
    error_ = spread(masses_.offsets(queue_), exact_.offset, double(setting_.topology.length));
    return {{"exact", "rms", error_.rms, tolerance::lost_run, false}};
  }
  void describe(Row& row) override {
    Study::describe(row);
    row.metrics["error_rms"] = {error_.rms, "of the length"};
    row.metrics["error_p99"] = {error_.percentile_99, "of the length"};
    row.metrics["error_worst"] = {error_.worst, "of the length"};
  }

 private:
  Motions exact_;
  MassSprings masses_;
  Spread error_;
};

class LimitStudy : public Study {
 public:
  using Study::Study;
  FrameSample frame() override {
    if (longest_ > 0) return {.wall_ms = taken_};
    double low = 1e-5, high = 1;  // s
    if (!stable(low)) throw OutOfBounds("the masses diverge within two seconds even with dt = 1e-5 s");
    if (stable(high)) low = high;
    while (high / low > 1.02) {
      const double middle = std::sqrt(low * high);
      (stable(middle) ? low : high) = middle;
    }
    longest_ = low;
    setting_.dynamics.step = float(low);
    MassSprings masses(queue_, setting_.topology, setting_.dynamics);
    add_programs(programs_, {&masses.program()});
    taken_ = second(masses);
    return {.wall_ms = taken_};
  }
  std::vector<Check> check(const Picture&) override {
    return {{"two seconds", "steps tried", double(tried_), 2, true}};
  }
  void describe(Row& row) override {
    Study::describe(row);
    row.metrics["longest_step_ms"] = {1e3 * longest_, "ms"};
  }

 private:
  bool stable(double step) {
    ++tried_;
    Dynamics dynamics = setting_.dynamics;
    dynamics.step = float(step);
    MassSprings masses(queue_, setting_.topology, dynamics);
    const double most = 2 * double(setting_.topology.length);
    try {
      for (int half = 0; half < 4; ++half) {
        simulate(queue_, masses, dynamics, 0.5);
        masses.check(queue_);
        for (const glm::vec3& q : masses.offsets(queue_))
          if (!(double(glm::length(q)) < most)) return false;
      }
    } catch (const Diverged&) {
      return false;
    }
    return true;
  }
  double longest_ = 0, taken_ = 0;
  int tried_ = 0;
};

class EnergyStudy : public Study {
 public:
  EnergyStudy(const cl::Device& device, Setting setting) : Study(device, std::move(setting)) {}
  FrameSample frame() override {
    MassSprings masses(queue_, setting_.topology, setting_.dynamics);
    add_programs(programs_, {&masses.program()});
    energy_.clear();
    const auto from = std::chrono::steady_clock::now();
    double next = 0;
    simulate(queue_, masses, setting_.dynamics, 4, [&](double time) {
      if (time + 1e-9 < next) return;
      try {
        masses.check(queue_);
      } catch (const Diverged& error) {
        throw OutOfBounds(error.what());
      }
      energy_[fmt::format("{:.3f}", time)] = 1e6 * energy(masses);
      next = time + 0.05;
    });
    return {.wall_ms =
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count()};
  }
  std::vector<Check> check(const Picture&) override {
    return {{"four seconds", "times", double(energy_.size()), 40, true}};
  }
  void describe(Row& row) override {
    Study::describe(row);
    for (const auto& [time, value] : energy_) row.metrics["energy_uJ_at_" + time] = {value, "uJ"};
  }

 private:
  double energy(const MassSprings& masses) const {
    const SpringNetwork& topology = setting_.topology;
    const auto offsets = masses.offsets(queue_), speeds = masses.speeds(queue_);
    reference::State state = reference::rest(topology);
    for (std::size_t i = 0; i < topology.sticks(); ++i) {
      state.position[topology.top(i)] = state.position[i] + glm::dvec3(offsets[i]);
      state.velocity[topology.top(i)] = glm::dvec3(speeds[i]);
    }
    return reference::energy({topology, setting_.dynamics}, state);
  }
  std::map<std::string, double> energy_;
};

}  // namespace

Motions exact_second(const SpringNetwork& topology, const Dynamics& dynamics, float step) {
  Dynamics fine = dynamics;
  fine.solver = highest_order;
  fine.step = step;
  const long steps = std::lround(1 / double(step));
  const auto run = serial_in_double(topology, fine);
  run->set(rest(topology));
  for (long done = 0; done < steps; done += 1000) {
    const int count = int(std::min(1000L, steps - done));
    run->advance(moments(fine, done, count), count);
  }
  return run->state();
}

std::unique_ptr<Subject> solver_error(const cl::Device& device, Setting setting, const Motions& exact) {
  return std::make_unique<ErrorStudy>(device, std::move(setting), exact);
}
std::unique_ptr<Subject> solver_limit(const cl::Device& device, Setting setting) {
  return std::make_unique<LimitStudy>(device, std::move(setting));
}
std::unique_ptr<Subject> solver_energy(const cl::Device& device, Setting setting) {
  return std::make_unique<EnergyStudy>(device, std::move(setting));
}

namespace {

Scene scene_with_springs(const SubjectContext& context, const Case& which) {
  Scene scene = scene_of(context.experiment, which);
  if (!has_springs(scene.dynamics))
    throw InputError(
        fmt::format("{}: dynamics.topology is {}; this experiment needs sticks, prisms, separable-sticks or "
                    "separable-prisms",
                    which.name, scene.dynamics.topology));
  return scene;
}

// Returns the scene's system without an initial state.
Setting setting_of(SubjectContext& context, const Scene& scene) {
  const auto mesh = context.mesh_of(scene);
  return {
      build(kind_of(scene.dynamics.topology), *mesh, scene.fur.length), dynamics_of(scene.dynamics), {}, 0};
}

std::unique_ptr<Subject> solver_after_start(SubjectContext& context, const Case& which, bool baselines) {
  const Scene scene = scene_with_springs(context, which);
  Setting setting = setting_of(context, scene);
  setting.start = rest(setting.topology);
  if (scene.dynamics.time > 0) {
    const cl::Queue queue(context.device);
    MassSprings before(queue, setting.topology, setting.dynamics);
    simulate(queue, before, setting.dynamics, double(scene.dynamics.time));
    setting.start = {before.offsets(queue), before.speeds(queue)};
    setting.steps = before.steps();
  }
  return solver_duel(context.device, std::move(setting), scene.dynamics.substeps, baselines);
}

}  // namespace

std::unique_ptr<Subject> make_solver(SubjectContext& context, const Case& which) {
  return solver_after_start(context, which, false);
}
std::unique_ptr<Subject> make_solver_against_baselines(SubjectContext& context, const Case& which) {
  return solver_after_start(context, which, true);
}
std::unique_ptr<Subject> make_solver_limit(SubjectContext& context, const Case& which) {
  return solver_limit(context.device, setting_of(context, scene_with_springs(context, which)));
}
std::unique_ptr<Subject> make_solver_energy(SubjectContext& context, const Case& which) {
  return solver_energy(context.device, setting_of(context, scene_with_springs(context, which)));
}
std::unique_ptr<Subject> make_solver_error(SubjectContext& context, const Case& which) {
  const Scene scene = scene_with_springs(context, which);
  Setting setting = setting_of(context, scene);
  Scene any = scene;  // the exact solution does not depend on time step and solver
  any.dynamics.step = 1;
  any.dynamics.substeps = 1;
  any.dynamics.solver = highest_order.name;
  std::any& exact = context.shared["exact second of " + scene_hash(any)];
  if (!exact.has_value()) exact = exact_second(setting.topology, setting.dynamics, 1e-4f);
  return solver_error(context.device, std::move(setting), std::any_cast<const Motions&>(exact));
}

}  // namespace pelage::springs
