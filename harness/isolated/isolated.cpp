#include "harness/isolated/isolated.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>
#include <optional>
#include <sstream>
#include <thread>
#include <utility>

#include "harness/error.hpp"

namespace pelage {
namespace {

#if defined(__SANITIZE_ADDRESS__)
// With AddressSanitizer, the child process has no memory limit and keeps stderr, because AddressSanitizer
// reserves terabytes of address space and writes its reports to stderr. If another thread allocates memory
// during fork(), GCC 12's AddressSanitizer leaves its allocator locked in the child process. The child
// process then waits until limits.time is over. cl::BuildAhead therefore has no running thread at that time,
// and isolated() lets PoCL's threads free the memory of their last launch first.
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

// A message in the pipe consists of its kind, its length and its text.
enum class Kind : char { progress = 'p', result = 'r', input_error = 'i', error = 'e' };

void send(int pipe, Kind kind, const std::string& text) {
  std::string head(1, char(kind));
  const std::uint64_t size = text.size();
  head.append(reinterpret_cast<const char*>(&size), sizeof size);
  for (const std::string* part : {&std::as_const(head), &text}) {
    for (std::size_t done = 0; done < part->size();) {
      const ssize_t written = ::write(pipe, part->data() + done, part->size() - done);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) ::_exit(1);  // the parent process has closed the pipe, so nobody reads the message
      done += std::size_t(written);
    }
  }
}

std::uint64_t address_space() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0;
  file >> pages;
  return pages * std::uint64_t(::sysconf(_SC_PAGESIZE));
}

[[noreturn]] void be_the_child(int pipe, const Limits& limits,
                               const std::function<std::string(const Say&)>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGABRT, SIGBUS})
    std::signal(signal, SIG_DFL);
  const int quiet = ::open("/dev/null", O_WRONLY);
  ::dup2(quiet, STDOUT_FILENO);
  rlimit space_of_user{};
  bool by_user = false;
  if (!sanitized) {
    ::dup2(quiet, STDERR_FILENO);  // hides the output of the libraries; pelage prints its own message
    const rlimit space{address_space() + limits.memory, address_space() + limits.memory};
    // If the user has set a limit below `space` (ulimit -v), this limit stays in force. Without this check,
    // setrlimit() would replace the user's limit by the higher limit `space` if pelage runs as root.
    by_user = ::getrlimit(RLIMIT_AS, &space_of_user) == 0 && space_of_user.rlim_cur < space.rlim_cur;
    if (!by_user) ::setrlimit(RLIMIT_AS, &space);
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
  }
  try {
    send(pipe, Kind::result, work([pipe](const std::string& text) { send(pipe, Kind::progress, text); }));
  } catch (const InputError& error) {
    send(pipe, Kind::input_error, error.what());
  } catch (const std::bad_alloc&) {
    send(pipe, Kind::error,
         by_user ? fmt::format("needs more memory than the limit that the shell sets: {} MiB (ulimit -v)",
                               space_of_user.rlim_cur >> 20)
                 : fmt::format("needs more than {} MiB of memory", limits.memory >> 20));
  } catch (const std::exception& error) {
    send(pipe, Kind::error, error.what());
  }
  ::_exit(0);
}

class Inbox {
 public:
  void add(const char* bytes, std::size_t size) { bytes_.append(bytes, size); }
  // Removes and returns the next complete message; empty if no message is complete.
  std::optional<std::pair<Kind, std::string>> next() {
    std::uint64_t size = 0;
    if (bytes_.size() < 1 + sizeof size) return {};
    std::memcpy(&size, bytes_.data() + 1, sizeof size);
    if (bytes_.size() - 1 - sizeof size < size) return {};
    const Kind kind{bytes_[0]};
    std::string rest = bytes_.substr(1 + sizeof size + size);
    bytes_.resize(1 + sizeof size + size);
    bytes_.erase(0, 1 + sizeof size);
    // A result has up to a gigabyte, so its text is moved and not copied.
    return std::pair(kind, std::exchange(bytes_, std::move(rest)));
  }

 private:
  std::string bytes_;
};

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text.substr(0, 300);
}

namespace fs = std::filesystem;

[[noreturn]] void become(std::vector<std::string>& words, const fs::path& folder, int output) {
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  if (folder.empty() || chdir(folder.c_str()) == 0) execvp(argv[0], argv.data());
  _exit(127);
}

}  // namespace

std::string isolated(const std::string& name, const Limits& limits,
                     const std::function<std::string(const Say&)>& work, const Say& progress) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(fmt::format("pipe: {}", std::strerror(errno)));
  if (sanitized) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(fmt::format("fork: {}", std::strerror(errno)));
  if (child == 0) {
    ::close(ends[0]);
    be_the_child(ends[1], limits, work);
  }
  ::close(ends[1]);
  const auto start = std::chrono::steady_clock::now();
  const auto deadline = start + limits.time;
  auto heard = start;
  Inbox inbox;
  std::optional<std::pair<Kind, std::string>> answer;
  bool late = false;
  std::string chunk(1 << 16, '\0');
  try {
    while (!answer) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
      if ((late = left.count() <= 0)) break;
      pollfd waiting{ends[0], POLLIN, 0};
      const int ready = ::poll(&waiting, 1, int(std::min<std::int64_t>(left.count(), 1000)));
      const auto now = std::chrono::steady_clock::now();
      if (now - heard >= limits.silence) {
        if (progress)
          progress(fmt::format("{}: still at work, {} s", name,
                               std::chrono::duration_cast<std::chrono::seconds>(now - start).count()));
        heard = now;
      }
      if (ready <= 0) continue;
      heard = now;
      const ssize_t got = ::read(ends[0], chunk.data(), chunk.size());
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) break;
      inbox.add(chunk.data(), std::size_t(got));
      while (auto message = inbox.next()) {
        if (message->first == Kind::progress) {
          if (progress) progress(message->second);
        } else {
          answer = std::move(message);
        }
      }
    }
  } catch (...) {
    ::close(ends[0]);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    throw;
  }
  ::close(ends[0]);
  if (!answer) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (late)
    throw InputError(fmt::format("{}: not finished after {} s; give a simpler {}", name, limits.time.count(),
                                 limits.what));
  if (!answer && WIFSIGNALED(status))
    throw InputError(fmt::format("{}: cannot be used; the {} library crashed on it ({})", name, limits.what,
                                 ::strsignal(WTERMSIG(status))));
  if (!answer)
    throw InputError(fmt::format("{}: cannot be used; the {} library ended the process", name, limits.what));
  if (answer->first == Kind::input_error) throw InputError(answer->second);
  if (answer->first == Kind::error)
    throw InputError(fmt::format("{}: cannot be used: {}", name, one_line(answer->second)));
  return answer->second;
}

ProgramOutcome run_program(std::vector<std::string> words, const fs::path& folder) {
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return {-1, "no pipe"};
  const pid_t child = fork();
  if (child == 0) become(words, folder, pipe_ends[1]);
  close(pipe_ends[1]);
  ProgramOutcome outcome;
  std::array<char, 4096> block{};
  for (ssize_t count = 0; (count = read(pipe_ends[0], block.data(), block.size())) != 0;) {
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;
    outcome.messages.append(block.data(), std::size_t(count));
  }
  close(pipe_ends[0]);
  int status = 0;
  while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  outcome.code = child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

bool on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder.empty() ? "." : folder) / name;
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0) return true;
  }
  return false;
}

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace pelage
