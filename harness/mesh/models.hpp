// experiments/models.toml: the named models and where their shapes come from.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pelage {

struct Model {
  std::string name;
  std::string source;                  ///< "procedural:NAME" | "cgal:FILE" | "glmark2:FILE"
  std::optional<std::uint32_t> faces;  ///< exact; empty: the source's own
  glm::dvec3 rotation{0};              ///< degrees about x, then y, then z
  bool wrap = false;                   ///< alpha wrap first
  bool stand_in = false;
  std::string licence, footnote;
  /// What a paper says it has, per topology (harness/springs): masses, springs.
  std::map<std::string, std::array<std::uint32_t, 2>> published;
};

/// All models in the file's order. Throws InputError with file, line and key.
std::vector<Model> read_models(const std::filesystem::path& file);
std::vector<Model>
models();  ///< those of $PELAGE_DATA/experiments, else the source tree's, else the installed share's

}  // namespace pelage
