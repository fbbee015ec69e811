#include <cctype>
#include <cstring>
#include <utility>

#include "harness/mesh/read/formats.hpp"
#include "harness/mesh/read/text.hpp"

namespace pelage::detail {
namespace {

constexpr std::size_t header = 84, facet = 50;  // sizes in a binary file, bytes

std::string lower(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Reads the loops of a text file. The words may stand on any lines, but a name ends with its line.
Soup read_text(std::string_view bytes, const std::string& name) {
  need_text(bytes, "STL", name);
  Soup soup;
  Lines lines(bytes);
  bool ended = false;
  std::vector<std::uint32_t> loop;
  for (std::string_view line; lines.next(line);) {
    Words words(line);
    for (std::string element; !(element = lower(words.next())).empty();) {
      if (element == "solid" || element == "endsolid") {
        ended = element == "endsolid";
        break;
      }
      if (element == "vertex") {
        loop.push_back(std::uint32_t(soup.point.size()));
        soup.point.push_back(point(words, name, lines.number()));
      }
      if (element == "endloop") {
        if (loop.size() < 3)
          fail(name, lines.number(), fmt::format("a loop of {} vertices; give at least three", loop.size()));
        soup.polygon.push_back(std::exchange(loop, {}));
      }
    }
  }
  if (!ended || !loop.empty()) fail(name, lines.number(), "the file ends before endsolid");
  return soup;
}

/// Some programs do not know the count when they write the header, and leave 0 or the greatest number there.
Soup read_binary(std::string_view bytes, const std::string& name) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + header - 4, sizeof count);
  const std::uint64_t there = (bytes.size() - header) / facet;
  if ((count == 0 || count == 0xffffffffu) && (bytes.size() - header) % facet == 0)
    count = std::uint32_t(there);
  if (count == 0) fail(name, 0, "the file contains no faces");
  if (count != there)
    fail(name, 0,
         fmt::format("{} triangles need {} bytes, the file has {}", count,
                     header + facet * std::uint64_t(count), bytes.size()));
  Soup soup;
  for (std::uint32_t f = 0; f < count; ++f) {
    float corner[9];  // after the normal, three floats
    std::memcpy(corner, bytes.data() + header + facet * std::size_t(f) + 12, sizeof corner);
    const auto first = std::uint32_t(soup.point.size());
    for (int k = 0; k < 9; k += 3) soup.point.emplace_back(corner[k], corner[k + 1], corner[k + 2]);
    soup.polygon.push_back({first, first + 1, first + 2});
  }
  return soup;
}

}  // namespace

// A binary file may begin with the word of a text file. The size decides: that of a binary file follows from
// its count of triangles.
Soup read_stl(std::string_view bytes, const std::string& name) {
  std::uint32_t count = 0;
  if (bytes.size() >= header) std::memcpy(&count, bytes.data() + header - 4, sizeof count);
  const bool exact =
      bytes.size() >= header && count > 0 && bytes.size() == header + facet * std::uint64_t(count);
  const bool solid = lower(Words(bytes.substr(0, 256)).next()) == "solid";
  if (solid && !exact && bytes.find('\0') == std::string_view::npos) return read_text(bytes, name);
  if (bytes.size() < header)
    fail(name, 0, "the file is not STL text, and it is shorter than the 84 bytes of a binary STL header");
  return read_binary(bytes, name);
}

}  // namespace pelage::detail
