// The list of all mappings. The tile mapping is the default on devices whose work-items have 16 lanes. The
// workgroup mapping is the default on all others.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/error.hpp"
#include "harness/shells/opencl/mapping.hpp"
#include "harness/shells/opencl/shells.hpp"

namespace pelage::shells {
namespace {

const MappingKind* const kinds[] = {&tile_mapping, &pixel_mapping, &workgroup_mapping};

bool offered(const MappingKind& kind, const cl::DeviceInfo& device) {
  return &kind != &tile_mapping || device.lanes > 1;
}

const MappingKind& default_kind(const cl::DeviceInfo& device) {
  return offered(tile_mapping, device) ? tile_mapping : workgroup_mapping;
}

}  // namespace

constinit const std::span<const MappingKind* const> mapping_kinds = kinds;

const MappingKind& mapping_named(const std::string& name, const cl::DeviceInfo& device) {
  if (name.empty()) return default_kind(device);
  const auto found =
      std::find_if(std::begin(kinds), std::end(kinds), [&](const auto* kind) { return kind->name == name; });
  if (found == std::end(kinds))
    throw InputError(
        fmt::format("mapping '{}': the name must be one of {}", name, fmt::join(mappings(), ", ")));
  return **found;
}

const MappingKind& mapping_for(const BlendScene& blend, const std::string& name,
                               const cl::DeviceInfo& device) {
  const MappingKind& named = mapping_named(name, device);
  return by_depth(blend) && &named == &tile_mapping ? workgroup_mapping : named;
}

}  // namespace pelage::shells

namespace pelage {

const std::vector<std::string>& mappings() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto* kind : shells::kinds) list.emplace_back(kind->name);
    return list;
  }();
  return names;
}

std::string mappings_help() {
  std::string text;
  for (const auto* kind : shells::kinds)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", kind->name, kind->what);
  return text;
}

std::vector<std::string> mappings_on(const cl::DeviceInfo& device) {
  std::vector<std::string> names{default_mapping(device)};
  for (const auto* kind : shells::kinds)
    if (kind->name != names.front() && shells::offered(*kind, device)) names.emplace_back(kind->name);
  return names;
}

std::string offered_mapping(const std::string& name, const cl::DeviceInfo& device) {
  const std::vector<std::string> names = mappings_on(device);
  if (name.empty()) return names.front();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw InputError(fmt::format("mapping '{}': on {}, the name must be one of {}", name, device.name,
                                 fmt::join(names, ", ")));
  return name;
}

std::string default_mapping(const cl::DeviceInfo& device) {
  return std::string(shells::default_kind(device).name);
}

}  // namespace pelage
