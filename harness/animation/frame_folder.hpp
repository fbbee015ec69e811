// The folder of an animation: one PNG file per frame, and the file animation.txt, which records from what the
// frames were drawn and the hash of every complete frame.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/picture/picture.hpp"

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

}  // namespace pelage
