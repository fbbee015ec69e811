// The mesh as every later stage sees it, and how to get one. CGAL stays behind this header.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pelage {

/// A prepared triangle mesh with a UV atlas. Lengths in R: the bounding sphere is centred on the origin and
/// has radius 1. A vertex on a UV seam has one copy per chart side; `weld` names the surface point that its
/// copies share. Vertices, surface points and triangles are in Morton order.
struct Mesh {
  std::string name;
  std::string hash;                  ///< hex hash of the content below, for caches and provenance
  std::vector<glm::vec3> position;   ///< V copies
  std::vector<glm::vec2> uv;         ///< V, in [0,1]^2
  std::vector<std::uint32_t> weld;   ///< V, the surface point of each copy, in [0, welded)
  std::vector<glm::uvec3> triangle;  ///< F, copies, counter-clockwise seen from outside
  std::uint32_t welded = 0;          ///< W, number of surface points
  bool periodic_uv = false;          ///< the UV square wraps (torus): textures repeat seamlessly
  /// Mean surface length per unit of u and of v, in R: the atlas's scale, one value per axis.
  glm::vec2 length_per_uv{1.0f, 1.0f};
  /// What was done to the source to get here, a line each: repairs, remeshing, how the UV map was made.
  std::vector<std::string> notes;
};

struct MeshOptions {
  std::optional<std::uint32_t> faces;  ///< exact face count; empty: the model's own, or the file's
  bool keep_uv = false;                ///< use the file's own UV map (OBJ, PLY, 3DS, glTF)
  /// Turns the model as it would stand otherwise: degrees about x, then y, then z, the axes being fixed.
  glm::vec3 rotate{0};
  bool largest_only = false;  ///< of a file's components only the largest is kept
  bool cache = true;          ///< read and write the folder of prepared meshes
  /// Told what is going on while a mesh is prepared (seconds to minutes), and each of its notes.
  std::function<void(const std::string&)> progress;
  double silent_s = 2;  ///< stages of the preparation are told after so many seconds of it
};

/// The mesh that `name_or_file` means: a name of experiments/models.toml at its face count, else a file (OBJ,
/// OFF, PLY, STL, 3DS, glTF). Prepared meshes are cached by content in $XDG_CACHE_HOME/pelage. The same
/// source and options give the same bits. Throws InputError for an unknown name, and for a file that is no
/// usable mesh, saying why.
std::shared_ptr<const Mesh> load_model(const std::string& name_or_file, const MeshOptions& options = {});

}  // namespace pelage
