#include "harness/subjects/baseline_scene.hpp"

#include "harness/compare/metrics.hpp"
#include "harness/measure/turns.hpp"

namespace pelage {

std::unique_ptr<Subject> against_baseline_scene(const MakeSubject& make, const Experiment& experiment,
                                                const Case& which) {
  struct Likeness {
    double psnr = 0, ssim = 0;
  };
  const auto likeness = std::make_shared<Likeness>();
  TurnRules rules;
  rules.check = [likeness](const Turn& other, const Picture& timed) {
    const Picture plain = other.subject->read();
    *likeness = {compare(plain, timed).psnr, ssim(plain, timed)};
    return own_checks(other, timed);
  };
  rules.describe = [likeness](const Turn&, Row& row) {
    row.metrics["baseline_psnr"] = {likeness->psnr, "dB"};
    row.metrics["baseline_ssim"] = {likeness->ssim, ""};
  };
  rules.frame_over = true;
  std::vector<Turn> others;
  others.push_back({"baseline", make(baseline_case(experiment, which))});
  return std::make_unique<Turns>(make(which), std::move(others), std::move(rules));
}

}  // namespace pelage
