// A cache on disk. Each entry is a file with a checksum. The file name contains a hash of the data from which
// the entry was computed.
#pragma once
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace pelage {

/// Returns the folder of the cache: $XDG_CACHE_HOME/pelage, or ~/.cache/pelage if this variable is not set,
/// or a folder in the system's temporary folder if HOME is not set either.
std::filesystem::path cache_folder();

/// Writes values to a byte string in the byte order of the machine.
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
  void list(const std::vector<std::string>& items) {
    value(std::uint64_t(items.size()));
    for (const std::string& item : items) text(item);
  }
  /// Returns the title, the written bytes and a checksum of both. The writer is empty afterwards.
  std::string sealed(std::string_view title);

 private:
  std::string out_;
};

/// Reads the values that a Writer wrote. Each function returns false if too few bytes are left.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  bool value(T& item) {
    return take(&item, sizeof item);
  }
  template <class T>
  bool list(std::vector<T>& items) {
    return resize(items, sizeof(T)) && take(items.data(), items.size() * sizeof(T));
  }
  bool text(std::string& item) { return resize(item, 1) && take(item.data(), item.size()); }
  bool list(std::vector<std::string>& items) {
    return resize(items, sizeof(std::uint64_t)) &&
           std::all_of(items.begin(), items.end(), [&](std::string& item) { return text(item); });
  }
  bool done() const { return rest_.empty(); }

 private:
  /// Reads the number of items, each of which needs at least `size` of the bytes that are left.
  template <class Items>
  bool resize(Items& items, std::size_t size) {
    std::uint64_t count = 0;
    if (!value(count) || count > rest_.size() / size) return false;
    items.resize(count);
    return true;
  }
  bool take(void* target, std::size_t size) {
    if (size > rest_.size()) return false;
    rest_.copy(static_cast<char*>(target), size);
    rest_.remove_prefix(size);
    return true;
  }
  std::string_view rest_;
};

/// Removes the title and the checksum that Writer::sealed() added, and returns the bytes between them.
/// Returns nothing if the bytes are incomplete or damaged, or do not begin with `title`.
std::optional<std::string_view> unsealed(std::string_view bytes, std::string_view title);

/// Returns the bytes of a file, or nothing if the file cannot be read. Sets the file's modification time to
/// the current time, because trim_cache() removes the files with the oldest modification times first.
std::optional<std::string> read_cache_file(const std::filesystem::path& file);

/// Writes a file under a temporary name and renames it, so that other processes never read an incomplete
/// file. Returns false if writing fails (full disk, read-only folder).
bool write_cache_file(const std::filesystem::path& file, std::string_view bytes);

/// Removes the least recently used files of a folder until at most `most` bytes are left. Writing a file and
/// reading it by read_cache_file() count as use.
void trim_cache(const std::filesystem::path& folder, std::uintmax_t most);

/// Returns the value that packed() wrote with the same title and parts. Returns nothing if the bytes are
/// incomplete or damaged, or do not begin with `title`. parts(store, value) calls `store` for each member of
/// the value, in the same order for reading and for writing, and returns false as soon as `store` returns
/// false.
template <class Value, class Parts>
std::optional<Value> unpacked(std::string_view bytes, std::string_view title, const Parts& parts) {
  const auto content = unsealed(bytes, title);
  if (!content) return {};
  Reader from(*content);
  Value value;
  const auto load = [&]<class T>(T& part) {
    if constexpr (std::is_same_v<T, std::string>)
      return from.text(part);
    else if constexpr (std::is_trivially_copyable_v<T>)
      return from.value(part);
    else
      return from.list(part);
  };
  if (!parts(load, value) || !from.done()) return {};
  return value;
}

template <class Value, class Parts>
std::string packed(std::string_view title, const Parts& parts, Value& value) {
  Writer to;
  const auto save = [&]<class T>(const T& part) {
    if constexpr (std::is_same_v<T, std::string>)
      to.text(part);
    else if constexpr (std::is_trivially_copyable_v<T>)
      to.value(part);
    else
      to.list(part);
    return true;
  };
  parts(save, value);
  return to.sealed(title);
}

/// Returns the value that `file` keeps. If the file is absent or damaged, returns make(), and keeps it in the
/// file; the folder then keeps at most `most` bytes. unpacked() describes `parts`.
template <class Value, class Parts, class Make>
Value cached(const std::filesystem::path& file, std::string_view title, std::uintmax_t most,
             const Parts& parts, const Make& make) {
  if (const auto bytes = read_cache_file(file))
    if (auto value = unpacked<Value>(*bytes, title, parts)) return std::move(*value);
  Value value = make();
  if (write_cache_file(file, packed(title, parts, value))) trim_cache(file.parent_path(), most);
  return value;
}

}  // namespace pelage
