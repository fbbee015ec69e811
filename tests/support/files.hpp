// Creates temporary folders and text files for tests.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace pelage {

namespace fs = std::filesystem;

namespace test {

inline std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Returns the files in the folder and its folders whose names end with `ending`.
inline std::vector<fs::path> files_below(const fs::path& folder, const std::string& ending = "") {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().string().ends_with(ending)) files.push_back(entry.path());
  return files;
}

/// A temporary folder, which the destructor deletes.
struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "pelage-test-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Writes a file, and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    write_text(path / name, text);
    return (path / name).string();
  }
  std::string read(const std::string& name) const { return text_of(path / name); }
  /// Replaces the first `from` in a file by `to`. The test ends if the file does not contain `from`.
  void edit(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = read(name);
    const std::size_t place = text.find(from);
    if (place == std::string::npos) throw std::runtime_error(name + " does not contain " + from);
    write(name, text.replace(place, from.size(), to));
  }
};

/// A test with a temporary folder of its own.
struct InFolder : ::testing::Test {
  const Folder folder;
};

}  // namespace test
}  // namespace pelage
