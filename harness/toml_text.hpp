// Checks TOML text before toml++ reads it. toml++ limits the nesting of values but not the number of parts of
// a dotted key, and a key with several hundred thousand parts overflows the stack. The
// behaviour of toml++ is undefined for some non-ASCII characters outside quotes. It is also undefined for
// some non-ASCII characters in a string if a backslash continues the string on the next line.
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

/// Returns true if the first visible character after a backslash is not ASCII. `text` is a string with its
/// double quotes. A backslash at the end of a line continues the string on the next line, and TOML skips the
/// spaces and line breaks after it.
inline bool continues_without_ascii(std::string_view text) {
  for (std::size_t i = text.find('\\'); i < text.size(); i = text.find('\\', i)) {
    const std::size_t next = text.find_first_not_of(" \t\r\n", i + 1);
    if (next < text.size() && static_cast<unsigned char>(text[next]) > 127) return true;
    i += 2;  // skips the escaped character, which may be a backslash
  }
  return false;
}

/// Reads TOML text character by character, to know whether a character belongs to a key or to a value.
class TomlScanner {
 public:
  TomlScanner(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  void scan() {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    for (std::size_t i = text_.starts_with(byte_order_mark) ? 3 : 0; i < text_.size();) {
      const char c = text_[i];
      if (c == '"' || c == '\'')
        i = scan_string(i);
      else if (c == '#')
        i = std::min(text_.find('\n', i), text_.size());
      else
        scan_character(c), ++i;
    }
    end_key();
  }

 private:
  /// An open bracket.
  struct Outer {
    int parts = 1;         ///< number of parts of the key that encloses the bracket
    bool in_value = true;  ///< true: the bracket is in a value; false: in the name of a table
    bool brace = false;    ///< true: the bracket is {; false: [
  };

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(name_ + ":" + std::to_string(line_) + ": " + what);
  }

  bool follows(std::string_view characters) const {
    return characters.find(before_) != std::string_view::npos;
  }

  std::size_t scan_string(std::size_t start) {
    if (!follows("\n=,[{.") || (before_ == '.' && in_value_))
      refuse("not TOML: a string must not follow another value without a comma");
    before_ = text_[start];
    const std::size_t end = behind_string(text_, start);
    if (before_ == '"' && continues_without_ascii(text_.substr(start, end - start)))
      refuse(
          "not TOML that pelage reads: in a string, the first character after a backslash or after a continued line is not ASCII");
    line_ +=
        int(std::count(text_.begin() + std::ptrdiff_t(start), text_.begin() + std::ptrdiff_t(end), '\n'));
    return end;
  }

  void scan_character(char c) {
    if (static_cast<unsigned char>(c) > 127)
      refuse("not TOML: a character outside quotes is not ASCII; write names with such characters in quotes");
    if (c == '.') ++parts_;
    if (c == '=') {
      if (in_value_) refuse("not TOML: a value contains the character =; quote a string");
      in_value_ = true;
    } else if (c == '{' || c == '[') {
      open(c);
    } else if (c == '}' || c == ']') {
      close();
    } else if (c == ',' || c == '\n') {
      end_key();
      parts_ = 1;
      line_ += c == '\n';
      if (outer_.empty() ? c == '\n' : outer_.back().brace) in_value_ = false;
    }
    if (c != ' ' && c != '\t' && c != '\r') before_ = c;
  }

  void open(char c) {
    if (!follows("\n=,["))
      refuse(std::string("not TOML: the character ") + c + " must not follow another value without a comma");
    end_key();
    outer_.push_back({parts_, in_value_, c == '{'});
    around_ += parts_;
    parts_ = 1;
    if (c == '{') in_value_ = false;
  }

  void close() {
    end_key();
    if (!outer_.empty()) {
      around_ -= outer_.back().parts;
      in_value_ = outer_.back().in_value;
      outer_.pop_back();
    }
    parts_ = 1;
  }

  /// Checks the number of parts of the key that ends.
  void end_key() const {
    const auto too_many = [&](const char* what, int count, int limit) {
      refuse(std::string("the key ") + what + std::to_string(count) +
             " parts separated by dots; the limit is " + std::to_string(limit));
    };
    if (parts_ > most_key_parts) too_many("has ", parts_, most_key_parts);
    if (parts_ > 1 && around_ + parts_ > most_table_depth)
      too_many("and the keys that enclose it have ", around_ + parts_, most_table_depth);
  }

  std::string_view text_;
  const std::string& name_;
  int line_ = 1, parts_ = 1, around_ = 0;  // around_: sum of `parts` of outer_
  bool in_value_ = false;
  char before_ = '\n';  // the last character that is no space, tab or carriage return
  std::vector<Outer> outer_;
};

}  // namespace detail

/// Throws InputError in these cases:
/// - a dotted key or the name of a table has more than most_key_parts parts;
/// - a key in nested inline tables, together with the keys of these tables, has more than most_table_depth
///   parts;
/// - a character outside quotes and comments is not ASCII;
/// - in a string with double quotes, a character that is not ASCII follows a backslash, or follows the spaces
///   and the line breaks after a backslash;
/// - an opening quote or bracket follows a character that cannot precede it, such as the 0 in
///   `key = 0"text"`, or a value contains the character =. toml++ would read the string as a part of the
///   number, which is undefined behaviour in toml++.
/// The message begins with `name`, the name of the file or option that contains the text.
inline void check_toml_text(std::string_view text, const std::string& name) {
  detail::TomlScanner(text, name).scan();
}

}  // namespace pelage
