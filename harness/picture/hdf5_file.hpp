// An HDF5 file being written: named arrays with their units. Move-only; HDF5 itself stays behind this header.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace pelage {

class Hdf5File {
 public:
  /// Creates or replaces the file; errors call it `name`. Throws InputError when it cannot.
  Hdf5File(const std::filesystem::path& path, std::string name);
  ~Hdf5File();
  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File& operator=(Hdf5File&& other) noexcept;

  /// Writes `values` as the dataset `name` ("mesh/uv": groups are made as needed) of `shape`, whose product
  /// is the count of values, compressed, with the string attributes "units" and "description". Throws
  /// InputError.
  void write(const std::string& name, const std::vector<std::size_t>& shape, std::span<const float> values,
             const std::string& units, const std::string& description);
  void write(const std::string& name, const std::vector<std::size_t>& shape,
             std::span<const std::uint32_t> values, const std::string& units, const std::string& description);
  void write(const std::string& name, const std::vector<std::size_t>& shape,
             std::span<const std::uint8_t> values, const std::string& units, const std::string& description);

  /// A string attribute of the file.
  void note(const std::string& name, const std::string& text);

  /// Flushes and closes; throws InputError when the disk refuses. The destructor closes without a word.
  void close();

 private:
  void write_raw(const std::string& name, const std::vector<std::size_t>& shape, std::int64_t type,
                 const void* values, std::size_t count, const std::string& units,
                 const std::string& description);
  std::int64_t file_ = -1;
  std::string name_;
};

}  // namespace pelage
