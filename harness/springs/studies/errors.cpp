// Measures the error of a solver: the distance of the top masses from the exact state after one second.
#include <algorithm>
#include <cmath>

#include "harness/compare/checks.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/springs/baselines/arrays.hpp"
#include "harness/springs/studies/base.hpp"

namespace pelage::springs {
namespace {

class ErrorStudy : public Study {
 public:
  ErrorStudy(const cl::Device& device, Setting setting, const Motions& exact)
      : Study(device, std::move(setting)),
        exact_(exact),
        masses_(queue_, setting_.topology, setting_.dynamics) {
    add_programs(programs_, {&masses_.program()});
  }
  FrameSample frame() override {
    const Motions start = rest_motions(setting_.topology);
    masses_.set(queue_, start.offset, start.speed);
    FrameSample sample;
    sample.wall_ms = second(masses_);
    return sample;
  }
  std::vector<Check> check(const Picture&) override {
    bounded(queue_, masses_);
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

}  // namespace

Motions exact_second(const SpringNetwork& topology, const Dynamics& dynamics, float step) {
  Dynamics fine = dynamics;
  fine.solver = highest_order;
  fine.step = step;
  const long steps = std::lround(1 / double(step));
  const auto run = serial_in_double(topology, fine);
  run->set(rest_motions(topology));
  for (long done = 0; done < steps; done += 1000) {
    const int count = int(std::min(1000L, steps - done));
    run->advance(moments(fine, done, count), count);
  }
  return run->state();
}

std::unique_ptr<Subject> solver_error(const cl::Device& device, Setting setting, const Motions& exact) {
  return std::make_unique<ErrorStudy>(device, std::move(setting), exact);
}

}  // namespace pelage::springs
