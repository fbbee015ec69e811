// Reads mesh files: points and polygons without connectivity.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

struct Soup {
  std::vector<glm::dvec3> point;
  std::vector<std::vector<std::uint32_t>> polygon;
  /// UV of each corner of each polygon; no corner for a polygon without UV. Empty if no UV map was read.
  std::vector<std::vector<glm::dvec2>> uv;
};

/// Reads a mesh file. The file name's extension selects the format (harness/mesh/read/formats.hpp). If
/// `with_uv` is true, also reads the file's UV map, if it has one. Throws InputError if the file is not a
/// usable mesh. The message contains the file's name, the line if known, and the permitted content. The
/// returned soup is not empty, its numbers are finite and its indices are in range. Malicious files may crash
/// tinygltf, so call this function inside isolated().
Soup read_soup(const std::filesystem::path& file, bool with_uv);

/// Parses the bytes of an OBJ, OFF, PLY, STL or 3DS file. `format` is the file's extension in lower case
/// without the dot.
Soup parse_soup(std::string_view bytes, std::string_view format, const std::string& name,
                bool with_uv = false);

/// Largest magnitude of a coordinate in a mesh file. A surface must not be smaller than its reciprocal. Areas
/// and their squares thus stay in the range of a double.
inline constexpr double largest_coordinate = 1e30;

/// Throws InputError if the soup is empty, or contains an invalid coordinate or an index out of range.
void check_soup(const Soup& soup, const std::string& name);

/// Returns the extension of the file in lower case, without the dot.
std::string ending_of(const std::filesystem::path& file);

/// Returns whether read_soup() reads files with the extension of this file.
bool has_mesh_ending(const std::filesystem::path& file);

/// Greatest size of a mesh file in bytes. A file of ten million triangles has about a quarter of this size.
inline constexpr std::uint64_t largest_mesh_file = std::uint64_t(1) << 30;

/// Returns the limit of the memory for reading and preparing a mesh file of `size` bytes.
constexpr std::uint64_t mesh_memory(std::uint64_t size) {
  return (std::uint64_t(4) << 30) + 400 * size;
}

/// Reads a whole file. Throws InputError if the path is missing or a folder, or if the file is empty or
/// larger than `limit` bytes.
std::string read_bytes(const std::filesystem::path& file, std::uint64_t limit);

/// Returns the bytes of the file `member`; empty if the archive does not contain it. Throws InputError if the
/// archive is missing or damaged, or if `member` is larger than 1 GiB.
std::optional<std::string> read_member(const std::filesystem::path& archive, const std::string& member);

/// Replaces the order of the file by one that depends only on the surface. Points are sorted by x, then y,
/// then z. All faces refer to the first of coincident points. The corners of a face start with the first of
/// its points and keep their direction of rotation; faces are sorted by their corners. Later steps, such as
/// the cuts of the UV map, choose between equally good results by this order. A surface therefore has the
/// same UV map in whatever order its file lists it. -0 becomes 0.
void sort_soup(Soup& soup);

}  // namespace pelage
