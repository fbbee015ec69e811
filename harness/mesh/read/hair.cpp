// Reads strands: Cem Yuksel's HAIR files, and the lines of OBJ files.
#include "harness/mesh/read/hair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "harness/error.hpp"
#include "harness/mesh/read/formats.hpp"
#include "harness/mesh/read/polylines.hpp"

namespace pelage {
namespace {

constexpr std::uint32_t most_strands = 4'000'000, most_points = 64'000'000;

/// The arrays of a HAIR file, one after the other.
class Arrays {
 public:
  /// `bytes` is the whole file.
  Arrays(std::string_view bytes, const std::string& name)
      : bytes_(bytes), rest_(bytes.substr(sizeof(hair::Header))), name_(name) {}

  /// Returns the next `count` values.
  template <class T>
  std::vector<T> next(std::size_t count, const char* what) {
    if (rest_.size() / sizeof(T) < count)
      throw InputError(fmt::format(
          "{}: the file ends at byte {}, but its {} need {} bytes from byte {} on; its header does not fit its length",
          name_, bytes_.size(), what, count * sizeof(T), bytes_.size() - rest_.size()));
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), rest_.data(), count * sizeof(T));
    rest_.remove_prefix(count * sizeof(T));
    return values;
  }
  std::size_t rest() const { return rest_.size(); }

 private:
  std::string_view bytes_, rest_;
  const std::string& name_;
};

/// Throws InputError if a value is not from `least` to `most`.
void need_values(const std::vector<float>& values, float least, float most, const char* what,
                 const std::string& name) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] >= least && values[i] <= most))
      throw InputError(fmt::format("{}: {} of point {} is {}; it must be from {:g} to {:g}", name, what, i,
                                   values[i], least, most));
}

void need_values(const std::vector<glm::vec3>& values, float least, float most, const char* what,
                 const std::string& name) {
  std::vector<float> axis(values.size());
  for (int k = 0; k < 3; ++k) {
    std::ranges::transform(values, axis.begin(), [&](const glm::vec3& v) { return v[k]; });
    need_values(axis, least, most, what, name);
  }
}

std::vector<std::uint32_t> counts_of(const hair::Header& header, Arrays& arrays, const std::string& name) {
  std::vector<std::uint32_t> counts(header.strands, header.segments + 1);
  if (header.arrays & hair::has_segments) {
    const std::vector<std::uint16_t> segments = arrays.next<std::uint16_t>(header.strands, "segment counts");
    for (std::size_t i = 0; i < segments.size(); ++i) counts[i] = segments[i] + 1u;
  }
  std::uint64_t points = 0;
  for (const std::uint32_t count : counts) points += count;
  if (points != header.points)
    throw InputError(fmt::format("{}: its strands have {} points together, but the header says {}", name,
                                 points, header.points));
  return counts;
}

Polylines parse_hair(std::string_view bytes, const std::string& name) {
  hair::Header header;
  if (bytes.size() < sizeof header || !bytes.starts_with("HAIR"))
    throw InputError(fmt::format("{}: no HAIR file: it must begin with HAIR and a header of {} bytes", name,
                                 sizeof header));
  std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof header);
  if (header.arrays & hair::has_segments) header.segments = 0;  // unused, and may be anything
  if (header.strands < 1 || header.strands > most_strands || header.points > most_points ||
      header.segments > most_points)
    throw InputError(fmt::format(
        "{}: the header says {} strands of {} points together; 1 to {} strands of at most {} points are read",
        name, header.strands, header.points, most_strands, most_points));
  if (!(header.arrays & hair::has_points))
    throw InputError(fmt::format("{}: the file has no points (bit 1 of the header's byte 12)", name));
  Arrays arrays(bytes, name);
  Polylines lines;
  lines.count = counts_of(header, arrays, name);
  const std::size_t points = header.points;
  const auto most = float(largest_coordinate);
  lines.point = arrays.next<glm::vec3>(points, "points");
  need_values(lines.point, -most, most, "a coordinate", name);
  if (header.arrays & hair::has_widths)
    lines.width = arrays.next<float>(points, "widths");
  else if (header.width != 0)
    lines.width.assign(points, header.width);
  need_values(lines.width, 0, most, "the width", name);
  bool see_through = header.transparency != 0;
  if (header.arrays & hair::has_transparencies)
    for (const float value : arrays.next<float>(points, "transparencies")) see_through |= value != 0;
  if (see_through) lines.notes.emplace_back("its transparencies are not used; strands.opacity is");
  const glm::vec3 colour(header.colour[0], header.colour[1], header.colour[2]);
  if (header.arrays & hair::has_colours)
    lines.colour = arrays.next<glm::vec3>(points, "colours");
  else if (colour != glm::vec3(0))
    lines.colour.assign(points, colour);
  need_values(lines.colour, 0, 1, "a colour", name);
  if (arrays.rest() > 0)
    lines.notes.push_back(fmt::format("{} bytes behind its end are not read", arrays.rest()));
  return lines;
}

Polylines parse_lines(std::string_view bytes, const std::string& name) {
  const Soup soup = detail::read_obj_lines(detail::text_of(bytes, name), name);
  Polylines lines;
  std::uint64_t points = 0;
  for (const auto& line : soup.polygon) points += line.size();
  if (soup.polygon.size() > most_strands || points > most_points)
    throw InputError(fmt::format("{}: {} lines of {} points together; at most {} lines of {} points are read",
                                 name, soup.polygon.size(), points, most_strands, most_points));
  for (const auto& line : soup.polygon) {
    lines.count.push_back(std::uint32_t(line.size()));
    for (const std::uint32_t i : line) lines.point.emplace_back(soup.point[i]);
  }
  need_values(lines.point, -float(largest_coordinate), float(largest_coordinate), "a coordinate", name);
  return lines;
}

/// Merges equal points that follow each other, and leaves out polylines of one point.
Polylines without_copies(const Polylines& lines, const std::string& name) {
  Polylines kept;
  kept.notes = lines.notes;
  std::size_t first = 0, merged = 0, single = 0;
  for (const std::uint32_t count : lines.count) {
    std::vector<std::size_t> points;
    for (std::size_t i = first; i < first + count; ++i)
      if (points.empty() || lines.point[i] != lines.point[points.back()]) points.push_back(i);
    first += count;
    if (points.size() < 2) {
      ++single;
      continue;
    }
    merged += count - points.size();
    kept.count.push_back(std::uint32_t(points.size()));
    for (const std::size_t i : points) {
      kept.point.push_back(lines.point[i]);
      if (!lines.width.empty()) kept.width.push_back(lines.width[i]);
      if (!lines.colour.empty()) kept.colour.push_back(lines.colour[i]);
    }
  }
  if (kept.count.empty()) throw InputError(fmt::format("{}: no strand has two different points", name));
  if (merged > 0)
    kept.notes.push_back(fmt::format("points that repeat the point before are left out: {}", merged));
  if (single > 0) kept.notes.push_back(fmt::format("strands of one point are left out: {}", single));
  return kept;
}

}  // namespace

Polylines parse_polylines(std::string_view bytes, std::string_view format, const std::string& name) {
  return without_copies(format == "hair" ? parse_hair(bytes, name) : parse_lines(bytes, name), name);
}

Polylines read_polylines(const std::filesystem::path& file) {
  const std::string format = ending_of(file);
  if (format != "hair" && format != "obj")
    throw InputError(fmt::format("{}: strands are read from .hair and .obj", file.string()));
  return parse_polylines(read_bytes(file, largest_mesh_file), format, file.string());
}

}  // namespace pelage
