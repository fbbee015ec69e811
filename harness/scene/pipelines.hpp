// The names of the pipelines that draw a scene, and the scene keys that they do not use. The table of systems
// (harness/system/table.cpp) has the code of each pipeline.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/scene/scene.hpp"

namespace pelage {

/// A pipeline that draws a scene.
struct PipelineName {
  std::string_view name;  ///< value of the scene key `pipeline` and of the option --pipeline
  std::string_view what;  ///< description for --help and for the scene key, one line
  /// True if the picture does not depend on the key or list `key` of the scene.
  bool (*ignores)(std::string_view key, const Scene& scene);
};

std::span<const PipelineName> drawing_pipelines();

/// Returns "name: description; ..." of all pipelines that draw.
std::string pipelines_help();

/// Returns the keys whose values differ from the defaults although the pipeline does not use them, in the
/// order of changed_keys(). Throws InputError if no pipeline has this name.
std::vector<std::string> ignored_keys(const Scene& scene, std::string_view pipeline);

}  // namespace pelage
