#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <memory>

#include "harness/error.hpp"
#include "harness/mesh/read/soup.hpp"

namespace pelage {
namespace {

[[noreturn]] void damaged(const std::filesystem::path& file) {
  throw InputError(fmt::format("{}: the archive is damaged; install its package again", file.string()));
}

}  // namespace

std::optional<std::string> read_member(const std::filesystem::path& file, const std::string& member) {
  if (!std::filesystem::is_regular_file(file))
    throw InputError(fmt::format("{}: no such file", file.string()));
  const std::unique_ptr<archive, int (*)(archive*)> reader(archive_read_new(), archive_read_free);
  archive_read_support_filter_gzip(reader.get());
  archive_read_support_format_tar(reader.get());
  if (archive_read_open_filename(reader.get(), file.c_str(), 1 << 16) != ARCHIVE_OK) damaged(file);
  archive_entry* entry = nullptr;
  for (;;) {
    // After a warning (ARCHIVE_WARN) the entry is readable. libarchive warns, for instance, if the locale
    // cannot represent the entry's name.
    const int status = archive_read_next_header(reader.get(), &entry);
    if (status == ARCHIVE_EOF) return {};
    if (status < ARCHIVE_WARN) damaged(file);
    const char* name = archive_entry_pathname(entry);
    if (name && name == member) break;
  }
  const std::int64_t size = archive_entry_size(entry);
  if (size > std::int64_t(largest_mesh_file))
    throw InputError(fmt::format("{}: {} is too large", file.string(), member));
  // A damaged header may state a size that is far larger than the file. Therefore memory is allocated only
  // for the bytes that were read.
  std::string bytes, chunk(1 << 16, '\0');
  while (std::int64_t(bytes.size()) < size) {
    const la_ssize_t count = archive_read_data(reader.get(), chunk.data(), chunk.size());
    if (count <= 0) damaged(file);
    bytes.append(chunk.data(), std::size_t(count));
  }
  return bytes;
}

}  // namespace pelage
