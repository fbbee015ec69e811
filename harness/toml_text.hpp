// Checks TOML text before toml++ reads it. toml++ limits the nesting of values but not the number of parts of
// a dotted key, and a key with several hundred thousand parts overflows the stack. For some non-ASCII
// characters outside quotes, or behind the backslash at the end of a line of a string, the behaviour of
// toml++ is undefined.
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "harness/error.hpp"

namespace pelage {

inline constexpr int most_key_parts = 32;    ///< greatest number of parts of a dotted key or a table name
inline constexpr int most_table_depth = 64;  ///< greatest number of parts of a key and its enclosing keys

namespace detail {

/// Returns the offset of the first character after the string whose opening quote is at `start`. If the
/// closing quotes of a string that begins with three quotes are missing, the string ends at the end of the
/// text. If the closing quote of a string that begins with one quote is missing, the string ends at the end
/// of its line.
inline std::size_t behind_string(std::string_view text, std::size_t start) {
  const char quote = text[start];
  const bool three = text.substr(start, 3) == std::string(3, quote);
  std::size_t i = start + (three ? 3 : 1);
  for (; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (!three && (text[i] == quote || text[i] == '\n')) {
      return text[i] == quote ? i + 1 : i;
    } else if (three && text.substr(i, 3) == std::string(3, quote)) {
      // Up to two quotes before the closing quotes belong to the string: """a""" and """a""""" are both
      // valid.
      for (i += 3; i < text.size() && text[i] == quote;) ++i;
      return i;
    }
  }
  return text.size();
}

/// Returns true if, in the string with double quotes `text`, a character that is not ASCII follows a
/// backslash and any number of spaces and line breaks. A backslash at the end of a line continues the string
/// with the next character that is no space.
inline bool continues_without_ascii(std::string_view text) {
  for (std::size_t i = text.find('\\'); i < text.size(); i = text.find('\\', i)) {
    const std::size_t next = text.find_first_not_of(" \t\r\n", i + 1);
    if (next < text.size() && static_cast<unsigned char>(text[next]) > 127) return true;
    i += 2;  // skips the escaped character, which may be a backslash
  }
  return false;
}

}  // namespace detail

/// Throws InputError in five cases:
/// - a dotted key or the name of a table has more than most_key_parts parts;
/// - a key in nested inline tables, together with the keys of these tables, has more than most_table_depth
///   parts;
/// - a character outside quotes and comments is not ASCII;
/// - in a string with double quotes, a character that is not ASCII follows a backslash, or follows the spaces
///   and the line breaks after a backslash;
/// - an opening quote follows a character that cannot precede a string, such as the 0 in `key = 0"text"`.
///   toml++ would read the string as a part of the number, which is undefined behaviour in toml++.
/// The message begins with `name`, the name of the file or option that contains the text.
inline void check_toml_text(std::string_view text, const std::string& name) {
  int line = 1, parts = 1, around = 0;
  std::vector<int> outer;  // numbers of parts of the keys that enclose the current key; `around` is their sum
  const auto end_key = [&] {
    const auto refuse = [&](const char* what, int count, int limit) {
      throw InputError(name + ":" + std::to_string(line) + ": the key " + what + std::to_string(count) +
                       " parts separated by dots; the limit is " + std::to_string(limit));
    };
    if (parts > most_key_parts) refuse("has ", parts, most_key_parts);
    if (parts > 1 && around + parts > most_table_depth)
      refuse("and the keys that enclose it have ", around + parts, most_table_depth);
  };
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  char before = '\n';  // the last character that is no space, tab or carriage return
  for (std::size_t i = text.starts_with(byte_order_mark) ? 3 : 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      if (std::string_view("\n=,[{.").find(before) == std::string_view::npos)
        throw InputError(name + ":" + std::to_string(line) +
                         ": not TOML: a string must not follow another value without a comma");
      before = c;
      const std::size_t end = detail::behind_string(text, i);
      if (c == '"' && detail::continues_without_ascii(text.substr(i, end - i)))
        throw InputError(
            name + ":" + std::to_string(line) +
            ": not TOML that pelage reads: in a string, the first character after a backslash or "
            "after a continued line is not ASCII");
      for (; i < end; ++i) line += text[i] == '\n';
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (static_cast<unsigned char>(c) > 127)
      throw InputError(
          name + ":" + std::to_string(line) +
          ": not TOML: a character outside quotes is not ASCII; write names with such characters "
          "in quotes");
    if (c != ' ' && c != '\t' && c != '\r') before = c;
    if (c == '.') ++parts;
    if (c == '{' || c == '[') {
      end_key();
      outer.push_back(parts);
      around += parts;
      parts = 1;
    } else if (c == '}' || c == ']') {
      end_key();
      if (!outer.empty()) {
        around -= outer.back();
        outer.pop_back();
      }
      parts = 1;
    } else if (c == ',' || c == '\n') {
      end_key();
      parts = 1;
      line += c == '\n';
    }
    ++i;
  }
  end_key();
}

}  // namespace pelage
