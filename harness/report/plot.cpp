#include "harness/report/plot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <vector>

#include "harness/data_folder.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string messages;
};

/// Runs a program without a shell and collects its output.
Outcome run_program(std::vector<std::string> words) {
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return {-1, "no pipe"};
  const pid_t child = fork();
  if (child == 0) {
    dup2(pipe_ends[1], STDOUT_FILENO);
    dup2(pipe_ends[1], STDERR_FILENO);
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  close(pipe_ends[1]);
  Outcome outcome;
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

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

fs::path plot_program(const std::string& name) {
  for (const fs::path& data : data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR))
    // The first folder is that of an installation, and the second folder is that of the source tree.
    for (const char* folder : {"plots", "harness/report/plots"})
      if (const fs::path file = data / folder / (name + ".py"); fs::is_regular_file(file)) return file;
  throw InputError(fmt::format("plots/{}.py is missing; set PELAGE_DATA to pelage's data folder", name));
}

std::string draw_plot(const fs::path& program, const fs::path& table, const fs::path& stem) {
  const std::string python = fs::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
  const Outcome outcome =
      run_program({python, program.string(), table.string(), stem.string() + ".svg", stem.string() + ".pdf"});
  if (outcome.code == 0) return {};
  if (outcome.code == 127) return "no plots: python3 is not installed";
  if (outcome.messages.find("No module named 'matplotlib'") != std::string::npos)
    return "no plots: matplotlib is not installed (Debian: python3-matplotlib)";
  return fmt::format("no plots: {}: {}", program.filename().string(), last_line(outcome.messages));
}

}  // namespace pelage
