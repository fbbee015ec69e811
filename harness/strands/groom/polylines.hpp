// Strands as polylines, in the files of hair tools and renderers.
#pragma once
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace pelage::strands {

/// Polylines of equally many points each.
struct Polylines {
  int segments = 1;               ///< of each polyline, 1 to 65535; it has one point more
  std::vector<glm::vec3> point;   ///< from root to tip, one polyline after the other, R
  std::vector<float> width;       ///< at each point, R
  std::vector<glm::vec3> colour;  ///< of each polyline, gamma-encoded RGB
};

/// Throws InputError if write_polylines() cannot write `path`: another ending than .hair and .obj, or no
/// folder.
void check_polylines_path(const std::filesystem::path& path);

/// Writes the polylines. A .hair file (Cem Yuksel's format, little-endian) has points, widths and colours; an
/// .obj file has points (`v`) and lines (`l`). `note` stands in the file's header. Throws InputError if the
/// path cannot be written.
void write_polylines(const std::filesystem::path& path, const Polylines& lines, const std::string& note);

}  // namespace pelage::strands
