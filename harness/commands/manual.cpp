// pelage manual, which the installation calls, prints the manual page (troff) with a section COMMANDS. The
// section is generated from the declarations of the options, so that it always agrees with --help.
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string>

#include "harness/commands/commands.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

/// Returns the text with troff's special characters escaped.
std::string troff(const std::string& text) {
  std::string escaped = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text) escaped += c == '-' ? "\\-" : c == '\\' ? "\\e" : std::string(1, c);
  return escaped;
}

std::string section_of(const CLI::App& command) {
  std::string title, options;
  for (const CLI::Option* option : command.get_options()) {
    if (option == command.get_help_ptr()) continue;
    std::string names;
    for (const std::string& name : option->get_snames()) names += fmt::format(", \\fB\\-{}\\fR", name);
    for (const std::string& name : option->get_lnames())
      names += fmt::format(", \\fB{}\\fR", troff("--" + name));
    if (option->get_positional()) {
      names = fmt::format(", \\fI{}\\fR", option->get_name());
      title += option->get_required() ? fmt::format(" \\fI{}\\fR", option->get_name())
                                      : fmt::format(" \\fR[\\fI{}\\fR]", option->get_name());
    }
    if (option->get_type_size() != 0) names += fmt::format(" \\fI{}\\fR", troff(option->get_type_name()));
    options += fmt::format(".TP\n{}\n{}", names.substr(2), troff(option->get_description()));
    if (!option->get_default_str().empty())
      options += fmt::format(" (default: {})", troff(option->get_default_str()));
    options += ".\n";
  }
  return fmt::format(".SS pelage {}{}\n{}.\n{}", troff(command.get_name()), title,
                     troff(command.get_description()), options);
}

/// The value of the positional argument, and pelage's declarations.
struct ManualOptions {
  std::string page;
  CLI::App* app = nullptr;
};

int print_manual(const ManualOptions& options) {
  std::ifstream stream(options.page);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t start = text.find(".SH COMMANDS\n"), end = text.find(".SH ", start + 1);
  if (end == std::string::npos)
    throw InputError(fmt::format("{}: has no section COMMANDS before another section", options.page));
  fmt::print("{}.SH COMMANDS\n", text.substr(0, start));
  for (const CLI::App* one : options.app->get_subcommands([](const CLI::App*) { return true; }))
    fmt::print("{}", section_of(*one));
  fmt::print("{}", text.substr(end));
  return 0;
}

}  // namespace

void add_manual(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<ManualOptions>(
      app, chosen, "manual", "Print a manual page with the descriptions of all commands", print_manual);
  options.app = &app;
  add_value(command, "page", options.page, "FILE",
            "Page (troff) whose section COMMANDS is replaced: docs/pelage.1")
      ->required()
      ->check(CLI::ExistingFile);
}

}  // namespace pelage
