// Strands as polylines, in the files of hair tools and renderers: Cem Yuksel's HAIR and the lines of OBJ.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

/// Polylines from root to tip, one after the other.
struct Polylines {
  std::vector<std::uint32_t> count;  ///< number of points of each polyline, at least 2
  std::vector<glm::vec3> point;
  std::vector<float> width;        ///< at each point, in the unit of the points; empty: the file has none
  std::vector<glm::vec3> colour;   ///< at each point, gamma-encoded RGB, 0 to 1; empty: the file has none
  std::vector<std::string> notes;  ///< what the reader left out, one line each
};

/// Returns the index of the first point of each polyline.
std::vector<std::size_t> first_points(const Polylines& lines);

/// Returns a description such as "300 strands of 2 to 40 points".
std::string describe(const Polylines& lines);

/// Polylines on a mesh, in R.
struct PlacedStrands {
  Polylines lines;
  std::vector<glm::vec3> normal;        ///< normal of the skin at each root, unit vector
  std::vector<glm::vec2> uv;            ///< UV of the skin at each root
  std::vector<std::uint32_t> triangle;  ///< the triangle of each root
};

/// Reads a .hair or an .obj file. Equal points that follow each other become one point; polylines of one
/// point are left out. Throws InputError if the file is not usable. The message contains the file's name, the
/// line or the byte if known, and what would be right.
Polylines read_polylines(const std::filesystem::path& file);

/// Parses the bytes of a file; `format` is "hair" or "obj", and `name` is the file in messages.
Polylines parse_polylines(std::string_view bytes, std::string_view format, const std::string& name);

/// Throws InputError if write_polylines() cannot write `path`: another ending than .hair and .obj, or no
/// folder.
void check_polylines_path(const std::filesystem::path& path);

/// Writes the polylines. A .hair file (little-endian) has the points and, if there are any, widths and
/// colours; an .obj file has points (`v`) and lines (`l`). `note` stands in the file's header. Throws
/// InputError if the path cannot be written.
void write_polylines(const std::filesystem::path& path, const Polylines& lines, const std::string& note);

}  // namespace pelage
