// Functions that read words, lines and numbers from the text of mesh files, to check the files.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "harness/error.hpp"

namespace pelage::detail {

/// Throws InputError. The message consists of the file's name, the line's number and `what`. `line` is the
/// number of the faulty line in the file `name`, or 0 if it is unknown.
[[noreturn]] inline void fail(const std::string& name, std::size_t line, const std::string& what) {
  throw InputError(line ? fmt::format("{}:{}: {}", name, line, what) : fmt::format("{}: {}", name, what));
}

/// Splits a line into words.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}
  std::string_view next() {
    const auto space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    const auto begin = std::find_if_not(rest_.begin(), rest_.end(), space);
    const auto end = std::find_if(begin, rest_.end(), space);
    rest_ = std::string_view(end, rest_.end());
    return std::string_view(begin, end);
  }
  std::string_view rest() const { return rest_; }  ///< the text after the last word that next() returned

 private:
  std::string_view rest_;
};

/// Returns the lines of a text one after the other.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return true;
  }
  std::size_t number() const { return number_; }

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
  if (error != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

/// Returns the first 24 characters of `word`, enclosed in quotes, for error messages.
inline std::string shown(std::string_view word) {
  std::string text;
  for (const char c : word.substr(0, 24)) text += c >= ' ' && c <= '~' ? c : '?';
  return text.empty() ? "nothing" : "'" + text + "'";
}

}  // namespace pelage::detail
