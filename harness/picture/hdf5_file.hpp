// Writes HDF5 files: named arrays with their units. Only hdf5_file.cpp includes HDF5's headers.
#pragma once
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
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
  /// ("mesh/uv"). The shape of the dataset is `outer`, then the number of components of a value, if it has
  /// several. The dataset receives the string attributes "units" and "description". Throws InputError if the
  /// product of `outer` is not the number of values, or if the dataset cannot be written.
  template <class Values>
  void write(const std::string& name, const std::vector<std::size_t>& outer, const Values& values,
             const std::string& units, const std::string& description) {
    write_shaped(name, outer, std::data(values), std::size(values), units, description);
  }
  /// Writes a list of values: `outer` is their number.
  template <class Values>
  void write(const std::string& name, const Values& values, const std::string& units,
             const std::string& description) {
    write(name, {std::size(values)}, values, units, description);
  }

  /// Writes a string attribute of the file.
  void note(const std::string& name, const std::string& text);

  /// Creates or replaces the file on disk. Throws InputError if the file cannot be written. If close() is not
  /// called, no file is written.
  void close();

 private:
  template <class Value>
  void write_shaped(const std::string& name, std::vector<std::size_t> shape, const Value* values,
                    std::size_t count, const std::string& units, const std::string& description) {
    if constexpr (std::is_arithmetic_v<Value>) {
      write_raw(name, shape, values, count, units, description);
    } else {
      using Component = typename Value::value_type;
      constexpr std::size_t components = sizeof(Value) / sizeof(Component);
      shape.push_back(components);
      write_shaped(name, std::move(shape), reinterpret_cast<const Component*>(values), count * components,
                   units, description);
    }
  }
  /// Scalar is float, std::uint32_t or std::uint8_t.
  template <class Scalar>
  void write_raw(const std::string& name, const std::vector<std::size_t>& shape, const Scalar* values,
                 std::size_t count, const std::string& units, const std::string& description);
  std::int64_t file_ = -1;
  std::filesystem::path path_;
  std::string name_;
};

}  // namespace pelage
