#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "harness/error.hpp"
#include "harness/strands/opengl/ribbons.hpp"

namespace pelage::strands {
namespace {

using Values = std::vector<std::string_view>;

void set(std::string& option, std::string_view name, std::string_view value, const Values& permitted) {
  if (std::find(permitted.begin(), permitted.end(), value) == permitted.end())
    throw InputError(fmt::format("option {} of the OpenGL baseline: \"{}\" is not known; give {}", name,
                                 value, fmt::join(permitted, ", ")));
  option = value;
}

}  // namespace

RibbonOptions ribbon_options(const std::string& text) {
  RibbonOptions options;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view item = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), item.size() + 1));
    const auto equals = item.find('=');
    const std::string_view name = item.substr(0, equals),
                           value = equals == std::string_view::npos ? "" : item.substr(equals + 1);
    if (name == "expand")
      set(options.expand, name, value, {"instanced", "indexed"});
    else if (name == "target")
      set(options.target, name, value, {"rgba32f", "rgba16f", "rgba8"});
    else
      throw InputError(fmt::format(
          "option \"{}\" of the OpenGL baseline of strands: give expand=WAY or target=FORMAT, separated by commas",
          item));
  }
  return options;
}

std::string to_text(const RibbonOptions& options) {
  return fmt::format("expand={},target={}", options.expand, options.target);
}

}  // namespace pelage::strands
