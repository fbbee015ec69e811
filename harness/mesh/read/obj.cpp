#include <array>
#include <cctype>
#include <limits>

#include "harness/mesh/read/formats.hpp"
#include "harness/mesh/read/text.hpp"

namespace pelage::detail {
namespace {

/// The largest index of a file, and where it stands.
struct Largest {
  std::int64_t index = 0;
  std::size_t line = 0;
  void add(std::int64_t other, std::size_t at) {
    if (other > index) index = other, line = at;
  }
};

class Obj {
 public:
  Obj(std::string_view bytes, const std::string& name, bool with_uv, bool wants_lines = false)
      : lines_(bytes), name_(name), with_uv_(with_uv), wants_lines_(wants_lines) {}

  Soup read() {
    while (next()) {
      Words words(line_);
      std::string element(words.next());
      for (char& c : element) c = char(std::tolower(static_cast<unsigned char>(c)));
      if (element == "v") read_point();
      if (element == "vt" && with_uv_) {
        const double u = uv_number(words.next(), name_, lines_.number());
        const std::string_view v = words.next();
        uv_.emplace_back(u, v.empty() ? 0 : uv_number(v, name_, lines_.number()));
      }
      if (wants_lines_ ? element == "l" : element == "f" || element == "fo") read_polygon(words);
    }
    if (soup_.polygon.empty())
      fail(name_, 0, wants_lines_ ? "the file contains no lines (l)" : "the file contains no faces");
    need(points_, std::int64_t(soup_.point.size()), "vertex {} is out of range; there are {} vertices");
    need(coordinates_, std::int64_t(uv_.size()),
         "texture coordinate {} is out of range; there are {} texture coordinates");
    set_uv();
    return std::move(soup_);
  }

 private:
  /// Reads the next line without its comment. A backslash at its end continues it.
  bool next() {
    std::string_view line;
    if (!lines_.next(line)) return false;
    line_ = line.substr(0, line.find('#'));
    while (line_.ends_with('\\') && lines_.next(line)) {
      if (joined_.data() != line_.data()) joined_ = line_;
      joined_.back() = ' ';
      joined_ += line.substr(0, line.find('#'));
      line_ = joined_;
    }
    return true;
  }

  /// x y z, with a weight w by which the three are divided, or with a colour.
  void read_point() {
    Words words(line_);
    words.next();
    const glm::dvec3 p = point(words, name_, lines_.number());
    const std::string_view fourth = words.next(), fifth = words.next();
    soup_.point.push_back(p);
    if (fourth.empty() || !fifth.empty()) return;
    const double w = coordinate(fourth, name_, lines_.number());
    if (w == 0) fail(name_, lines_.number(), "the weight of a vertex is 0");
    soup_.point.back() /= w;
  }

  std::int64_t index(std::string_view word, std::int64_t count, std::string_view what) const {
    const auto found = detail::read<std::int64_t>(word);
    if (!found || *found == 0 || *found < -count)
      fail(name_, lines_.number(), fmt::format("{} is not a {}; indices start at 1", shown(word), what));
    return *found > 0 ? *found : count + 1 + *found;
  }

  /// The corners of a face or of a line.
  void read_polygon(Words& words) {
    auto& polygon = soup_.polygon.emplace_back();
    auto& corners = corner_uv_.emplace_back();
    for (std::string_view word; !(word = words.next()).empty();) {
      const std::size_t slash = std::min(word.find('/'), word.size());
      const std::int64_t own = index(word.substr(0, slash), std::int64_t(soup_.point.size()), "vertex");
      points_.add(own, lines_.number());
      polygon.push_back(stored(own));
      if (!with_uv_ || slash == word.size()) continue;
      word.remove_prefix(slash + 1);
      word = word.substr(0, word.find('/'));
      if (word.empty()) continue;
      const std::int64_t uv = index(word, std::int64_t(uv_.size()), "texture coordinate");
      coordinates_.add(uv, lines_.number());
      corners.push_back(stored(uv));
    }
    if (polygon.size() < (wants_lines_ ? 2 : 3))
      fail(name_, lines_.number(),
           fmt::format("a {} of {} corners; give at least {}", wants_lines_ ? "line" : "face", polygon.size(),
                       wants_lines_ ? "two" : "three"));
    if (!corners.empty() && corners.size() != polygon.size())
      fail(name_, lines_.number(), "only some corners of the face have texture coordinates");
  }

  /// Too large indices are refused later, when the number of points is known.
  static std::uint32_t stored(std::int64_t index) {
    return std::uint32_t(std::min<std::int64_t>(index - 1, std::numeric_limits<std::uint32_t>::max()));
  }

  void need(const Largest& largest, std::int64_t count,
            fmt::format_string<std::int64_t&, std::int64_t&> text) const {
    std::int64_t index = largest.index;
    if (index > count) fail(name_, largest.line, fmt::format(text, index, count));
  }

  void set_uv() {
    if (std::ranges::all_of(corner_uv_, [](const auto& corners) { return corners.empty(); })) return;
    for (const auto& corners : corner_uv_) {
      auto& uv = soup_.uv.emplace_back();
      for (const std::uint32_t i : corners) uv.push_back(uv_[i]);
    }
  }

  Lines lines_;
  const std::string& name_;
  bool with_uv_, wants_lines_;
  std::string_view line_;
  std::string joined_;  ///< a line that was continued
  Soup soup_;
  std::vector<glm::dvec2> uv_;
  std::vector<std::vector<std::uint32_t>> corner_uv_;  ///< of each face
  Largest points_, coordinates_;
};

}  // namespace

Soup read_obj(std::string_view bytes, const std::string& name, bool with_uv) {
  need_text(bytes, "OBJ", name);
  return Obj(bytes, name, with_uv).read();
}

Soup read_obj_lines(std::string_view bytes, const std::string& name) {
  need_text(bytes, "OBJ", name);
  return Obj(bytes, name, false, true).read();
}

}  // namespace pelage::detail
