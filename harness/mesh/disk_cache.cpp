#include "harness/mesh/disk_cache.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include "harness/atomic_file.hpp"
#include "harness/hash.hpp"

namespace pelage {
namespace {

/// FNV-1a over words of 8 bytes in four interleaved sequences, which is 20 times as fast as over single
/// bytes.
std::uint64_t checksum(std::string_view bytes) {
  constexpr std::uint64_t prime = 0x100000001b3u;
  std::array<std::uint64_t, 4> sums{1, 2, 3, 4};
  constexpr std::size_t block = sizeof sums;
  std::array<std::uint64_t, 4> words;
  std::size_t at = 0;
  for (; at + block <= bytes.size(); at += block) {
    std::memcpy(words.data(), bytes.data() + at, block);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] = (sums[i] ^ words[i]) * prime;
      sums[i] ^= sums[i] >> 32;  // a product never moves high bits down
    }
  }
  Hash hash;
  for (const std::uint64_t sum : sums) hash.number(sum);
  return hash.bytes(bytes.data() + at, bytes.size() - at).value();
}

}  // namespace

std::filesystem::path cache_folder() {
  if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder && *folder)
    return std::filesystem::path(folder) / "pelage";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".cache" / "pelage";
  return temporary_folder() / "pelage-cache";
}

std::string Writer::sealed(std::string_view title) {
  out_.insert(0, title);
  value(checksum(out_));
  return std::move(out_);
}

std::optional<std::string_view> unsealed(std::string_view bytes, std::string_view title) {
  std::uint64_t sum;
  if (bytes.size() < title.size() + sizeof sum || !bytes.starts_with(title)) return {};
  std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
  bytes.remove_suffix(sizeof sum);
  if (checksum(bytes) != sum) return {};
  return bytes.substr(title.size());
}

std::optional<std::string> read_cache_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) return {};
  std::string bytes(size, '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in.read(bytes.data(), std::streamsize(size))) return {};
  std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
  return bytes;
}

bool write_cache_file(const std::filesystem::path& file, std::string_view bytes) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  std::string beside = file.string() + ".XXXXXX";
  const int out = ::mkostemp(beside.data(), O_CLOEXEC);
  if (out == -1) return false;
  std::FILE* const stream = ::fdopen(out, "wb");
  const bool written = stream && std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size() &&
                       std::fflush(stream) == 0 && ::fchmod(out, 0644) == 0 && ::fsync(out) == 0;
  const bool kept = (stream ? std::fclose(stream) : ::close(out)) == 0 && written &&
                    ::rename(beside.c_str(), file.c_str()) == 0;
  if (!kept) ::unlink(beside.c_str());
  return kept;
}

void trim_cache(const std::filesystem::path& folder, std::uintmax_t most) {
  struct Kept {
    std::filesystem::file_time_type used;
    std::uintmax_t size;
    std::filesystem::path path;
  };
  std::vector<Kept> files;
  std::uintmax_t total = 0;
  std::error_code error;
  // Other processes may remove files at the same time; files that no longer exist are skipped.
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code gone;
    const Kept file{entry->last_write_time(gone), entry->file_size(gone), entry->path()};
    if (gone) continue;
    total += file.size;
    files.push_back(file);
  }
  std::ranges::sort(files, {}, &Kept::used);
  for (const Kept& file : files) {
    if (total <= most) break;
    if (std::filesystem::remove(file.path, error)) total -= file.size;
  }
}

}  // namespace pelage
