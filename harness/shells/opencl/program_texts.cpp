#include "harness/shells/opencl/program_texts.hpp"

#include <fmt/format.h>

#include "harness/contact/opencl/contact_stage.hpp"
#include "harness/prepare/fur_texture.hpp"
#include "harness/shells/opencl/mapping.hpp"

namespace pelage::shells {

std::string style_options(const Scene& scene) {
  std::string options;
  if (!scene.curl.radius_map.empty()) options += " -D RADIUS_MAP=1";
  if (!scene.curl.turns_map.empty()) options += " -D TURNS_MAP=1";
  if (!scene.fur.density_map.empty())
    options += " -D DENSITY=2";
  else if (scene.fur.density < 1)
    options += " -D DENSITY=1";
  if (coverage_power(scene.fur) != 1) options += " -D COVERAGE_POWER=1";
  options += contact_options(scene.contact);
  if (scene.shading.self_shadow == "traced") options += " -D TRACED=1";
  if (by_depth(scene.blend)) options += " -D DEPTH_ORDER=1";
  return options;
}

cl::ProgramText geometry_text(const Scene& scene, int lanes, const Tuning& tuning) {
  return {"rasterize/geometry/geometry.cl", build_options(lanes, tuning) + style_options(scene)};
}

cl::ProgramText mask_text() {
  return {"wet/wet.cl", build_options(1, {})};
}

cl::ProgramText wet_text(const Scene& scene, int lanes) {
  return {"rasterize/geometry/wet.cl", build_options(lanes, {}) + style_options(scene)};
}

cl::ProgramText simulate_text(const Scene& scene, int lanes) {
  std::string options = build_options(lanes, {});
  if (!scene.fur.length_map.empty()) options += " -D LENGTH_MAP=1";
  options += contact_options(scene.contact);
  return {"simulate/simulate.cl", options};
}

cl::ProgramText sticks_text(int lanes) {
  return {"rasterize/geometry/sticks.cl", build_options(lanes, {})};
}

std::vector<cl::ProgramText> expected_programs(const cl::Device& device, const Scene& scene,
                                               const ShellOptions& options) {
  const MappingKind& kind = mapping_for(scene.blend, options.mapping, device.info());
  const Tuning tuning = kind.tuning(options.tuning);
  const int lanes = kind.lanes(device.info());
  const bool wet = scene.wetness.random > 0 || !scene.wetness.droplets.empty();
  std::vector<cl::ProgramText> texts;
  if (wet) texts.push_back(mask_text());
  texts.push_back(geometry_text(scene, lanes, tuning));
  for (cl::ProgramText& text : kind.programs(build_options(lanes, tuning) + style_options(scene)))
    texts.push_back(std::move(text));
  if (wet) texts.push_back(wet_text(scene, lanes));
  texts.push_back(has_springs(scene.dynamics) ? sticks_text(lanes) : simulate_text(scene, lanes));
  return texts;
}

std::string build_options(int lanes, const Tuning& tuning) {
  std::string options = fmt::format("-D LANES={}", lanes);
  for (const auto& [name, value] : tuning) options += fmt::format(" -D {}={}", name, value);
  return options;
}

int tuned(const Tuning& tuning, const std::string& axis, int otherwise) {
  const auto found = tuning.find(axis);
  return found == tuning.end() ? otherwise : found->second;
}

}  // namespace pelage::shells
