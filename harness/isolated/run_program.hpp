// Runs another program without a shell.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace pelage {

struct ProgramOutcome {
  int code = -1;         ///< exit code; 127: the program cannot be started; -1: it ended by a signal
  std::string messages;  ///< what it wrote to stdout and stderr
};

/// Runs the program words[0], which is a path or a name that is searched on PATH, with the arguments that
/// follow. The program reads nothing from stdin. It runs in `folder`, or in the present folder if `folder` is
/// empty.
ProgramOutcome run_program(std::vector<std::string> words, const std::filesystem::path& folder = {});

/// True if a folder of PATH contains the program `name`.
bool on_path(const std::string& name);

/// Returns the last line of a text, without empty lines at its end.
std::string last_line(std::string text);

}  // namespace pelage
