// Values of TOML files as text.
#pragma once
#include <toml++/toml.h>

#include <string>

namespace pelage {

/// Returns the value as TOML text. Decimal numbers have as few digits as possible: 0.05, not
/// 0.050000000000000003.
std::string literal(const toml::node& node);

/// Returns the text of a TOML value, without quotes if it is a string.
std::string plain(const toml::node& node);

}  // namespace pelage
