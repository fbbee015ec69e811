// Checks a timed picture: compares windows (squares of pixels) of this picture with the same windows of the
// double-precision reference's picture.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "harness/compare/metrics.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/record/check.hpp"

namespace pelage {

/// Number of windows required by the check, and the side of a window in pixels. The windows are cells of a
/// grid over the picture. Every window contains fur or is adjacent to a cell that contains fur.
inline constexpr std::size_t kCheckWindows = 64;
inline constexpr int kCheckSide = 16;

/// Value of Check::metric in the check that counts the windows. The number of windows must be at least
/// kCheckWindows.
inline constexpr const char* windows_metric = "windows";

/// Returns the advice that the user gets if the check finds fewer than kCheckWindows windows.
std::string window_advice();

/// Comparison of the timed picture with the double-precision reference in kCheckWindows windows. If the
/// difference in these windows is too large, the whole picture is compared, and only this comparison decides.
struct WindowCheck {
  std::vector<Check> checks;
  Agreement agreement;  ///< the comparison on which `checks` are based: the windows or the whole picture
  Agreement sample;     ///< the comparison of the windows
  Check windows;        ///< the check of the number of windows; checks[0] is the same check
};
/// Compares `timed`, the picture of the pipeline after `frames` frames, with the reference. `seed` selects
/// the windows. For a mass-spring topology, `sticks` contains the offset of each stick's top mass from the
/// stick's base in the timed frame, in R (the mesh radius). For Silva's strands, `sticks` is empty.
WindowCheck check_against_reference(const FrameInput& input, int frames, const Picture& timed,
                                    std::uint32_t seed, const std::vector<glm::vec3>& sticks = {});

}  // namespace pelage
