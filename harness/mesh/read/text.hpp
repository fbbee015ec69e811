// Reads words, lines and numbers from the text of mesh files.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "harness/error.hpp"
#include "harness/mesh/read/soup.hpp"

namespace pelage::detail {

/// Throws InputError. The message consists of the file's name, the line's number and `what`. `line` is the
/// number of the faulty line in the file `name`, or 0 if it is unknown.
[[noreturn]] inline void fail(const std::string& name, std::size_t line, const std::string& what) {
  throw InputError(line ? fmt::format("{}:{}: {}", name, line, what) : fmt::format("{}: {}", name, what));
}

/// Splits a line into words, which any white space separates.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}
  std::string_view next() {
    constexpr std::string_view space = " \t\v\f\r\n";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(space), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(space));
    rest_.remove_prefix(word.size());
    return word;
  }

 private:
  std::string_view rest_;
};

/// Returns the lines of a text one after the other. A line ends with LF, CR LF or CR.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + (rest_.substr(end).starts_with("\r\n") ? 2 : 1), rest_.size()));
    ++number_;
    return true;
  }
  std::size_t number() const { return number_; }   ///< of the last line, from 1
  std::string_view rest() const { return rest_; }  ///< the text after this line

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// Converts the word to a number. Returns an empty result if the word is not a number.
template <class T>
std::optional<T> read(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return {};
  if constexpr (std::is_floating_point_v<T>)
    if (error == std::errc::result_out_of_range && word.find("e-") != word.npos) return T(0);
  if (error != std::errc()) return {};
  return value;
}

/// Returns the first 24 characters of `word`, enclosed in quotes, for error messages.
inline std::string shown(std::string_view word) {
  std::string text;
  for (const char c : word.substr(0, 24)) text += c >= ' ' && c <= '~' ? c : '?';
  return text.empty() ? "nothing" : "'" + text + "'";
}

/// Reads a coordinate of a point. Throws InputError if the word is none.
inline double coordinate(std::string_view word, const std::string& name, std::size_t line) {
  const auto number = read<double>(word);
  if (!number || !(std::abs(*number) <= largest_coordinate))
    fail(name, line,
         fmt::format("found {}, but a vertex needs three numbers from {} to {}", shown(word),
                     -largest_coordinate, largest_coordinate));
  return *number;
}

inline glm::dvec3 point(Words& words, const std::string& name, std::size_t line) {
  const double x = coordinate(words.next(), name, line), y = coordinate(words.next(), name, line);
  return {x, y, coordinate(words.next(), name, line)};
}

/// Reads a number of a UV position. Throws InputError if the word is none.
inline double uv_number(std::string_view word, const std::string& name, std::size_t line) {
  const auto number = read<double>(word);
  if (!number || !(std::abs(*number) <= largest_coordinate))
    fail(name, line, fmt::format("found {}, but a texture coordinate needs numbers", shown(word)));
  return *number;
}

/// Throws InputError if the bytes are no text in the format, such as "OBJ".
inline void need_text(std::string_view bytes, std::string_view format, const std::string& name) {
  if (bytes.find('\0') != std::string_view::npos)
    fail(name, 0, fmt::format("binary data, not {} text", format));
}

}  // namespace pelage::detail
