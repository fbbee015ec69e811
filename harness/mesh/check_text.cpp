// Checks the text of mesh files and reports errors with their line numbers. The checks run before CGAL's
// readers, because these readers stop at the first unreadable text without reporting an error, and do not
// check the counts in a header.
#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "harness/mesh/mesh_text.hpp"
#include "harness/mesh/soup.hpp"

namespace pelage::detail {
namespace {

void need_point(Words& words, const std::string& name, std::size_t line) {
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = words.next();
    const auto number = read<double>(word);
    if (!number || !(std::abs(*number) <= largest_coordinate))
      fail(name, line,
           fmt::format("found {}, but a vertex needs three numbers from {} to {}", shown(word),
                       -largest_coordinate, largest_coordinate));
  }
}

void no_binary(std::string_view bytes, std::string_view format, const std::string& name) {
  if (bytes.find('\0') != std::string_view::npos)
    fail(name, 0, fmt::format("binary data, not {} text", format));
}

// Checks the v and f lines of an OBJ file and returns them. All other lines are dropped.
std::string check_obj(std::string_view bytes, const std::string& name) {
  no_binary(bytes, "OBJ", name);
  std::string kept;
  std::int64_t vertices = 0, largest = 0;
  std::size_t largest_line = 0, faces = 0;
  Lines lines(bytes);
  for (std::string_view line; lines.next(line);) {
    Words words(line.substr(0, line.find('#')));
    const std::string_view element = words.next();
    if (element == "v") {
      need_point(words, name, lines.number());
      ++vertices;
    } else if (element == "f") {
      ++faces;
      int corners = 0;
      for (std::string_view word; !(word = words.next()).empty(); ++corners) {
        const auto index = read<std::int64_t>(word.substr(0, word.find('/')));
        if (!index || *index == 0 || *index < -vertices)
          fail(name, lines.number(), fmt::format("{} is not a vertex; indices start at 1", shown(word)));
        if (*index > largest) largest = *index, largest_line = lines.number();
      }
      if (corners < 3)
        fail(name, lines.number(), fmt::format("a face of {} corners; give at least three", corners));
    } else {
      continue;
    }
    // CGAL's reader separates the corners of a face only at spaces.
    words = Words(line.substr(0, line.find('#')));
    for (std::string_view word; !(word = words.next()).empty();) kept.append(word).push_back(' ');
    kept.back() = '\n';
  }
  if (largest > vertices)
    fail(name, largest_line,
         fmt::format("vertex {} is out of range; there are {} vertices", largest, vertices));
  if (faces == 0) fail(name, 0, "the file contains no faces");
  return kept;
}

// Checks an OFF file, which must have one vertex or one face per line. Returns an OFF file that contains only
// the points and faces. Normals, comments and colours are removed. Colours are removed because CGAL converts
// any number to an 8-bit colour without a check.
std::string check_off(std::string_view bytes, const std::string& name) {
  no_binary(bytes, "OFF", name);
  std::string kept;
  Lines lines(bytes);
  std::string_view line;
  const auto next = [&](const std::string& wanted) {
    while (lines.next(line)) {
      line = line.substr(0, line.find('#'));
      if (!Words(line).next().empty()) return;
    }
    fail(name, lines.number(), fmt::format("the file ends before {}", wanted));
  };
  next("OFF");
  Words head(line);
  const std::string_view word = head.next();
  if (!word.ends_with("OFF")) fail(name, lines.number(), fmt::format("found {} instead of OFF", shown(word)));
  if (word != "OFF" && word != "COFF" && word != "NOFF" && word != "CNOFF")
    fail(name, lines.number(), fmt::format("{}: only OFF, COFF and NOFF are read", shown(word)));
  std::string_view count = head.next();
  if (count == "BINARY") fail(name, lines.number(), "binary OFF is not read; save it as text");
  if (count.empty()) {
    next("the counts of vertices and faces");
    head = Words(line);
    count = head.next();
  }
  const auto vertices = read<std::int64_t>(count), faces = read<std::int64_t>(head.next());
  // Without its newline, a vertex takes at least five bytes of text ("0 0 0"), and a triangle at least seven
  // ("3 0 1 2"). The size of the file therefore limits the counts in the header.
  const auto size = std::int64_t(bytes.size());
  if (!vertices || !faces || *vertices < 0 || *faces < 0)
    fail(name, lines.number(), "the counts of vertices and faces are missing or invalid");
  if (*vertices == 0 || *faces == 0) fail(name, lines.number(), "the file contains no faces");
  if (*vertices > size / 5 + 1 || *faces > size / 7 + 1)
    fail(name, lines.number(),
         fmt::format("{} vertices and {} faces do not fit into {} bytes", *vertices, *faces, size));
  kept = fmt::format("OFF\n{} {} 0\n", *vertices, *faces);
  for (std::int64_t i = 0; i < *vertices; ++i) {
    next(fmt::format("vertex {} of {}", i + 1, *vertices));
    Words words(line);
    need_point(words, name, lines.number());
    kept.append(line.substr(0, line.size() - words.rest().size())).push_back('\n');
  }
  for (std::int64_t i = 0; i < *faces; ++i) {
    next(fmt::format("face {} of {}", i + 1, *faces));
    Words words(line);
    const std::string_view first = words.next();
    const auto corners = read<std::int64_t>(first);
    if (!corners || *corners < 1)
      fail(name, lines.number(),
           fmt::format("a face cannot have {} corners; give a whole number of at least 1", shown(first)));
    for (std::int64_t k = 0; k < *corners; ++k) {
      const std::string_view corner = words.next();
      const auto index = read<std::int64_t>(corner);
      if (!index || *index < 0 || *index >= *vertices)
        fail(name, lines.number(),
             fmt::format("{} is not a vertex; give 0 to {}", shown(corner), *vertices - 1));
    }
    kept.append(line.substr(0, line.size() - words.rest().size())).push_back('\n');
  }
  return kept;
}

// Checks the vertices and the end of a text STL file. Checks that a binary STL file is large enough for its
// number of triangles.
void check_stl(std::string_view bytes, const std::string& name) {
  const bool text = bytes.starts_with("solid") && bytes.find("facet") != std::string_view::npos;
  if (text) {
    Lines lines(bytes);
    bool ended = false;
    for (std::string_view line; lines.next(line);) {
      Words words(line);
      const std::string_view element = words.next();
      if (element == "vertex") need_point(words, name, lines.number());
      if (element == "endsolid") ended = true;
    }
    if (!ended) fail(name, lines.number(), "the file ends before endsolid");
    return;
  }
  if (bytes.size() < 84)
    fail(name, 0, "the file is not STL text, and it is shorter than the 84 bytes of a binary STL header");
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  if (count == 0) fail(name, 0, "the file contains no faces");
  if (bytes.size() < 84 + 50 * std::uint64_t(count))
    fail(name, 0,
         fmt::format("{} triangles need {} bytes, the file has {}", count, 84 + 50 * std::uint64_t(count),
                     bytes.size()));
}

}  // namespace

void check_text(std::string& bytes, std::string_view format, const std::string& name) {
  if (format == "obj") bytes = check_obj(bytes, name);
  if (format == "off") bytes = check_off(bytes, name);
  if (format == "ply") bytes = check_ply(bytes, name);
  if (format == "stl") check_stl(bytes, name);
}

}  // namespace pelage::detail
