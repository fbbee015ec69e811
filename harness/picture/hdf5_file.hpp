// Writes HDF5 files: named arrays with their units. Only hdf5_file.cpp includes HDF5's headers.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace pelage {

class Hdf5File {
 public:
  /// Creates an HDF5 file in memory; close() writes it to `path`. `name` is the name of the file in error
  /// messages. Throws InputError if there is not enough memory for the file.
  Hdf5File(const std::filesystem::path& path, std::string name);
  ~Hdf5File();
  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File& operator=(Hdf5File&& other) noexcept;

  /// Writes `values` as the compressed dataset `name`. `name` may contain groups, which are created as needed
  /// ("mesh/uv"). `shape` is the number of values in each dimension. The dataset receives the string
  /// attributes "units" and "description". Throws InputError if the product of `shape` is not the number of
  /// values, or if the dataset cannot be written.
  void write(const std::string& name, const std::vector<std::size_t>& shape, std::span<const float> values,
             const std::string& units, const std::string& description);
  void write(const std::string& name, const std::vector<std::size_t>& shape,
             std::span<const std::uint32_t> values, const std::string& units, const std::string& description);
  void write(const std::string& name, const std::vector<std::size_t>& shape,
             std::span<const std::uint8_t> values, const std::string& units, const std::string& description);

  /// Writes a string attribute of the file.
  void note(const std::string& name, const std::string& text);

  /// Creates or replaces the file on disk. Throws InputError if the file cannot be written. If close() is not
  /// called, no file is written.
  void close();

 private:
  void write_raw(const std::string& name, const std::vector<std::size_t>& shape, std::int64_t type,
                 const void* values, std::size_t count, const std::string& units,
                 const std::string& description);
  std::int64_t file_ = -1;
  std::filesystem::path path_;
  std::string name_;
};

}  // namespace pelage
