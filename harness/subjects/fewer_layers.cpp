#include "harness/subjects/fewer_layers.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "harness/error.hpp"
#include "harness/measure/statistics.hpp"

namespace pelage {
namespace {

class FewerLayers : public Subject {
 public:
  FewerLayers(std::unique_ptr<Subject> all, std::unique_ptr<Subject> half, std::unique_ptr<Subject> quarter)
      : all_(std::move(all)) {
    fewer_.emplace_back("half", std::move(half));
    fewer_.emplace_back("quarter", std::move(quarter));
  }

  FrameSample frame() override {
    FrameSample sample = all_->frame();
    for (const auto& [phase, subject] : fewer_) {
      const FrameSample theirs = subject->frame();
      sample.phase_wall_ms[phase] = theirs.wall_ms;
      if (theirs.cpu_ms) sample.phase_cpu_ms[phase] = *theirs.cpu_ms;
    }
    return sample;
  }
  Picture read() override { return all_->read(); }
  std::vector<Check> check(const Picture& timed) override {
    std::vector<Check> checks = all_->check(timed);
    for (const auto& [phase, subject] : fewer_)
      for (Check check : subject->check(subject->read())) {
        check.against = fmt::format("{}, {}", check.against, phase);
        checks.push_back(std::move(check));
      }
    return checks;
  }
  void describe(Row& row) override {
    all_->describe(row);
    // Removes peak_memory, because it is the peak of a process that contains all three subjects (all, half
    // and a quarter of the layers).
    row.metrics.erase("peak_memory");
    for (const auto& [phase, subject] : fewer_)
      row.metrics[phase + "_ratio"] = median_ratio(row.samples["frame"].wall_ms, row.samples[phase].wall_ms);
  }

 private:
  std::unique_ptr<Subject> all_;
  std::vector<std::pair<std::string, std::unique_ptr<Subject>>> fewer_;
};

}  // namespace

std::unique_ptr<Subject> fewer_layers(const MakeSubject& make, const Case& which, int layers) {
  if (layers < 4 || layers % 4 != 0)
    throw InputError(
        fmt::format("{}: fur.layers is {}; give a multiple of 4, because {} also draws pictures with half "
                    "and with a quarter of the layers",
                    which.name, layers, which.pipeline));
  const auto with = [&](int number) {
    Case fewer = which;
    fewer.set.emplace_back("fur.layers", std::to_string(number));
    return make(fewer);
  };
  return std::make_unique<FewerLayers>(with(layers), with(layers / 2), with(layers / 4));
}

}  // namespace pelage
