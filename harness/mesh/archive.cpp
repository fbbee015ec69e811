#include "harness/mesh/archive.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <charconv>
#include <cstring>
#include <memory>

#include "harness/error.hpp"

namespace pelage {

std::optional<std::string> read_member(const std::filesystem::path& archive, const std::string& member) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(archive.c_str(), "rb"), gzclose);
  if (!file) throw InputError(fmt::format("{}: no such file", archive.string()));
  const auto fill = [&](char* target, std::size_t size) {
    if (gzread(file.get(), target, unsigned(size)) != int(size))
      throw InputError(
          fmt::format("{}: the archive is damaged; install its package again", archive.string()));
  };
  // Blocks of 512 bytes: a header with name (100 bytes) and octal size (from 124), then the contents, padded.
  std::array<char, 512> header;
  for (;;) {
    const int got = gzread(file.get(), header.data(), header.size());
    if (got == 0 || (got > 0 && header[0] == 0)) return {};
    if (got != int(header.size()))
      throw InputError(fmt::format("{}: the archive is damaged", archive.string()));
    const std::string name(header.data(), strnlen(header.data(), 100));
    std::uint64_t size = 0;
    std::from_chars(header.data() + 124, header.data() + 135, size, 8);
    const std::uint64_t padded = (size + 511) / 512 * 512;
    if (name != member) {
      if (gzseek(file.get(), z_off_t(padded), SEEK_CUR) < 0)
        throw InputError(fmt::format("{}: the archive is damaged", archive.string()));
      continue;
    }
    if (size > (std::uint64_t(1) << 30))
      throw InputError(fmt::format("{}: {} is too large", archive.string(), member));
    std::string bytes(size, '\0');
    fill(bytes.data(), bytes.size());
    return bytes;
  }
}

}  // namespace pelage
