#include "harness/record/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "harness/error.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, std::string_view what, int code) {
  throw InputError(fmt::format("{}: {}: {}", file.string(), what, std::strerror(code)));
}

/// Creates `folder` and its missing parents. Syncs the parent of each folder that it creates.
void make_folder(const fs::path& folder) {
  if (folder.empty() || fs::is_directory(folder)) return;
  const fs::path parent = folder.parent_path();
  make_folder(parent);
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) fail(folder, "cannot create the folder", error.value());
  sync(parent.empty() ? fs::path(".") : parent);
}

struct Contents {
  JournalContents journal;
  std::set<std::string> keys;
  std::size_t good = 0;  ///< number of bytes up to and including the last line feed
};

Contents parse(const fs::path& file, std::string_view text) {
  Contents result;
  std::vector<Row> all;
  std::map<std::string, std::size_t> last;  // key -> index of the last row with this key
  int line_number = 0;
  while (true) {
    const std::size_t end = text.find('\n', result.good);
    if (end == std::string_view::npos) break;
    ++line_number;
    std::string_view line = text.substr(result.good, end - result.good);
    if (line.ends_with('\r')) line.remove_suffix(1);  // git writes it where core.autocrlf is set
    try {
      all.push_back(row_from_line(line));
    } catch (const NewerSchema& error) {
      throw InputError(fmt::format("{}:{}: {}", file.string(), line_number, error.what()));
    } catch (const InputError& error) {
      throw InputError(fmt::format(
          "{}:{}: damaged: {}; restore this line from a copy, or delete it, and --resume runs its case again",
          file.string(), line_number, error.what()));
    }
    const std::string key = row_key(all.back());
    if (result.keys.contains(key))
      throw InputError(
          fmt::format("{}:{}: damaged: second row with the key {}", file.string(), line_number, key));
    if (all.back().status != Status::error) result.keys.insert(key);
    last[key] = all.size() - 1;
    result.good = end + 1;
  }
  result.journal.torn = text.size() - result.good;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool valid = last.at(row_key(all[i])) == i;
    (valid ? result.journal.rows : result.journal.replaced).push_back(std::move(all[i]));
  }
  return result;
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, "cannot be read", errno);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) fail(file, "cannot be read", errno);
  return text;
}

}  // namespace

void sync(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, "cannot be synced", errno);
  const bool synced = ::fsync(descriptor) == 0 || errno == EINVAL;  // some file systems sync no folders
  const int code = errno;
  ::close(descriptor);
  if (!synced) fail(path, "cannot be synced", code);
}

JournalCalls system_calls() {
  return {::write, ::fdatasync, ::ftruncate};
}

Journal::Journal(const fs::path& file, Mode mode, JournalCalls calls) : file_(file), calls_(calls) {
  make_folder(file.parent_path());
  descriptor_ = ::open(file.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail(file, "cannot be opened for writing", errno);
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK)
        throw InputError(fmt::format(
            "{}: another pelage process is writing this file; wait, or give another folder with -o",
            file.string()));
      fail(file, "cannot be locked", errno);
    }
    // A process that was killed may have created the file without this sync.
    sync(file.parent_path().empty() ? fs::path(".") : file.parent_path());
    Contents contents = parse(file, read_text(file));
    if (contents.journal.torn > 0) {
      if (mode == Mode::fresh)
        throw InputError(fmt::format("{}: the last row is truncated; continue with --resume", file.string()));
      if (calls_.ftruncate(descriptor_, off_t(contents.good)) != 0 || calls_.fdatasync(descriptor_) != 0)
        fail(file, "cannot remove the truncated last row", errno);
    }
    rows_ = std::move(contents.journal.rows);
    keys_ = std::move(contents.keys);
    dropped_ = contents.journal.torn;
    good_length_ = off_t(contents.good);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Journal::~Journal() {
  ::close(descriptor_);
}

void Journal::append(const Row& row) {
  if (broken_)
    throw InputError(
        fmt::format("{}: an earlier write failed, so pelage writes no more rows", file_.string()));
  const std::string key = row_key(row);
  if (keys_.contains(key))
    throw InputError(fmt::format("{}: already contains the row {}", file_.string(), key));
  const std::string line = to_line(row) + "\n";
  write_all(line);
  if (calls_.fdatasync(descriptor_) != 0) {
    // After a failed sync the operating system may have discarded the unwritten pages. A second sync could
    // then succeed without writing them, so the journal does not retry.
    broken_ = true;
    fail(file_, "cannot be synced to the disk", errno);
  }
  good_length_ += off_t(line.size());
  if (row.status != Status::error) keys_.insert(key);
}

void Journal::write_all(const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = calls_.write(descriptor_, text.data() + done, text.size() - done);
    if (count > 0) {
      done += std::size_t(count);
    } else if (count == 0 || errno != EINTR) {
      const int code = count < 0 ? errno : ENOSPC;
      broken_ = true;
      calls_.ftruncate(descriptor_, good_length_);
      calls_.fdatasync(descriptor_);
      fail(file_, "the row cannot be written", code);
    }
  }
}

JournalContents read_contents(const fs::path& file) {
  return parse(file, read_text(file)).journal;
}

}  // namespace pelage
