// What a mesh file holds before anything is known about it: points and polygons.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

struct Soup {
  std::vector<glm::dvec3> point;
  std::vector<std::vector<std::uint32_t>> polygon;
  std::vector<std::vector<glm::dvec2>> uv;  ///< per polygon and corner; empty: none read
};

/// Reads OBJ, OFF, PLY, STL (by CGAL), 3DS, glTF, glb (by Assimp), told apart by the name's end. With
/// `with_uv` OBJ and PLY go through Assimp too, which reads texture coordinates. Throws InputError naming the
/// file, the line where it is known, and what would be right. The result is not empty, its numbers are finite
/// and its indices in range. Neither library is hardened against malice: call it inside isolated().
Soup read_soup(const std::filesystem::path& file, bool with_uv);

/// The same from memory, for OBJ, OFF, PLY and STL; `format` is the lower-case ending without its dot.
Soup parse_soup(std::string bytes, std::string_view format, const std::string& name);

/// Throws InputError if the soup is empty, or holds a number that is not finite or an index out of range.
void check_soup(const Soup& soup, const std::string& name);

/// Reads a whole file. Throws InputError when there is none, or it is a folder, empty, or larger than `limit`
/// bytes.
std::string read_bytes(const std::filesystem::path& file, std::uint64_t limit);

namespace detail {
/// Before CGAL reads it: throws InputError with the line at which `text` stops being OBJ, OFF, ...; OBJ comes
/// back with only the lines that matter to us, since CGAL refuses files that hold elements it does not know.
void check_text(std::string& bytes, std::string_view format, const std::string& name);
bool read_by_cgal(const std::string& bytes, std::string_view format, Soup& soup);
Soup read_by_assimp(const std::filesystem::path& file);
}  // namespace detail

}  // namespace pelage
