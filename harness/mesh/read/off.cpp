#include <utility>

#include "harness/mesh/read/formats.hpp"
#include "harness/mesh/read/text.hpp"

namespace pelage::detail {
namespace {

/// The parts of a vertex that the prefixes of the word OFF name: [ST][C][N].
struct Prefixes {
  bool uv = false, colour = false, normal = false;
};

/// Reads the words of a file without comments. If the file has a line for each vertex and face, the rest of
/// such a line, for instance a colour, is passed over. Otherwise the words must be exactly those of the
/// vertices and faces.
class Off {
 public:
  Off(std::string_view bytes, const std::string& name, bool with_uv)
      : lines_(bytes), size_(std::int64_t(bytes.size())), name_(name), with_uv_(with_uv) {}

  Soup read() {
    const Prefixes has = read_keyword();
    std::string_view word = words_.next();
    if (word == "BINARY") fail("binary OFF is not read; save it as text");
    if (word.empty()) word = next("the counts of vertices and faces");
    const auto vertices = detail::read<std::int64_t>(word), faces = detail::read<std::int64_t>(words_.next());
    if (!vertices || !faces || *vertices < 0 || *faces < 0)
      fail("the counts of vertices and faces are missing or invalid");
    if (*vertices == 0 || *faces == 0) fail("the file contains no faces");
    // Without its newline, a vertex takes at least five bytes of text ("0 0 0"), and a triangle at least
    // seven ("3 0 1 2"). The size of the file therefore limits the counts in the header.
    if (*vertices > size_ / 5 + 1 || *faces > size_ / 7 + 1)
      fail(fmt::format("{} vertices and {} faces do not fit into {} bytes", *vertices, *faces, size_));
    words_.next();  // the count of edges
    own_lines_ = lines_left() >= *vertices + *faces;
    if (!own_lines_ && has.colour) fail("a vertex with a colour needs a line of its own");
    for (std::int64_t i = 0; i < *vertices; ++i)
      read_vertex(has, fmt::format("vertex {} of {}", i + 1, *vertices));
    for (std::int64_t i = 0; i < *faces; ++i) read_face(fmt::format("face {} of {}", i + 1, *faces));
    if (!own_lines_ && !words_.next().empty()) fail("words remain after the last face");
    if (has.uv && with_uv_)
      for (const auto& polygon : soup_.polygon) {
        auto& corners = soup_.uv.emplace_back();
        for (const std::uint32_t i : polygon) corners.push_back(uv_[i]);
      }
    return std::move(soup_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { detail::fail(name_, lines_.number(), what); }

  static std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

  /// Goes to the next line that has a word.
  void next_line(const std::string& wanted) {
    for (std::string_view line; lines_.next(line);) {
      words_ = Words(without_comment(line));
      if (!Words(words_).next().empty()) return;
    }
    fail(fmt::format("the file ends before {}", wanted));
  }

  std::string_view next(const std::string& wanted) {
    std::string_view word = words_.next();
    if (word.empty()) {
      next_line(wanted);
      word = words_.next();
    }
    return word;
  }

  /// Returns the next word of a vertex or face.
  std::string_view word(const std::string& wanted) { return own_lines_ ? words_.next() : next(wanted); }

  std::int64_t lines_left() const {
    Lines lines(lines_.rest());
    std::int64_t count = 0;
    for (std::string_view line; lines.next(line);) count += !Words(without_comment(line)).next().empty();
    return count;
  }

  Prefixes read_keyword() {
    const std::string_view word = next("OFF");
    if (!word.ends_with("OFF")) fail(fmt::format("found {} instead of OFF", shown(word)));
    std::string_view rest = word.substr(0, word.size() - 3);
    const auto take = [&](std::string_view prefix) {
      const bool found = rest.starts_with(prefix);
      if (found) rest.remove_prefix(prefix.size());
      return found;
    };
    Prefixes has;
    has.uv = take("ST");
    has.colour = take("C");
    has.normal = take("N");
    if (!rest.empty()) fail(fmt::format("{}: only OFF with the prefixes ST, C and N is read", shown(word)));
    return has;
  }

  void read_vertex(Prefixes has, const std::string& wanted) {
    if (own_lines_) next_line(wanted);
    double p[3];
    for (double& x : p) x = coordinate(word(wanted), name_, lines_.number());
    soup_.point.emplace_back(p[0], p[1], p[2]);
    if (!own_lines_ && has.normal)
      for (int i = 0; i < 3; ++i) word(wanted);
    if (!has.uv) return;
    std::string_view u = word(wanted), v = word(wanted);  // the last two words of the vertex
    if (own_lines_)
      for (std::string_view more; !(more = words_.next()).empty();) u = std::exchange(v, more);
    if (!with_uv_) return;
    const double first = uv_number(u, name_, lines_.number());
    uv_.emplace_back(first, uv_number(v, name_, lines_.number()));
  }

  void read_face(const std::string& wanted) {
    if (own_lines_) next_line(wanted);
    const std::string_view first = word(wanted);
    const auto corners = detail::read<std::int64_t>(first);
    if (!corners || *corners < 1)
      fail(fmt::format("a face cannot have {} corners; give a whole number of at least 1", shown(first)));
    auto& polygon = soup_.polygon.emplace_back();
    for (std::int64_t k = 0; k < *corners; ++k) {
      const std::string_view corner = word(wanted);
      const auto index = detail::read<std::int64_t>(corner);
      if (!index || *index < 0 || *index >= std::int64_t(soup_.point.size()))
        fail(fmt::format("{} is not a vertex; give 0 to {}", shown(corner), soup_.point.size() - 1));
      polygon.push_back(std::uint32_t(*index));
    }
  }

  Lines lines_;
  std::int64_t size_;
  const std::string& name_;
  bool with_uv_;
  Words words_{""};
  bool own_lines_ = true;  ///< each vertex and each face has a line of its own
  Soup soup_;
  std::vector<glm::dvec2> uv_;  ///< of each vertex, if the file has them
};

}  // namespace

Soup read_off(std::string_view bytes, const std::string& name, bool with_uv) {
  need_text(bytes, "OFF", name);
  return Off(bytes, name, with_uv).read();
}

}  // namespace pelage::detail
