#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "harness/animation/animation.hpp"
#include "harness/error.hpp"
#include "harness/file_hash.hpp"
#include "harness/picture/image_io.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view title = "pelage animation 1", list_of_frames = "frames:";

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw InputError(fmt::format("{}: {}", path.string(), what));
}

/// Returns the names of all files in the folder that begin with `start` and end with ".png".
std::vector<std::string> pictures(const fs::path& folder, std::string_view start) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with(start) && name.ends_with(".png")) names.push_back(name);
  }
  if (error) refuse(folder, "cannot be read: " + error.message());
  return names;
}

bool has_frames(const fs::path& folder) {
  return !pictures(folder, "frame-").empty();
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Returns the text that precedes the list of frames in animation.txt.
std::string head_of(const FrameOrigin& origin) {
  std::string text = fmt::format("{}\n", title);
  for (const auto& [name, value] : origin) text += fmt::format("{}: {}\n", name, value);
  return text + fmt::format("{}\n", list_of_frames);
}

/// Throws InputError with the first difference between the heads of two files.
void refuse_other_origin(const fs::path& file, const std::string& was, const std::string& now) {
  std::istringstream old_lines(was), new_lines(now);
  std::string before, after;
  while (std::getline(new_lines, after) && std::getline(old_lines, before))
    if (before != after)
      refuse(
          file,
          fmt::format(
              "the frames were drawn with \"{}\", which is now \"{}\"; give the options of the first run, or another folder with -o",
              before, after));
  refuse(file, "is damaged; remove this file and the frames, or give another folder with -o");
}

}  // namespace

std::string frame_name(int frame) {
  return fmt::format("frame-{:05}.png", frame);
}

void check_frame_folder(const fs::path& folder, bool resume) {
  if (folder.empty()) throw InputError("the name of the folder for the frames is empty; give it with -o");
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) return;
  if (!fs::is_directory(folder, ignored)) refuse(folder, "is not a folder; give a folder with -o");
  const bool frames = has_frames(folder), recorded = fs::exists(folder / frame_record, ignored);
  if (!resume && (frames || recorded))
    refuse(folder, "already contains frames: continue with --resume, or give another folder with -o");
  if (frames && !recorded)
    refuse(folder,
           fmt::format("contains frames, but no {}, so they cannot be continued; give another folder with -o",
                       frame_record));
}

FrameFolder::FrameFolder(fs::path folder, const FrameOrigin& origin, bool resume)
    : folder_(std::move(folder)), file_(folder_ / frame_record) {
  check_frame_folder(folder_, resume);
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) refuse(folder_, "cannot be created: " + error.message());
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) refuse(file_, fmt::format("cannot be written: {}", std::strerror(errno)));
  try {
    lock();
    // Files of this kind are left by a process that was killed while it wrote (write_atomically()).
    for (const std::string& name : pictures(folder_, ".frame-")) fs::remove(folder_ / name, error);
    read(origin);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

FrameFolder::~FrameFolder() {
  ::close(descriptor_);
}

void FrameFolder::lock() {
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
    refuse(folder_, "another pelage process draws to this folder; wait, or give another folder with -o");
}

void FrameFolder::read(const FrameOrigin& origin) {
  const std::string head = head_of(origin), text = text_of(file_);
  const std::size_t list = text.find(fmt::format("\n{}\n", list_of_frames));
  if (list == std::string::npos) {
    // A process was killed before it had written the head.
    if (has_frames(folder_)) refuse_other_origin(file_, text, head);
    if (::ftruncate(descriptor_, 0) != 0) refuse(file_, "cannot be written");
    append(head);
    return;
  }
  const std::size_t start = list + list_of_frames.size() + 2;
  if (text.substr(0, start) != head) refuse_other_origin(file_, text.substr(0, start), head);
  // A process may have been killed while it wrote the last line.
  const std::size_t complete = text.rfind('\n') + 1;
  if (::ftruncate(descriptor_, off_t(complete)) != 0) refuse(file_, "cannot be written");
  std::istringstream lines(text.substr(start, complete - start));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t space = std::min(line.find(' '), line.size());
    const char* const end = line.data() + space;
    int frame = -1;
    if (std::from_chars(line.data(), end, frame).ptr != end || frame < 0 || space == line.size())
      refuse(file_, fmt::format("is damaged: \"{}\" is not the number of a frame and its hash", line));
    frames_[frame] = line.substr(space + 1);
  }
}

void FrameFolder::append(const std::string& text) {
  if (::write(descriptor_, text.data(), text.size()) != ssize_t(text.size()))
    refuse(file_, fmt::format("cannot be written: {}", std::strerror(errno)));
}

bool FrameFolder::holds(int frame) const {
  const auto recorded = frames_.find(frame);
  return recorded != frames_.end() && recorded->second == hash_of_file(folder_ / frame_name(frame));
}

void FrameFolder::write(int frame, const Picture& picture) {
  const fs::path file = folder_ / frame_name(frame);
  write_picture(file, picture);
  const std::string hash = hash_of_file(file);
  // Drawn again, a frame that was removed or damaged has its former content.
  if (std::string& recorded = frames_[frame]; recorded != hash) {
    recorded = hash;
    append(fmt::format("{} {}\n", frame, hash));
  }
}

}  // namespace pelage
