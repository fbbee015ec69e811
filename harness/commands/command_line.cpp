// pelage completion prints a script with which a shell completes pelage's command line. pelage manual, which
// the installation calls, prints the manual page (troff) with a section COMMANDS. Both are generated from the
// declarations of the options, so that they always agree with --help.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/mesh/models.hpp"
#include "harness/scene/scene_keys.hpp"

namespace pelage {
namespace {

using Words = std::vector<std::string>;

/// The words that the shell offers as the value of an option or of a positional argument.
struct Values {
  Words words;
  bool keys = false;  ///< true: each word is a key that ends with '='; the shell appends no space
};

Words experiment_names() {
  Words names;
  for (const auto& file : experiment_files()) names.push_back(file.stem().string());
  return names;
}

Words preset_names() {
  std::set<std::string> names;
  for (const auto& file : experiment_files())
    for (const auto& [name, preset] : read_experiment(file).presets) names.insert(name);
  return {names.begin(), names.end()};
}

Words model_names() {
  Words names;
  for (const Model& model : models()) names.push_back(model.name);
  return names;
}

Words keys_with(Words names) {
  Scene scene;
  for (const Key& key : scene_keys(scene)) names.emplace_back(key.name);
  for (std::string& name : names) name += '=';
  return names;
}

/// Returns the permitted values that CLI11 lists in an option's type name. For "TEXT:{all,largest}" these are
/// "all" and "largest".
Words declared_values(const std::string& type) {
  const std::size_t from = type.find('{'), to = type.find('}');
  Words words;
  if (from == std::string::npos || to == std::string::npos) return words;
  std::istringstream list(type.substr(from + 1, to - from - 1));
  for (std::string word; std::getline(list, word, ',');)
    if (!word.empty()) words.push_back(word);
  return words;
}

Values values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (Words words = declared_values(type); !words.empty()) return {std::move(words)};
  if (type.starts_with("EXPERIMENT")) return {experiment_names()};
  if (option.check_lname("preset")) return {preset_names()};
  if (type == "KEY=VALUE" || type == "key=value") return {keys_with({}), true};
  if (type == "key=a,b") return {keys_with({"layers", "size", "reading", "variant"}), true};
  if (type.starts_with("MODEL") || option.check_lname("model") || option.check_name("model"))
    return {model_names()};
  if (type.starts_with("defaults")) return {{"defaults"}};
  return {};
}

Words option_names(const CLI::App& app) {
  Words names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// Returns the branches of a bash `case` statement that offer the values of the options of `app`. `name` is
/// the name of the command, or "*" if `app` is pelage itself.
std::string value_cases(const CLI::App& app, const std::string& name) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional() || option->get_items_expected_max() == 0)
      continue;  // skip positional arguments and flags
    Words patterns;
    for (const std::string& one : option->get_snames())
      patterns.push_back(fmt::format("{}' -{}'", name, one));
    for (const std::string& one : option->get_lnames())
      patterns.push_back(fmt::format("{}' --{}'", name, one));
    const Values values = values_of(*option);
    text += fmt::format("    {}) _pelage_words '{}'{}; return ;;\n", fmt::join(patterns, " | "),
                        fmt::join(values.words, " "), values.keys ? "; compopt -o nospace" : "");
  }
  return text;
}

std::string bash_script(const CLI::App& app) {
  Words commands;
  std::string values = value_cases(app, "*"), words;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command->get_name());
    values += value_cases(*command, command->get_name());
    Words arguments;
    for (const CLI::Option* option : command->get_options())
      if (option->get_positional()) {
        const Words more = values_of(*option).words;
        arguments.insert(arguments.end(), more.begin(), more.end());
      }
    words += fmt::format("    {}) options='{}' arguments='{}' ;;\n", command->get_name(),
                         fmt::join(option_names(*command), " "), fmt::join(arguments, " "));
  }
  // The option `-o default` makes bash complete file names if no word matches.
  return fmt::format(
      R"(# Completion of pelage's command line for bash. `pelage completion bash` wrote this file.
_pelage_words() {{
  COMPREPLY=($(compgen -W "$1" -- "$current"))
}}
_pelage() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} command='' word
  local options='{1}' arguments='{0}'
  if [[ $current == = ]]; then current=''; fi
  if [[ $previous == = ]]; then previous=${{COMP_WORDS[COMP_CWORD - 2]}}; fi
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case $word in {2}) command=$word; break ;; esac
  done
  COMPREPLY=()
  case "$command $previous" in
{3}  esac
  case $command in
{4}  esac
  if [[ $current == -* ]]; then _pelage_words "$options"; else _pelage_words "$arguments"; fi
}}
complete -o default -F _pelage pelage
)",
      fmt::join(commands, " "), fmt::join(option_names(app), " "), fmt::join(commands, " | "), values, words);
}

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
struct CommandLine {
  std::string value;
  CLI::App* app = nullptr;
};

int print_completion(const CommandLine& options) {
  fmt::print("{}", bash_script(*options.app));
  return 0;
}

int print_manual(const CommandLine& options) {
  std::ifstream stream(options.value);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t start = text.find(".SH COMMANDS\n"), end = text.find(".SH ", start + 1);
  if (end == std::string::npos)
    throw InputError(fmt::format("{}: has no section COMMANDS before another section", options.value));
  fmt::print("{}.SH COMMANDS\n", text.substr(0, start));
  for (const CLI::App* one : options.app->get_subcommands([](const CLI::App*) { return true; }))
    fmt::print("{}", section_of(*one));
  fmt::print("{}", text.substr(end));
  return 0;
}

}  // namespace

void add_completion(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<CommandLine>(
      app, chosen, "completion", "Print a script that completes pelage's command line in a shell",
      print_completion);
  options.app = &app;
  add_value(command, "shell", options.value, "SHELL", "Name of the shell")
      ->required()
      ->check(CLI::IsMember({"bash"}));
}

void add_manual(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<CommandLine>(
      app, chosen, "manual", "Print a manual page with the descriptions of all commands", print_manual);
  options.app = &app;
  add_value(command, "page", options.value, "FILE",
            "Page (troff) whose section COMMANDS is replaced: docs/pelage.1")
      ->required()
      ->check(CLI::ExistingFile);
}

}  // namespace pelage
