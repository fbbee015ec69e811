#include "harness/picture/module/exr_header.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

#include "harness/error.hpp"

namespace pelage {
namespace {

constexpr std::uint32_t exr_magic = 20000630;
constexpr std::uint32_t several_parts = 0x1000;  // flag in the version field: a header for each part follows

/// Reads an unsigned 32-bit integer, least significant byte first. At the end of the file it returns 0, and
/// the stream is in a failed state.
std::uint32_t read_word(std::istream& stream) {
  std::array<char, 4> bytes{};
  stream.read(bytes.data(), bytes.size());
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    word |= std::uint32_t(static_cast<unsigned char>(bytes[i])) << (8 * i);
  return stream ? word : 0;
}

/// Reads a string that ends with a zero byte.
std::string read_name(std::istream& stream) {
  std::string name;
  std::getline(stream, name, '\0');
  return name;
}

}  // namespace

void require_exr_header(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (read_word(stream) != exr_magic) return;  // OpenEXR says that this is no OpenEXR file
  const bool parts = (read_word(stream) & several_parts) != 0;
  const std::uintmax_t size = std::filesystem::file_size(path);
  // An empty name ends a header. In a file of several parts, a second empty name ends the list of headers.
  for (bool inside = false; stream;) {
    const std::string name = read_name(stream);
    if (name.empty() && stream) {
      if (!parts || !inside) return;
      inside = false;
      continue;
    }
    inside = true;
    read_name(stream);  // the attribute's type
    const std::uint32_t bytes = read_word(stream);
    if (!stream || stream.eof()) break;
    if (bytes > size - static_cast<std::uintmax_t>(stream.tellg())) {
      throw InputError(
          fmt::format("{}: damaged picture: the attribute '{:.32}' states {} bytes, more than the file has",
                      path.string(), name, bytes));
    }
    stream.seekg(bytes, std::ios::cur);
  }
  throw InputError(fmt::format("{}: damaged picture: the file ends inside its header", path.string()));
}

}  // namespace pelage
