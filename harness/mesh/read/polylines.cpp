#include "harness/mesh/read/polylines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <span>

#include "harness/atomic_file.hpp"
#include "harness/error.hpp"
#include "harness/mesh/read/hair.hpp"
#include "harness/mesh/read/soup.hpp"

namespace pelage {
namespace {

template <class T>
void append(std::string& bytes, std::span<const T> values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

std::string hair_of(const Polylines& lines, const std::string& note) {
  hair::Header header;
  std::vector<std::uint16_t> segments;
  for (const std::uint32_t count : lines.count) segments.push_back(std::uint16_t(count - 1));
  const bool even = std::ranges::adjacent_find(segments, std::not_equal_to{}) == segments.end();
  header.strands = std::uint32_t(lines.count.size());
  header.points = std::uint32_t(lines.point.size());
  header.arrays = hair::has_points | (even ? 0 : hair::has_segments) |
                  (lines.width.empty() ? 0 : hair::has_widths) |
                  (lines.colour.empty() ? 0 : hair::has_colours);
  header.segments = even && !segments.empty() ? segments.front() : 0;
  std::memcpy(header.note, note.data(), std::min(note.size(), sizeof header.note));
  std::string bytes;
  bytes.reserve(sizeof header + 2 * segments.size() + lines.point.size() * 28);
  append(bytes, std::span<const hair::Header>(&header, 1));
  if (!even) append(bytes, std::span<const std::uint16_t>(segments));
  append(bytes, std::span(lines.point));
  append(bytes, std::span(lines.width));
  append(bytes, std::span(lines.colour));
  return bytes;
}

std::string obj_of(const Polylines& lines, const std::string& note) {
  std::string text = fmt::format("# {}\n", note);
  for (const glm::vec3& p : lines.point) text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
  std::size_t next = 1;
  for (const std::uint32_t count : lines.count) {
    text += "l";
    for (std::uint32_t k = 0; k < count; ++k) text += fmt::format(" {}", next++);
    text += "\n";
  }
  return text;
}

}  // namespace

std::vector<std::size_t> first_points(const Polylines& lines) {
  std::vector<std::size_t> first(lines.count.size());
  std::exclusive_scan(lines.count.begin(), lines.count.end(), first.begin(), std::size_t(0));
  return first;
}

std::string describe(const Polylines& lines) {
  if (lines.count.empty()) return "no strands";
  const auto [least, most] = std::ranges::minmax(lines.count);
  const std::size_t strands = lines.count.size();
  const std::string points = least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
  return fmt::format("{} {} of {} points", strands, strands == 1 ? "strand" : "strands", points);
}

void check_polylines_path(const std::filesystem::path& path) {
  if (ending_of(path) != "hair" && ending_of(path) != "obj")
    throw InputError(fmt::format("{}: strands are written as .hair or .obj", path.string()));
  require_place(path);
}

void write_polylines(const std::filesystem::path& path, const Polylines& lines, const std::string& note) {
  check_polylines_path(path);
  if (ending_of(path) == "hair")
    for (const std::uint32_t count : lines.count)
      if (count > std::numeric_limits<std::uint16_t>::max())
        throw InputError(
            fmt::format("{}: a strand of {} points; a .hair file has at most 65535 per strand; give .obj",
                        path.string(), count));
  write_text_atomically(path, ending_of(path) == "hair" ? hair_of(lines, note) : obj_of(lines, note));
}

}  // namespace pelage
