#include "harness/subjects/in_turns.hpp"

#include <fmt/format.h>

#include "harness/compare/checks.hpp"
#include "harness/compare/metrics.hpp"
#include "harness/error.hpp"
#include "harness/measure/turns.hpp"

namespace pelage {
namespace {

std::vector<Check> same_picture(const Turn& other, const Picture& timed) {
  return other_filter_checks(other.name, compare(timed, other.subject->read()));
}

void describe_opengl(const Turn& other, Row& row) {
  Row theirs;
  other.subject->describe(theirs);
  row.metrics[other.name + "_build_ms"] = {theirs.build_ms, "ms"};
  for (const auto& [key, value] : theirs.provenance.items())
    if (!row.provenance.contains(key)) row.provenance[key] = value;
  row.identity.insert(theirs.identity.begin(), theirs.identity.end());
}

}  // namespace

std::unique_ptr<Subject> against_control_scene(const MakeSubject& make, const Experiment& experiment,
                                               const Case& which) {
  struct Likeness {
    double psnr = 0, ssim = 0;
  };
  const auto likeness = std::make_shared<Likeness>();
  TurnRules rules;
  rules.check = [likeness](const Turn& other, const Picture& timed) {
    const Picture plain = other.subject->read();
    if (!plain.pixel.empty()) *likeness = {compare(plain, timed).psnr, ssim(plain, timed)};
    return own_checks(other, timed);
  };
  rules.describe = [likeness](const Turn&, Row& row) {
    if (likeness->psnr == 0) return;  // the subject draws no picture
    row.metrics["baseline_psnr"] = {likeness->psnr, "dB"};
    row.metrics["baseline_ssim"] = {likeness->ssim, ""};
  };
  rules.frame_over = true;
  std::vector<Turn> others;
  others.push_back({"baseline", make(control_case(experiment, which))});
  return std::make_unique<Turns>(make(which), std::move(others), std::move(rules));
}

std::unique_ptr<Subject> fewer_layers(const MakeSubject& make, const Case& which, int layers) {
  if (layers < 4 || layers % 4 != 0)
    throw InputError(fmt::format(
        "{}: fur.layers is {}; give a multiple of 4, because {} also draws pictures with half and with a quarter of the layers",
        which.name, layers, which.pipeline));
  const auto with = [&](int number) {
    Case fewer = which;
    fewer.set.emplace_back("fur.layers", std::to_string(number));
    return make(fewer);
  };
  std::vector<Turn> others;
  others.push_back({"half", with(layers / 2)});
  others.push_back({"quarter", with(layers / 4)});
  return std::make_unique<Turns>(with(layers), std::move(others),
                                 TurnRules{.check = own_checks, .frame_over = true});
}

std::unique_ptr<Subject> with_opengl(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> theirs) {
  std::vector<Turn> others;
  others.push_back({"opengl", std::move(theirs)});
  return std::make_unique<Turns>(std::move(ours), std::move(others),
                                 TurnRules{.check = same_picture, .describe = describe_opengl});
}

}  // namespace pelage
