#include "harness/commands/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace pelage {
namespace {

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

}  // namespace

std::string clock_text(double seconds) {
  const auto whole = static_cast<long>(std::max(0.0, seconds) + 0.5);
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

Progress::Progress(std::size_t total) : total_(total), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  clear();
}

void Progress::start(const std::string& name) {
  name_ = name;
  draw();
}

void Progress::note(const std::string& line) {
  clear();
  fmt::print(stderr, "{}\n", line);
  draw();
}

void Progress::finish(const std::string& result) {
  ++done_;
  ++worked_;
  if (terminal_)
    draw();
  else
    fmt::print(stderr, "{}/{} {}: {}\n", done_, total_, name_, result);
}

void Progress::skip(std::size_t pieces) {
  done_ += pieces;
}

void Progress::draw() const {
  if (!terminal_) return;
  constexpr std::size_t cells = 24;
  const std::size_t full = total_ ? cells * done_ / total_ : cells;
  std::string line = fmt::format("[{}{}] {}/{} {}", std::string(full, '#'), std::string(cells - full, '.'),
                                 done_, total_, name_);
  if (worked_ > 0) {
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - from_).count();
    line += fmt::format(" ETA {}", clock_text(spent / double(worked_) * double(total_ - done_)));
  }
  // \r returns only to the start of the last terminal line, so the text must fit in one line.
  line.resize(std::min(line.size(), terminal_width() - 1));
  fmt::print(stderr, "\r\x1b[K{}", line);
  std::fflush(stderr);
}

void Progress::clear() const {
  if (terminal_) fmt::print(stderr, "\r\x1b[K");
}

}  // namespace pelage
