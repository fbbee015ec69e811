#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/animation/animation.hpp"
#include "harness/error.hpp"
#include "harness/scene/keyframes.hpp"

namespace pelage {
namespace {

/// Greatest value of dynamics.time, s.
constexpr double most_seconds = most_keyframe_time;

std::optional<double> last_keyframe(const Scene& scene) {
  std::optional<double> last;
  for (const KeyTrack& track : scene.keyframes.tracks)
    if (track.key != "dynamics.time" && !track.frames.empty())
      last = std::max(last.value_or(0), track.frames.back().time);
  return last;
}

void require_time(const char* option, double seconds) {
  if (!(seconds >= 0 && seconds <= most_seconds))
    throw InputError(
        fmt::format("{} {}: give a time of 0 to {} s", option, seconds, static_cast<int>(most_seconds)));
}

/// Returns the number of frames from options.from to the time `to`.
double count_until(const TimeOptions& options, double to) {
  // The product of a duration and a rate may be slightly below the whole number that the user means, as in
  // 0.29 * 100. A frame that passes `to` by less than a thousandth of a frame therefore counts.
  return std::floor((to - options.from) * options.fps + 1e-3) + 1;
}

double count_of(const TimeOptions& options, const Scene& scene) {
  if (options.to && options.frames) throw InputError("give --to or --frames, but not both");
  if (options.frames) return *options.frames;
  const std::optional<double> last = options.to ? options.to : last_keyframe(scene);
  if (!last)
    throw InputError(
        "the scene has no keyframes that say when the animation ends; give the time of the last frame with --to SECONDS, or the number of frames with --frames N");
  if (options.to) require_time("--to", *last);
  if (*last < options.from)
    throw InputError(fmt::format("--from {}: the first frame is after the last one, which is at {} s{}",
                                 options.from, *last, options.to ? "" : ", the time of the last keyframe"));
  return count_until(options, *last);
}

}  // namespace

FrameTimes frame_times(const TimeOptions& options, const Scene& scene) {
  if (!(options.fps > 0 && options.fps <= most_fps))
    throw InputError(fmt::format("--fps {}: give a number above 0 and at most {}", options.fps, most_fps));
  require_time("--from", options.from);
  const double count = count_of(options, scene);
  if (!(count >= 1 && count <= most_frames))
    throw InputError(fmt::format("an animation of {:.0f} frames; it must have 1 to {}", count, most_frames));
  const FrameTimes times{options.fps, options.from, static_cast<int>(count)};
  const double last = options.from + (times.count - 1) / options.fps;
  if (last > most_seconds + 1e-3 / options.fps)
    throw InputError(fmt::format("--frames {}: the last frame is at {} s; its time must be at most {} s",
                                 times.count, last, static_cast<int>(most_seconds)));
  return times;
}

void check_frames(const Scene& scene, const FrameTimes& times) {
  const ImageScene first = picture_scene(scene, times.at(0)).image;
  for (int frame = 1; frame < times.count; ++frame) {
    const float seconds = times.at(frame);
    const ImageScene image = picture_scene(scene, seconds).image;
    if (image.width != first.width || image.height != first.height)
      throw InputError(fmt::format(
          "image.width, image.height: the frame at {} s has {}x{} pixels and the first frame {}x{}; all frames must have one size, so remove the keyframes or give --size",
          seconds, image.width, image.height, first.width, first.height));
  }
  if (!forces_change(scene)) return;
  const Scene last = picture_scene(scene, times.at(times.count - 1));
  for (int i = 0; i <= frames_before(last.dynamics); ++i) dynamics_of_frame(last, i);
}

}  // namespace pelage
