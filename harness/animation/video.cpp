#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "harness/animation/animation.hpp"
#include "harness/atomic_file.hpp"
#include "harness/error.hpp"
#include "harness/isolated/isolated.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

constexpr double most_gif_fps = 50;

/// Runs ffmpeg in the folder of the frames. `filter` processes the frames, and `how` are further options of
/// the output.
void join(const fs::path& file, const fs::path& folder, double fps, int count, const std::string& filter,
          const std::vector<std::string>& how) {
  write_atomically(file, [&](const fs::path& temporary) {
    // ffmpeg runs in the folder, because a path before the pattern could contain a character "%".
    std::vector<std::string> words{"ffmpeg", "-v", "error", "-nostdin", "-y"};
    words.insert(words.end(), {"-framerate", fmt::format("{}", fps), "-start_number", "0"});
    words.insert(words.end(), {"-i", frame_pattern});
    // The folder may contain further frames of an earlier, longer run.
    words.insert(words.end(), {"-vf", fmt::format("trim=end_frame={},{}", count, filter)});
    words.insert(words.end(), how.begin(), how.end());
    words.push_back(fs::absolute(temporary).string());
    const ProgramOutcome outcome = run_program(words, folder);
    if (outcome.code != 0 || !fs::exists(temporary))
      throw std::runtime_error(fmt::format("{}: ffmpeg failed with the exit code {}: {}", file.string(),
                                           outcome.code, last_line(outcome.messages)));
  });
}

}  // namespace

void check_video(const std::string& option, const fs::path& file, const fs::path& frames) {
  const auto folder_of = [](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path)).parent_path();
  };
  if (folder_of(file) != folder_of(frames / file.filename())) require_place(file);
  if (!on_path("ffmpeg"))
    throw InputError(fmt::format(
        "{} {}: needs the program ffmpeg, which is not installed (Debian package: ffmpeg); frames need no ffmpeg",
        option, file.string()));
}

void write_gif(const fs::path& file, const fs::path& folder, double fps, int count) {
  const std::string fewer = fps > most_gif_fps ? fmt::format("fps={},", most_gif_fps) : "";
  join(file, folder, fps, count, fewer + "split[a][b];[a]palettegen[p];[b][p]paletteuse", {"-f", "gif"});
}

void write_mp4(const fs::path& file, const fs::path& folder, double fps, int count) {
  join(file, folder, fps, count, "pad=ceil(iw/2)*2:ceil(ih/2)*2", {"-pix_fmt", "yuv420p", "-f", "mp4"});
}

}  // namespace pelage
