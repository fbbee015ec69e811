#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "harness/error.hpp"
#include "harness/shells/opengl/opengl.hpp"

namespace pelage {
namespace {

struct Choice {
  std::string name;
  std::string OpenGlOptions::*slot;
  std::vector<std::string> values;
};

const std::vector<Choice>& choices() {
  static const std::vector<Choice> all{
      {"draws", &OpenGlOptions::draws, {"instanced", "each"}},
      {"fur", &OpenGlOptions::fur, {"array", "volume"}},
      {"texels", &OpenGlOptions::texels, {"half", "byte"}},
      {"target", &OpenGlOptions::target, {"rgba32f", "rgba16f", "rgba8"}},
      {"triangles", &OpenGlOptions::triangles, {"all", "seen"}},
      {"discard", &OpenGlOptions::discard, {"yes", "no"}},
  };
  return all;
}

/// Options that an earlier version had, with their default values. The defaults are what the baseline does.
const std::vector<std::string> removed{"vertices=indexed", "snap=shader", "levels=trilinear", "power=whole",
                                       "constants=baked"};

void set(OpenGlOptions& options, const std::string& part) {
  const auto equals = part.find('=');
  for (const std::string& option : removed)
    if (option.starts_with(part.substr(0, equals) + "=")) {
      if (part == option) return;
      throw InputError(
          fmt::format("OpenGL option '{}' is no longer available; the baseline has {}", part, option));
    }
  const std::string name = part.substr(0, equals);
  const auto found = std::find_if(choices().begin(), choices().end(),
                                  [&](const Choice& choice) { return choice.name == name; });
  if (found == choices().end()) {
    std::vector<std::string> names;
    for (const Choice& choice : choices()) names.push_back(choice.name);
    throw InputError(fmt::format("OpenGL option '{}': the options are {}, given as name=value,name=value",
                                 part, fmt::join(names, ", ")));
  }
  const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
  if (std::find(found->values.begin(), found->values.end(), value) == found->values.end())
    throw InputError(
        fmt::format("OpenGL option '{}': {} must be one of {}", part, name, fmt::join(found->values, ", ")));
  options.*found->slot = value;
}

}  // namespace

OpenGlOptions opengl_options(const std::string& text) {
  OpenGlOptions options;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) set(options, part);
  if (options.triangles == "seen" && options.draws != "each")
    throw InputError("OpenGL option 'triangles=seen' needs one draw call per layer: add draws=each");
  return options;
}

std::string to_text(const OpenGlOptions& options) {
  std::vector<std::string> parts;
  for (const Choice& choice : choices()) parts.push_back(choice.name + "=" + options.*choice.slot);
  return fmt::format("{}", fmt::join(parts, ","));
}

}  // namespace pelage
