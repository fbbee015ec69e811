// Mesh, the prepared mesh that the rest of pelage uses, and load_model(), which loads it. This header does
// not include CGAL.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

struct PlacedStrands;

/// A prepared triangle mesh with a UV map. The unit of length is R, the radius of the bounding sphere. The
/// sphere is centred at the origin. A surface point on a UV seam has several vertices, called its copies, one
/// for each UV. `weld` maps each vertex to its surface point. Vertices, surface points and triangles are
/// sorted along a Morton curve.
struct Mesh {
  std::string name;
  std::string hash;                  ///< content_hash(), which identifies the mesh in caches and results
  std::vector<glm::vec3> position;   ///< position of each vertex
  std::vector<glm::vec2> uv;         ///< UV of each vertex, in [0,1]^2
  std::vector<std::uint32_t> weld;   ///< surface point of each vertex, 0 <= value < welded
  std::vector<glm::uvec3> triangle;  ///< vertices of each triangle, counter-clockwise as seen from outside
  std::uint32_t welded = 0;          ///< number of surface points
  bool periodic_uv = false;          ///< true: the UV map repeats without seam (torus)
  /// Mean length on the surface, in R, per unit of u and per unit of v.
  glm::vec2 length_per_uv{1.0f, 1.0f};
  /// Descriptions of the steps of the preparation, one line per step: repairs, remeshing, method of the UV
  /// map.
  std::vector<std::string> notes;
  bool from_file = false;  ///< true: the mesh is not one of pelage's models, so its notes are warnings
  /// Positions of the surface points in each frame of a mesh that moves and deforms (read_mesh_frames()), R.
  /// Empty: the mesh does not deform. If there are frames, `hash` also depends on them.
  std::vector<std::vector<glm::vec3>> frames;
  /// Strands of a file on this mesh (with_strands()); null: none. `hash` then also depends on them.
  std::shared_ptr<const PlacedStrands> strands;
};

struct MeshOptions {
  std::optional<std::uint32_t> faces;  ///< exact face count; empty: the count of the model or the file
  bool keep_uv = false;                ///< true: use the file's own UV map (OBJ, PLY, 3DS, glTF)
  /// True: if the computed UV map enlarges or shrinks a part of the surface by more than a factor of 1.6 in
  /// area, this part gets its own chart (recut()).
  bool even_uv = false;
  /// Additional rotation of the prepared model about the fixed axes x, then y, then z, degrees.
  glm::vec3 rotate{0};
  bool largest_only = false;  ///< true: keep only the largest component of a file
  bool cache = true;          ///< true: read and write the cache of prepared meshes
  /// Callback that receives progress messages during the preparation, which takes seconds to minutes. It also
  /// receives the lines of Mesh::notes. If a mesh is read from the cache, the callback receives only the
  /// notes of a mesh file.
  std::function<void(const std::string&)> progress;
  double silent_s = 2;  ///< no messages about stages of the preparation during its first `silent_s` seconds
};

/// Loads a model by its name in experiments/models.toml, a torus of A x B quads by the name "torus-AxB", or a
/// mesh file (OBJ, OFF, PLY, STL, 3DS, glTF). Prepared meshes are cached in the subfolder `meshes` of
/// cache_folder() (disk_cache.hpp). The name of a cache file contains a hash of the source and the options.
/// The same source and options give a bitwise identical mesh. Throws InputError with the reason if the name
/// is unknown or the file is not a usable mesh.
std::shared_ptr<const Mesh> load_model(const std::string& name_or_file, const MeshOptions& options = {});

/// Throws InputError if `name_or_file` is neither the name of a model or torus nor an existing file, or if
/// the numbers in the name of a torus are out of range. Does not read the file.
void require_model(const std::string& name_or_file);

/// Where the preparation placed the points of a mesh file: the point p of the file is at
/// `turn` ((p - shift) / radius), in R. `radius` is R in the unit of the file.
struct Placement {
  glm::dmat3 turn{1};
  glm::dvec3 shift{0};
  double radius = 1;
  glm::dvec3 operator()(glm::dvec3 p) const { return turn * ((p - shift) / radius); }
};

/// Returns the placement of the mesh, which is the prepared mesh of `file`, rotated by `rotation` (degrees
/// about x, then y, then z), from their bounding boxes. Throws InputError, which begins with `key`, if the
/// preparation moved a side of the box.
Placement placement_of(const Mesh& mesh, const std::filesystem::path& file, glm::dvec3 rotation,
                       std::string_view key);

// The frames of a mesh that moves and deforms: one mesh file per frame.

/// Returns the file of frame `frame`, where `first` is the file of frame 0. The last number in the name of
/// `first` counts up, and keeps its leading zeros: "walk-0009.obj" is followed by "walk-0010.obj". Throws
/// InputError if the name contains no number. The message begins with `key`.
std::filesystem::path frame_file(const std::filesystem::path& first, int frame,
                                 std::string_view key = "mesh.frames");

/// Returns the positions of the mesh's surface points (Mesh::weld) in `count` frames, in R. `mesh` is the
/// prepared mesh of the file `first`, rotated by `rotation` (degrees about x, then y, then z). All frames get
/// the rotation, the translation and the scale that the preparation gave to the first frame. Throws
/// InputError if a file is missing or not a mesh, if it has other faces than the first file, if the
/// preparation of the first file moved or added points, or if points that coincide in the first frame part in
/// a later one. `key` is the scene key in messages.
std::vector<std::vector<glm::vec3>> read_mesh_frames(const Mesh& mesh, const std::filesystem::path& first,
                                                     int count, glm::dvec3 rotation,
                                                     std::string_view key = "mesh.frames");

// Writes a prepared mesh to a file for other programs.

/// Writes binary little-endian PLY. A vertex has the floats x y z s t. The UV coordinates have the names s
/// and t, because Blender and MeshLab read UV coordinates under these names. A face has vertex_indices.
/// Writes the file with write_text_atomically().
void write_ply(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace pelage
