// Numbers in texts: decimal numbers, and picture sizes such as "800x600".
#pragma once
#include <optional>
#include <string_view>

namespace pelage {

struct Size {
  int width = 0, height = 0;
};

/// Returns the size that the text WIDTHxHEIGHT gives: two numbers of one to nine digits. Returns nothing for
/// other texts.
std::optional<Size> size_from_text(std::string_view text);

/// Returns the number if the whole text is one, as std::from_chars reads it.
std::optional<double> double_of(std::string_view text);

/// Returns the value of a text that is a finite decimal number. For a picture size, returns the number of
/// pixels. Returns nothing for other texts.
std::optional<double> number_of(std::string_view text);

}  // namespace pelage
