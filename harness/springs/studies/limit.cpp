#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/springs/studies/base.hpp"

namespace pelage::springs {
namespace {

constexpr double least_step = 1e-5, most_step = 1, precision = 1.02;

class Trial {
 public:
  Trial(const cl::Queue& queue, const SpringNetwork& network, const Dynamics& dynamics, double look)
      : queue_(queue), network_(network), dynamics_(dynamics), look_(look) {
    dynamics_.lost_stretch = most_stick;
  }

  bool stable(double step) {
    ++tried_;
    dynamics_.step = float(step);
    MassSprings masses(queue_, network_, dynamics_);
    try {
      simulate(queue_, masses, dynamics_, limit_seconds, look_, [&](double) {
        masses.check(queue_);
        return true;
      });
    } catch (const Diverged&) {
      return false;
    }
    return true;
  }

  // Simulates with the time step `step`. Returns the greatest length that a stick has after any step, in rest
  // lengths.
  double longest(double step) {
    dynamics_.step = float(step);
    MassSprings masses(queue_, network_, dynamics_);
    double most = 0;
    simulate(queue_, masses, dynamics_, limit_seconds, step, [&](double) {
      for (const glm::vec3& q : masses.offsets(queue_)) most = std::max(most, double(glm::length(q)));
      return true;
    });
    return most / double(network_.length);
  }

  int tried() const { return tried_; }

 private:
  const cl::Queue& queue_;
  const SpringNetwork& network_;
  Dynamics dynamics_;
  double look_;
  int tried_ = 0;
};

}  // namespace

Limit longest_step(const cl::Queue& queue, const SpringNetwork& network, const Dynamics& dynamics,
                   double look) {
  Trial trial(queue, network, dynamics, look);
  // The search begins with the longest step, because the computing time increases as the step decreases.
  double low = most_step, high = most_step;
  while (!trial.stable(low)) {
    high = low;
    low /= 4;
    if (low < least_step) return {0, 0, trial.tried()};
  }
  while (high / low > precision) {
    const double middle = std::sqrt(low * high);
    (trial.stable(middle) ? low : high) = middle;
  }
  return {low, trial.longest(low), trial.tried()};
}

namespace {

class LimitStudy : public Study {
 public:
  using Study::Study;
  FrameSample frame() override {
    if (found_.step > 0) return {.wall_ms = taken_};
    found_ = longest_step(queue_, setting_.network, setting_.dynamics);
    if (found_.step == 0)
      throw OutOfBounds(
          "with every time step above 15 us, a stick reaches twice its rest length within two seconds");
    setting_.dynamics.step = float(found_.step);
    MassSprings masses(queue_, setting_.network, setting_.dynamics);
    add_programs(programs_, {&masses.program()});
    taken_ = from_rest(masses).wall_ms;
    return {.wall_ms = taken_};
  }
  std::vector<Check> check(const Picture&) override {
    // If the first step of the search is stable, the search ends: the row then states this step.
    const double fewest = found_.step < most_step ? 2 : 1;
    return {{"two seconds", "steps tried", double(found_.tried), fewest, true},
            {"two seconds", "longest stick", found_.longest, double(most_stick), false}};
  }
  void describe(Row& row) override {
    Study::describe(row);
    row.metrics["longest_step_ms"] = {1e3 * found_.step, "ms"};
    row.metrics["longest_stick"] = {found_.longest, "rest lengths"};
  }

 private:
  Limit found_;
  double taken_ = 0;
};

}  // namespace

std::unique_ptr<Subject> make_solver_limit(SubjectContext& context, const Case& which) {
  return std::make_unique<LimitStudy>(context.device,
                                      setting_of(context, scene_with_springs(context, which)));
}

}  // namespace pelage::springs
