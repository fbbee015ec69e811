// Encodes the pictures of the HTML report as Base64.
#pragma once
#include <string>
#include <string_view>

namespace pelage {

/// Returns the bytes as Base64 (RFC 4648), with padding.
std::string base64(std::string_view bytes);

}  // namespace pelage
