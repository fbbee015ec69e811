// Reads the datasets of dumps, writes the tables of docs/dump.md from them, and compares these with the
// document.
#pragma once
#include <fmt/ranges.h>
#include <hdf5.h>

#include <cstdlib>
#include <map>
#include <set>

#include "harness/dump/dump.hpp"
#include "tests/support/files.hpp"

namespace pelage {

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

/// Returns the values of a dataset of the dump `path`, converted to floats.
inline std::vector<float> floats_of(const std::filesystem::path& path, const char* name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set);
  std::vector<float> values(std::size_t(H5Sget_simple_extent_npoints(space)));
  H5Dread(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(set);
  H5Fclose(file);
  return values;
}

/// Writes a dump of the frame, calls `use` with its path, and removes it. Returns the result of `use`.
template <class Arrays, class Use>
auto with_dump(const DumpedFrame& frame, const Arrays& arrays, const Use& use) {
  const test::Folder folder;
  write_dump(folder.path / "frame.h5", frame, arrays);
  return use(folder.path / "frame.h5");
}

/// The datasets of one dump. `symbols` maps a size to the symbol of docs/dump.md that it stands for; a size
/// that is neither a symbol nor a constant is the side of a texture.
struct Dumped {
  std::string scenes;  ///< the scenes of which the dump is an example, as in the column "written"
  Datasets file;
  std::map<std::string, std::string> symbols;
};

inline std::string shape_of(const std::string& name, const Dumped& dump) {
  static const std::set<std::string> constants{"1", "2", "3", "4", "6", "8"};
  std::string text;
  for (const std::string& size : dump.file.at(name).shape) {
    const auto symbol = dump.symbols.find(size);
    text += (text.empty() ? "" : " x ") + (name == "scene"                ? "bytes"
                                           : symbol != dump.symbols.end() ? symbol->second
                                           : constants.contains(size)     ? size
                                                                          : "side");
  }
  return text;
}

/// Returns one line per dataset. A dataset that all dumps have is written "always". The table of a single
/// dump has no column "written".
inline std::string table_of(const std::vector<Dumped>& dumps) {
  const bool single = dumps.size() == 1;
  std::set<std::string> names, kinds;
  for (const Dumped& dump : dumps) {
    kinds.insert(dump.scenes);
    for (const auto& [name, found] : dump.file)
      if (!name.starts_with("fur_mip/") || name == "fur_mip/1") names.insert(name);
  }
  std::string text = single ? "| dataset | shape, type | units | content |\n| --- | --- | --- | --- |\n"
                            : "| dataset | written | shape, type | units | content |\n"
                              "| --- | --- | --- | --- | --- |\n";
  for (const std::string& name : names) {
    std::set<std::string> scenes, shapes;
    Dataset one;
    for (const Dumped& dump : dumps) {
      const auto found = dump.file.find(name);
      if (found == dump.file.end()) continue;
      if (scenes.empty()) one = found->second;
      EXPECT_EQ(found->second.description, one.description) << name;
      EXPECT_EQ(found->second.units, one.units) << name;
      EXPECT_EQ(found->second.type, one.type) << name;
      scenes.insert(dump.scenes);
      shapes.insert(shape_of(name, dump));
    }
    EXPECT_NE(one.description, "") << name;
    text += fmt::format("| `{}` | ", name == "fur_mip/1" ? "fur_mip/L" : name);
    if (!single)
      text += fmt::format("{} | ", scenes == kinds ? "always" : fmt::format("{}", fmt::join(scenes, ", ")));
    text +=
        fmt::format("{}, {} | {} | {} |\n", fmt::join(shapes, " or "), one.type, one.units, one.description);
  }
  return text;
}

/// Expects that docs/dump.md contains the table between its marks "NAME begins" and "NAME ends". With the
/// environment variable PELAGE_WRITE_DUMP_TABLES, writes the table into the document instead.
inline void expect_in_document(const std::string& name, const std::string& table) {
  const std::filesystem::path path = std::filesystem::path(PELAGE_SOURCE_DIR) / "docs/dump.md";
  const std::string text = test::text_of(path);
  const std::string mark = "<!-- " + name + " begins -->\n";
  const auto begin = text.find(mark), end = text.find("<!-- " + name + " ends -->");
  ASSERT_TRUE(begin != std::string::npos && end != std::string::npos) << "docs/dump.md has no mark " << mark;
  const auto from = begin + mark.size();
  if (std::getenv("PELAGE_WRITE_DUMP_TABLES"))
    test::write_text(path, text.substr(0, from) + table + text.substr(end));
  else
    EXPECT_EQ(text.substr(from, end - from), table)
        << "write it: PELAGE_WRITE_DUMP_TABLES=1 test_dump --gtest_filter='*DumpTable*'";
}

}  // namespace pelage
