#include "harness/strands/groom/polylines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "harness/atomic_file.hpp"
#include "harness/error.hpp"

namespace pelage::strands {
namespace {

static_assert(std::endian::native == std::endian::little);

/// The first 128 bytes of a .hair file.
struct HairHeader {
  char magic[4] = {'H', 'A', 'I', 'R'};
  std::uint32_t strands = 0, points = 0;
  std::uint32_t arrays = 0;  ///< bits of the arrays that follow
  std::uint32_t segments = 0;
  float width = 0, transparency = 0, colour[3] = {0, 0, 0};
  char note[88] = {};
};
static_assert(sizeof(HairHeader) == 128);

constexpr std::uint32_t has_points = 1u << 1, has_widths = 1u << 2, has_colours = 1u << 4;

template <class T>
void append(std::string& bytes, std::span<const T> values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

std::string hair_of(const Polylines& lines, const std::string& note) {
  HairHeader header;
  const std::size_t each = std::size_t(lines.segments) + 1;
  header.points = std::uint32_t(lines.point.size());
  header.strands = std::uint32_t(lines.point.size() / each);
  header.arrays = has_points | has_widths | has_colours;
  header.segments = std::uint32_t(lines.segments);
  std::memcpy(header.note, note.data(), std::min(note.size(), sizeof header.note));
  std::string bytes;
  bytes.reserve(sizeof header + lines.point.size() * 28);
  append(bytes, std::span(std::as_const(header).magic, 4));
  bytes.append(reinterpret_cast<const char*>(&header.strands), sizeof header - 4);
  append(bytes, std::span(lines.point));
  append(bytes, std::span(lines.width));
  for (const glm::vec3& colour : lines.colour)
    for (std::size_t k = 0; k < each; ++k) append(bytes, std::span(&colour, 1));
  return bytes;
}

std::string obj_of(const Polylines& lines, const std::string& note) {
  std::string text = fmt::format("# {}\n", note);
  for (const glm::vec3& p : lines.point) text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
  const std::size_t each = std::size_t(lines.segments) + 1;
  for (std::size_t first = 1; first + each <= lines.point.size() + 1; first += each) {
    text += "l";
    for (std::size_t k = 0; k < each; ++k) text += fmt::format(" {}", first + k);
    text += "\n";
  }
  return text;
}

}  // namespace

void check_polylines_path(const std::filesystem::path& path) {
  if (path.extension() != ".hair" && path.extension() != ".obj")
    throw InputError(fmt::format("{}: strands are written as .hair or .obj", path.string()));
  require_place(path);
}

void write_polylines(const std::filesystem::path& path, const Polylines& lines, const std::string& note) {
  check_polylines_path(path);
  write_text_atomically(path, path.extension() == ".hair" ? hair_of(lines, note) : obj_of(lines, note));
}

}  // namespace pelage::strands
