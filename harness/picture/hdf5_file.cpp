#include "harness/picture/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <numeric>
#include <utility>

#include "harness/error.hpp"

namespace pelage {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

constexpr hsize_t chunk_values = 1 << 18;  // 2^18 values, a megabyte of floats
constexpr unsigned deflate_level = 1;

/// Owns an HDF5 handle and closes it in the destructor.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw InputError(what + ": HDF5 cannot write it");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void write_text(hid_t object, const std::string& name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, name);
  // HDF5 does not support strings of length 0.
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
  H5Tset_cset(type, H5T_CSET_UTF8);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, name);
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         name);
  const std::string padded = text.empty() ? std::string(1, '\0') : text;
  if (H5Awrite(attribute, type, padded.data()) < 0) throw InputError(name + ": HDF5 cannot write it");
}

}  // namespace

Hdf5File::Hdf5File(const std::filesystem::path& path, std::string name)
    : path_(path), name_(std::move(name)) {
  // Turns off HDF5's error messages on stderr, because pelage throws exceptions.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  // HDF5 builds the file in memory, and close() writes it to the disk. If HDF5 wrote to a full disk itself,
  // it could not close the file, and the program would crash when it ends.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, name_);
  H5Pset_fapl_core(access, std::size_t(1) << 20, 0);
  file_ = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (file_ < 0) throw InputError(name_ + ": HDF5 cannot create it in memory");
}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : file_(std::exchange(other.file_, -1)), path_(std::move(other.path_)), name_(std::move(other.name_)) {}

Hdf5File& Hdf5File::operator=(Hdf5File&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(path_, other.path_);
  std::swap(name_, other.name_);
  return *this;
}

template <class Scalar>
void Hdf5File::write_raw(const std::string& name, const std::vector<std::size_t>& shape, const Scalar* values,
                         std::size_t count, const std::string& units, const std::string& description) {
  const hid_t type = std::is_same_v<Scalar, float>           ? H5T_NATIVE_FLOAT
                     : std::is_same_v<Scalar, std::uint32_t> ? H5T_NATIVE_UINT32
                                                             : H5T_NATIVE_UINT8;
  const std::string what = fmt::format("{}: dataset {}", name_, name);
  if (std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>()) != count)
    throw InputError(fmt::format("{}: the shape does not match the number of values, {}", what, count));
  std::vector<hsize_t> size(shape.begin(), shape.end());
  const Handle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose, what);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what);
  H5Pset_create_intermediate_group(links, 1);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  if (count > 0) {
    std::vector<hsize_t> chunk = size;
    // A chunk holds at most chunk_values values. If the dataset has more values, the loop shortens the
    // dimensions of the chunk one after another, starting with the first dimension, until the chunk is small
    // enough.
    hsize_t held = std::accumulate(chunk.begin(), chunk.end(), hsize_t{1}, std::multiplies<>());
    for (hsize_t& side : chunk) {
      const hsize_t rest = held / side;
      side = std::clamp<hsize_t>(chunk_values / rest, 1, side);
      held = rest;
    }
    H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
    H5Pset_deflate(creation, deflate_level);
  }
  const Handle dataset(H5Dcreate2(file_, name.c_str(), type, space, links, creation, H5P_DEFAULT), H5Dclose,
                       what);
  if (count > 0 && H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    throw InputError(fmt::format("{}: cannot be written; is the disk full?", what));
  write_text(dataset, "units", units);
  write_text(dataset, "description", description);
}
template void Hdf5File::write_raw(const std::string&, const std::vector<std::size_t>&, const float*,
                                  std::size_t, const std::string&, const std::string&);
template void Hdf5File::write_raw(const std::string&, const std::vector<std::size_t>&, const std::uint32_t*,
                                  std::size_t, const std::string&, const std::string&);
template void Hdf5File::write_raw(const std::string&, const std::vector<std::size_t>&, const std::uint8_t*,
                                  std::size_t, const std::string&, const std::string&);

void Hdf5File::note(const std::string& name, const std::string& text) {
  write_text(file_, name, text);
}

void Hdf5File::close() {
  if (file_ < 0) return;
  H5Fflush(file_, H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  std::string bytes(std::size_t(std::max<ssize_t>(size, 0)), '\0');
  const bool read = size > 0 && H5Fget_file_image(file_, bytes.data(), bytes.size()) == size;
  H5Fclose(std::exchange(file_, -1));
  std::ofstream stream(path_, std::ios::binary);
  stream << bytes << std::flush;
  if (!read || !stream) throw InputError(fmt::format("{}: cannot be written; is the disk full?", name_));
}

}  // namespace pelage
