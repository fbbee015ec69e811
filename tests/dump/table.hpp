// Writes the tables of docs/dump.md from the datasets of dumps, and compares them with the document.
#pragma once
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include "tests/dump/datasets_of.hpp"

namespace pelage {

/// The datasets of one dump. `symbols` maps a size to the symbol of docs/dump.md that it stands for; a size
/// that is neither a symbol nor a constant is the side of a texture.
struct Dumped {
  std::string scenes;  ///< the scenes of which the dump is an example, as in the column "written"
  Datasets file;
  std::map<std::string, std::string> symbols;
};

inline std::string shape_of(const std::string& name, const Dumped& dump) {
  static const std::set<std::string> constants{"1", "2", "3", "4", "8"};
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
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string mark = "<!-- " + name + " begins -->\n";
  const auto begin = text.find(mark), end = text.find("<!-- " + name + " ends -->");
  ASSERT_TRUE(begin != std::string::npos && end != std::string::npos) << "docs/dump.md has no mark " << mark;
  const auto from = begin + mark.size();
  if (std::getenv("PELAGE_WRITE_DUMP_TABLES"))
    std::ofstream(path) << text.substr(0, from) << table << text.substr(end);
  else
    EXPECT_EQ(text.substr(from, end - from), table)
        << "write it: PELAGE_WRITE_DUMP_TABLES=1 test_dump --gtest_filter='*DumpTable*'";
}

}  // namespace pelage
