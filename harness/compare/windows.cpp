#include "harness/compare/windows.hpp"

#include "harness/compare/pictures.hpp"
#include "harness/shells/reference/reference.hpp"

namespace pelage {

WindowCheck check_against_reference(const FrameInput& input, int frames, const Picture& timed,
                                    std::uint32_t seed, const std::vector<glm::vec3>& sticks) {
  reference::Options options;
  options.frames = frames;
  options.sticks.assign(sticks.begin(), sticks.end());
  options.windows = fur_windows(timed, kCheckWindows, kCheckSide, seed);
  const Check windows{against_reference, "windows", double(options.windows.size()), double(kCheckWindows),
                      true};
  if (options.windows.empty()) return {{windows}, {}, {}, windows};
  const Agreement sample = compare(timed, reference::render(input, options), options.windows);
  // In a flipped pixel, another texel of the mask was selected because of rounding. The other texel changes a
  // channel by about 0.2. One flipped pixel lowers the PSNR of 64 windows below tolerance::picture_psnr, but
  // not the PSNR of the whole picture. Therefore, if the windows fail, the comparison of the whole picture
  // decides.
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
