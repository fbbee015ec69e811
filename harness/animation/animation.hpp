// Animations: their folder, the times of their frames, and their GIF and MP4 files. The folder has one PNG
// file per frame, and the file animation.txt, which records from what the frames were drawn and the hash of
// every complete frame.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// What the frames were drawn from: names and values, each one line of text. Two runs with equal origins draw
/// the same frames.
using FrameOrigin = std::vector<std::pair<std::string, std::string>>;

inline constexpr const char* frame_record = "animation.txt";
/// Pattern of the names of frames, as printf() and ffmpeg understand it.
inline constexpr const char* frame_pattern = "frame-%05d.png";

/// Returns the name of the frame with the number `frame`, which counts from 0.
std::string frame_name(int frame);

/// Throws InputError if frames cannot be written to `folder`: if it is no folder, if it contains frames and
/// `resume` is false, or if it contains frames without the file animation.txt.
void check_frame_folder(const std::filesystem::path& folder, bool resume);

class FrameFolder {
 public:
  /// Creates the folder, or opens it to continue an animation, without incomplete files of a killed process.
  /// Throws InputError like check_frame_folder(), if the frames in the folder have another origin, or if
  /// another process writes to the folder.
  FrameFolder(std::filesystem::path folder, const FrameOrigin& origin, bool resume);
  ~FrameFolder();
  FrameFolder(const FrameFolder&) = delete;
  FrameFolder& operator=(const FrameFolder&) = delete;

  /// True if the frame was recorded and its file still has the recorded content.
  bool holds(int frame) const;
  /// Writes the picture (completely or not at all) and then records it. Throws InputError if a file cannot be
  /// written.
  void write(int frame, const Picture& picture);

 private:
  void lock();
  void read(const FrameOrigin& origin);
  void append(const std::string& text);

  std::filesystem::path folder_, file_;
  int descriptor_ = -1;                ///< of animation.txt; locked against other processes
  std::map<int, std::string> frames_;  ///< number and content hash of the recorded frames
};

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

/// Throws InputError if the scene is not valid at the time of a frame or of a simulated frame, or if the
/// frames have different sizes.
void check_frames(const Scene& scene, const FrameTimes& times);

/// Call this before the frames are drawn: throws InputError if the folder of `file` does not exist, unless it
/// is that of the frames, or if ffmpeg is not installed. `option` is the option that names the file, such as
/// "--gif".
void check_video(const std::string& option, const std::filesystem::path& file,
                 const std::filesystem::path& frames);

/// Writes the frames 0 to count - 1 of `folder` as an animated GIF with a palette of its
/// own, completely or not at all. GIF files have at most 50 frames per second, so frames are left out above
/// this rate. Throws std::runtime_error with ffmpeg's message if ffmpeg fails.
void write_gif(const std::filesystem::path& file, const std::filesystem::path& folder, double fps, int count);

/// Writes the frames as an MP4 video. If the width or the height of the frames is odd, a black column or row
/// is added, because the video's colours have half the resolution. Throws like write_gif().
void write_mp4(const std::filesystem::path& file, const std::filesystem::path& folder, double fps, int count);

}  // namespace pelage
