// What is worth keeping on disk between runs: one file each, named by what it was made from, with a checksum.
#pragma once
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace pelage {

/// $XDG_CACHE_HOME/pelage, else ~/.cache/pelage, else a folder among the temporary files.
std::filesystem::path cache_folder();

/// Values one after another as bytes, as this machine has them.
class Writer {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void value(const T& item) { out_.append(reinterpret_cast<const char*>(&item), sizeof item); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void list(const std::vector<T>& items) {
    value(std::uint64_t(items.size()));
    out_.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
  }
  void text(const std::string& item) {
    value(std::uint64_t(item.size()));
    out_ += item;
  }
  /// What was written under a title, with its checksum. The writer is empty afterwards.
  std::string sealed(std::string_view title);

 private:
  std::string out_;
};

/// Reads back what a Writer wrote; every read says whether the bytes sufficed.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  bool value(T& item) {
    return take(&item, sizeof item);
  }
  template <class T>
  bool list(std::vector<T>& items) {
    std::uint64_t count = 0;
    if (!value(count) || count > rest_.size() / sizeof(T)) return false;
    items.resize(count);
    return take(items.data(), count * sizeof(T));
  }
  bool text(std::string& item) {
    std::uint64_t count = 0;
    if (!value(count) || count > rest_.size()) return false;
    item.resize(count);
    return take(item.data(), count);
  }
  bool done() const { return rest_.empty(); }

 private:
  bool take(void* target, std::size_t size) {
    if (size > rest_.size()) return false;
    if (size > 0) std::memcpy(target, rest_.data(), size);
    rest_.remove_prefix(size);
    return true;
  }
  std::string_view rest_;
};

/// What was sealed under this title; empty when the bytes are not exactly that: torn, damaged or of another
/// version.
std::optional<std::string_view> unsealed(std::string_view bytes, std::string_view title);

/// The file's bytes; empty when there is none.
std::optional<std::string> read_cache_file(const std::filesystem::path& file);

/// Written beside and moved into place, so that no reader ever sees half of it. False when that was not
/// possible (a full disk, a read-only folder).
bool write_cache_file(const std::filesystem::path& file, std::string_view bytes);

/// Removes the files of a folder that were not used for longest until `most` bytes are left. Reading a file
/// by read_cache_file is use.
void trim_cache(const std::filesystem::path& folder, std::uintmax_t most);

}  // namespace pelage
