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
  // One flipped pixel, for which rounding chooses the neighbouring texel of the mask and changes a channel by
  // 0.2, leaves less than tolerance::picture_psnr in 64 windows, but not in a whole picture. So the whole
  // picture decides where the windows fall short.
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
