// A timed picture against the double-precision reference, in windows of it.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/compare/check.hpp"
#include "harness/compare/metrics.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Windows of the check: at least this many, each side x side pixels, over fur.
inline constexpr std::size_t kCheckWindows = 64;
inline constexpr int kCheckSide = 16;

/// The timed picture compared with the double-precision reference in kCheckWindows seeded windows over fur
/// pixels; where these fall short, in the whole picture, which decides.
struct WindowCheck {
  std::vector<Check> checks;
  Agreement agreement;  ///< what decided
  Agreement sample;     ///< in the windows
  Check windows;        ///< the first of `checks`: that there were enough windows
};
/// `sticks`: those of the timed frame, where a topology moves the fur.
WindowCheck check_against_reference(const FrameInput& input, int frames, const Picture& timed,
                                    std::uint32_t seed, const std::vector<glm::vec3>& sticks = {});

}  // namespace pelage
