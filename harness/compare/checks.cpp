#include "harness/compare/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "harness/compare/tolerances.hpp"
#include "harness/scene/spring_kinds.hpp"
#include "harness/shells/reference/reference.hpp"
#include "harness/springs/reference/reference.hpp"

namespace pelage {
namespace {

Spread spread_of(std::vector<double> errors) {
  double squares = 0;
  for (const double error : errors) squares += error * error;
  std::sort(errors.begin(), errors.end());
  const std::size_t count = errors.size();
  return {std::sqrt(squares / double(count)), errors[count * 99 / 100], errors[count * 999 / 1000],
          errors.back()};
}

}  // namespace

std::vector<Check> picture_checks(const std::string& against, const Agreement& agreement) {
  return {{against, "fur pixels", double(agreement.pixels), 1, true},
          {against, "psnr", agreement.psnr, tolerance::picture_psnr, true},
          {against, "p99.9", agreement.p999, tolerance::flip, false},
          {against, "flips", agreement.flip_share(), tolerance::flip_share, false}};
}

std::vector<Check> other_filter_checks(const std::string& against, const Agreement& agreement) {
  return {{against, "fur pixels", double(agreement.pixels), 1, true},
          {against, "psnr", agreement.psnr, tolerance::other_filter_psnr, true}};
}

std::vector<Check> mapping_checks(const std::string& against, const Picture& ours, const Picture& other) {
  const Agreement agreement = compare(ours, other);
  double covered = 0;
  for (std::size_t i = 0; i < ours.pixel.size(); ++i)
    covered += (ours.pixel[i].w > 0) != (other.pixel[i].w > 0);
  return {{against, "pixels covered in only one picture", covered, 0, false},
          {against, "largest difference", agreement.worst, tolerance::mapping_difference, false}};
}

std::vector<Check> check_mask(const std::vector<glm::vec4>& ours, const std::vector<glm::vec4>& reference) {
  if (ours.size() != reference.size())
    throw std::invalid_argument("check_mask: the masks have different sizes");
  double worst = 0, other = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const glm::vec4 a = ours[i], b = reference[i];
    if ((a.w > 0) != (b.w > 0)) {
      ++other;
      continue;
    }
    for (int c = 0; c < 4; ++c) {
      const double error = std::abs(double(a[c]) - double(b[c]));
      worst = std::isfinite(error) ? std::max(worst, error) : 1e6;
    }
  }
  return {{against_reference, "texels wet in only one mask", other, 0, false},
          {against_reference, "largest texel error", worst, tolerance::mask_texel, false}};
}

Spread tip_errors(double length, const std::vector<glm::vec3>& ours,
                  const std::vector<glm::vec3>& reference) {
  if (ours.size() != reference.size() || ours.empty())
    throw std::invalid_argument("tip_errors(): the two lists of tips have different sizes or are empty");
  std::vector<double> errors(ours.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double error = glm::length(glm::dvec3(ours[i]) - glm::dvec3(reference[i]));
    errors[i] = std::isfinite(error) ? error / length : 1e6;
  }
  return spread_of(std::move(errors));
}

Check check_worst_tip(const Spread& errors) {
  return {against_reference, "largest tip error / L0", errors.worst, tolerance::worst_tip, false};
}

Check check_usual_tip(const Spread& errors) {
  return {against_reference, "99.9th percentile of tip errors / L0", errors.p999, tolerance::usual_tip,
          false};
}

std::vector<Check> check_sticks(const FrameInput& input, int frames, const std::vector<glm::vec3>& offsets) {
  const springs::SomeSticks expected = springs::some_reference_sticks(input, frames, kCheckSticks);
  std::vector<double> error;
  for (std::size_t i = 0; i < expected.stick.size(); ++i) {
    const glm::dvec3 off = glm::dvec3(offsets.at(expected.stick[i])) - expected.offset[i];
    const double share = glm::length(off) / double(input.scene.fur.length);
    error.push_back(std::isfinite(share) ? share : 1e6);
  }
  const Spread found = spread_of(std::move(error));
  if (!springs::kind_of(input.scene.dynamics.topology).shared_edges())
    return {{"double-precision masses", "largest error / L0", found.worst, tolerance::stick_top, false}};
  return {{"double-precision masses", "rms error / L0", found.rms, tolerance::prisms_rms, false},
          {"double-precision masses", "p99 error / L0", found.percentile_99, tolerance::prisms_p99, false}};
}

}  // namespace pelage

namespace pelage::springs {

Spread spread(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b, double length) {
  if (a.size() != b.size() || a.empty())
    throw std::invalid_argument("spread(): the two lists of masses have different sizes or are empty");
  std::vector<double> error;
  error.reserve(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = glm::distance(glm::dvec3(a[i]), glm::dvec3(b[i])) / length;
    error.push_back(d < 1e9 ? d : 1e9);
  }
  return spread_of(std::move(error));
}

std::vector<Check> agreement_checks(Kind kind, const std::string& against, const Spread& found) {
  if (kind.shared_edges())
    return {{against, "rms", found.rms, tolerance::prisms_rms, false},
            {against, "p99", found.percentile_99, tolerance::prisms_p99, false}};
  return {{against, "worst", found.worst, tolerance::stick_top, false}};
}

}  // namespace pelage::springs

namespace pelage {

std::string window_advice() {
  return fmt::format(
      "the picture is too small, or fur covers too few of its pixels: the check compares {} squares of {} x {} pixels that contain fur or are adjacent to fur; give a larger picture (the axis size, or image.width and image.height), or a camera that shows more fur",
      kCheckWindows, kCheckSide, kCheckSide);
}

WindowCheck check_against_reference(const FrameInput& input, int frames, const Picture& timed,
                                    std::uint32_t seed, const std::vector<glm::vec3>& sticks) {
  reference::Options options;
  options.frames = frames;
  options.sticks.assign(sticks.begin(), sticks.end());
  options.windows = fur_windows(timed, kCheckWindows, kCheckSide, seed);
  const Check windows{against_reference, windows_metric, double(options.windows.size()),
                      double(kCheckWindows), true};
  if (options.windows.empty()) return {{windows}, {}, {}, windows};
  const Agreement sample = compare(timed, reference::render(input, options), options.windows);
  // Because of rounding, the device and the reference may read different texels of the wetness mask for a
  // pixel. Such a pixel is called flipped. Channel values range from 0 to 1, and each channel of a flipped
  // pixel differs between the two pictures by about 0.2. One flipped pixel lowers the PSNR over the 64
  // windows below the limit tolerance::picture_psnr, but the PSNR over the whole picture stays above this
  // limit. Therefore, if the comparison of the windows fails, the whole picture is compared, and this
  // comparison decides.
  Agreement all = sample;
  if (!within(sample)) {
    options.windows.clear();
    all = compare(timed, reference::render(input, options));
  }
  std::vector<Check> checks{windows};
  for (Check& check : picture_checks(against_reference, all)) checks.push_back(std::move(check));
  return {checks, all, sample, windows};
}

}  // namespace pelage
