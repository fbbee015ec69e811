// Reads the datasets of a dump, for the tests of dumps.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pelage {

/// A dataset of a dump.
struct Dataset {
  std::string type, units, description;
  std::vector<std::string> shape;  ///< the sizes of its dimensions
};
using Datasets = std::map<std::string, Dataset>;

inline std::string attribute_of(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return "";
  const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT), type = H5Aget_type(attribute);
  std::string text(H5Tget_size(type), '\0');
  H5Aread(attribute, type, text.data());
  H5Tclose(type);
  H5Aclose(attribute);
  return text;
}

inline herr_t add_dataset(hid_t file, const char* name, const H5O_info_t* info, void* data) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set), type = H5Dget_type(set);
  std::vector<hsize_t> size(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  Dataset found;
  for (const hsize_t n : size) found.shape.push_back(fmt::format("{}", n));
  found.type = fmt::format("{}{}", H5Tget_class(type) == H5T_FLOAT ? 'f' : 'u', H5Tget_size(type));
  found.units = attribute_of(set, "units");
  found.description = attribute_of(set, "description");
  static_cast<Datasets*>(data)->emplace(name, found);
  H5Tclose(type);
  H5Sclose(space);
  H5Dclose(set);
  return 0;
}

/// Returns the datasets of the dump `path`. Expects that the file has all attributes of a dump.
inline Datasets datasets_of(const std::filesystem::path& path) {
  Datasets found;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_GE(file, 0);
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, add_dataset, &found, H5O_INFO_BASIC);
  for (const char* name : {"pelage", "pipeline", "frames", "mesh_hash", "scene_hash"})
    EXPECT_NE(attribute_of(file, name), "") << name;
  H5Fclose(file);
  return found;
}

}  // namespace pelage
