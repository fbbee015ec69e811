// A hash of the content of a file.
#pragma once
#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "harness/hash.hpp"

namespace pelage {

/// Returns the hash of the file's content as 16 hexadecimal digits, or "" if the file cannot be read.
inline std::string hash_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  Hash hash;
  std::array<char, 1 << 16> block{};
  while (stream.read(block.data(), std::streamsize(block.size())) || stream.gcount() > 0)
    hash.bytes(block.data(), std::size_t(stream.gcount()));
  return stream.bad() ? std::string() : hash.hex();
}

}  // namespace pelage
