#include "harness/subjects/baseline_scene.hpp"

#include <fmt/format.h>

#include "harness/compare/metrics.hpp"
#include "harness/compare/ssim.hpp"
#include "harness/measure/statistics.hpp"

namespace pelage {
namespace {

constexpr const char* phase = "baseline";

class AgainstBaseline : public Subject {
 public:
  AgainstBaseline(std::unique_ptr<Subject> changed, std::unique_ptr<Subject> baseline)
      : changed_(std::move(changed)), baseline_(std::move(baseline)) {}

  FrameSample frame() override {
    FrameSample sample = changed_->frame();
    const FrameSample theirs = baseline_->frame();
    sample.phase_wall_ms[phase] = theirs.wall_ms;
    if (theirs.cpu_ms) sample.phase_cpu_ms[phase] = *theirs.cpu_ms;
    return sample;
  }
  Picture read() override { return changed_->read(); }
  std::vector<Check> check(const Picture& timed) override {
    std::vector<Check> checks = changed_->check(timed);
    const Picture other = baseline_->read();
    for (Check check : baseline_->check(other)) {
      check.against = fmt::format("{}, {}", check.against, phase);
      checks.push_back(std::move(check));
    }
    psnr_ = compare(other, timed).psnr;
    ssim_ = ssim(other, timed);
    return checks;
  }
  void describe(Row& row) override {
    changed_->describe(row);
    // The peak belongs to a process that contains both scenes.
    row.metrics.erase("peak_memory");
    row.metrics["baseline_ratio"] = median_ratio(row.samples["frame"].wall_ms, row.samples[phase].wall_ms);
    row.metrics["baseline_psnr"] = {psnr_, "dB"};
    row.metrics["baseline_ssim"] = {ssim_, ""};
  }

 private:
  std::unique_ptr<Subject> changed_, baseline_;
  double psnr_ = 0, ssim_ = 0;
};

}  // namespace

std::unique_ptr<Subject> against_baseline_scene(const MakeSubject& make, const Experiment& experiment,
                                                const Case& which) {
  return std::make_unique<AgainstBaseline>(make(which), make(baseline_case(experiment, which)));
}

}  // namespace pelage
