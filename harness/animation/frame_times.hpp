// The times of the frames of an animation.
#pragma once
#include <optional>

#include "harness/scene/scene.hpp"

namespace pelage {

inline constexpr double most_fps = 1000;
inline constexpr int most_frames = 100'000;

/// The options of `pelage animate` that choose the times.
struct TimeOptions {
  double fps = 24;                 ///< frames per second
  double from = 0;                 ///< time of the first frame, s
  std::optional<double> to = {};   ///< time that the last frame does not pass, s
  std::optional<int> frames = {};  ///< number of frames, instead of `to`
};

/// Frame i shows the scene at the time from + i / fps.
struct FrameTimes {
  double fps = 24, from = 0;
  int count = 0;
  /// Returns the time of a frame in s, rounded to the precision of dynamics.time.
  float at(int frame) const { return static_cast<float>(from + frame / fps); }
};

/// Returns the times that the options choose. Without an end, the last frame is at the time of the scene's
/// last keyframe, apart from keyframes of dynamics.time. Throws InputError if an option is out of range, if
/// both ends are given, or if there is no end.
FrameTimes frame_times(const TimeOptions& options, const Scene& scene);

/// Throws InputError if the scene is not valid at the time of a frame, or if the frames have different sizes.
void check_frames(const Scene& scene, const FrameTimes& times);

}  // namespace pelage
