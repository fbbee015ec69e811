// Reads experiments/models.toml, the list of the named models and their sources.
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
  std::optional<std::uint32_t> faces;  ///< exact face count; empty: the face count of the source
  glm::dvec3 rotation{0};              ///< rotation about x, then y, then z, degrees
  bool wrap = false;                   ///< true: wrap() replaces the repaired surface by a watertight hull
  bool stand_in = false;
  std::string licence, footnote;
  /// Numbers of masses and springs that Banisch and Wuethrich 2006 publish for this model, for each
  /// mass-spring topology; under the name "mesh", their numbers of vertices and faces.
  std::map<std::string, std::array<std::uint32_t, 2>> published;
};

/// Returns all models of a file, in the order in which the file lists them. If the file is malformed,
/// throws InputError; the message gives the file, the line and the key.
std::vector<Model> read_models(const std::filesystem::path& file);
/// Reads the file experiments/models.toml. Takes it from the first folder of data_folders() that contains it.
std::vector<Model> models();
/// Returns the footnote of the model in tables; "" if models() has no such model.
std::string footnote_of(const std::string& model);

}  // namespace pelage
