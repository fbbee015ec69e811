// SHA-256 (FIPS 180-4). The page's Content-Security-Policy names its scripts by this hash.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace pelage {

std::array<std::uint8_t, 32> sha256(std::string_view bytes);

/// Returns the bytes as Base64 (RFC 4648), with padding.
std::string base64(std::string_view bytes);

}  // namespace pelage
