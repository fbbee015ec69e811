// Joins the frames of an animation to a GIF or MP4 file with the program ffmpeg.
#pragma once
#include <filesystem>
#include <string>

namespace pelage {

/// Call this before the frames are drawn: throws InputError if the folder of `file` does not exist, unless it
/// is that of the frames, or if ffmpeg is not installed. `option` is the option that names the file, such as
/// "--gif".
void check_video(const std::string& option, const std::filesystem::path& file,
                 const std::filesystem::path& frames);

/// Writes the frames 0 to count - 1 of `folder` (frame_folder.hpp) as an animated GIF with a palette of its
/// own, completely or not at all. GIF files have at most 50 frames per second, so frames are left out above
/// this rate. Throws std::runtime_error with ffmpeg's message if ffmpeg fails.
void write_gif(const std::filesystem::path& file, const std::filesystem::path& folder, double fps, int count);

/// Writes the frames as an MP4 video. If the width or the height of the frames is odd, a black column or row
/// is added, because the video's colours have half the resolution. Throws like write_gif().
void write_mp4(const std::filesystem::path& file, const std::filesystem::path& folder, double fps, int count);

}  // namespace pelage
