// Limits the number of parts of the keys in TOML files. toml++ limits the nesting of values but not the
// number of parts of a dotted key, and a key with thousands of parts overflows the stack.
#pragma once
#include <string>
#include <string_view>

#include "harness/error.hpp"

namespace pelage {

inline constexpr int most_key_parts = 32;

/// Throws InputError if a line of the TOML text has a dotted key, or a table name, with more than
/// most_key_parts parts. The message calls the text `name`.
inline void refuse_deep_keys(std::string_view text, const std::string& name) {
  int line_number = 0;
  while (!text.empty()) {
    ++line_number;
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(line.size() < text.size() ? line.size() + 1 : line.size());
    int parts = 1;
    char quote = 0;
    for (const char c : line) {
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '=' || c == ',' || c == '#' || c == '{') {
        break;  // The key ends here. A line with a comma before any '=' belongs to a list of values and has
                // no key.
      } else if (c == '.') {
        ++parts;
      }
    }
    if (parts > most_key_parts)
      throw InputError(name + ":" + std::to_string(line_number) + ": the key has " + std::to_string(parts) +
                       " parts separated by dots; the limit is " + std::to_string(most_key_parts));
  }
}

}  // namespace pelage
