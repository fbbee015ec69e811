#include "harness/compare/windows.hpp"

#include <fmt/format.h>

#include "harness/compare/checks.hpp"
#include "harness/shells/reference/reference.hpp"

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
