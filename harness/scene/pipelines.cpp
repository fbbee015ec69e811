#include "harness/scene/pipelines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/error.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

/// True if `key` is in the list, or begins with an entry of the list that ends with a dot.
template <std::size_t N>
bool listed(std::string_view key, const std::string_view (&list)[N]) {
  return std::any_of(std::begin(list), std::end(list), [&](std::string_view entry) {
    return entry.ends_with('.') ? key.starts_with(entry) : key == entry;
  });
}

bool shells_ignore(std::string_view key, const Scene& scene) {
  if (key.starts_with("strands.")) return true;
  // Only mass-spring topologies use these keys.
  static constexpr std::string_view springs[] = {"dynamics.springs.", "dynamics.poke.",
                                                 "dynamics.motion.",  "dynamics.bend_power",
                                                 "dynamics.bend",     "dynamics.wind.gust_at"};
  return !has_springs(scene.dynamics) && listed(key, springs);
}

bool strands_ignore(std::string_view key, const Scene& scene) {
  if (key == "dynamics.topology") return has_springs(scene.dynamics);
  static constexpr std::string_view layers[] = {"fur.",
                                                "curl.",
                                                "wetness.",
                                                "clump.",
                                                "soaked.",
                                                "blend.",
                                                "dynamics.springs.",
                                                "dynamics.poke.",
                                                "dynamics.solver",
                                                "dynamics.tolerance",
                                                "dynamics.bend",
                                                "dynamics.bend_power",
                                                "dynamics.stiffness",
                                                "dynamics.drag",
                                                "dynamics.wind.gust_at",
                                                "shading.model",
                                                "shading.self_shadow",
                                                "shading.shadow",
                                                "shading.wrap",
                                                "shading.occlusion",
                                                "shading.darkening",
                                                "shading.wet_specular",
                                                "shading.tangent",
                                                "shading.sides"};
  return key != "fur.uv" && listed(key, layers);
}

/// The ray-cast picture shows all strands at rest, as cones. Their shadow comes from the opacity map, which
/// has strips with segments, and the width of pruned strands.
bool raycast_ignores(std::string_view key, const Scene& scene) {
  static constexpr std::string_view motion[] = {"contact.", "dynamics.", "strands.chain."};
  static constexpr std::string_view drawing[] = {"strands.segments", "strands.subdivision",
                                                 "strands.fraction", "strands.least_width"};
  return strands_ignore(key, scene) || (key != "strands.chain.first_segment" && listed(key, motion)) ||
         (scene.strands.shadow == "none" && listed(key, drawing));
}

constexpr PipelineName pipeline_table[] = {
    {"shells", "OpenCL", shells_ignore},
    {"reference", "naive implementation in double precision on the host", shells_ignore},
    {"strands", "single strands instead of layers, on OpenCL (docs/strands.md)", strands_ignore},
    {"strands-reference", "naive implementation of strands in double precision on the host", strands_ignore},
    {"strands-raycast", "strands at rest as cones, ray-cast", raycast_ignores},
    {"strands-opengl", "strands in OpenGL, one strip per strand", strands_ignore},
    {"opengl", "the pipeline of Silva et al. (2010) in OpenGL, with one pass per layer", shells_ignore},
};

}  // namespace

std::span<const PipelineName> drawing_pipelines() {
  return pipeline_table;
}

std::string pipelines_help() {
  std::string text;
  for (const PipelineName& pipeline : pipeline_table)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", pipeline.name, pipeline.what);
  return text;
}

std::vector<std::string> ignored_keys(const Scene& scene, std::string_view pipeline) {
  const auto found = std::find_if(std::begin(pipeline_table), std::end(pipeline_table),
                                  [&](const auto& p) { return p.name == pipeline; });
  if (found == std::end(pipeline_table))
    throw InputError(fmt::format("pipeline {}: no such pipeline", pipeline));
  std::vector<std::string> ignored;
  for (const auto& [name, value] : changed_keys(scene)) {
    std::string_view key = name;
    if (key.starts_with("keyframes.\"")) key = key.substr(11, key.size() - 12);
    if (found->ignores(key, scene)) ignored.push_back(name);
  }
  return ignored;
}

}  // namespace pelage
