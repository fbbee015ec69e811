#include "harness/experiment/example_scenes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "harness/data_folder.hpp"
#include "harness/error.hpp"

namespace pelage {

namespace fs = std::filesystem;

namespace {

fs::path example_scene(const std::string& name) {
  const fs::path folder = data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR).back() / "examples";
  std::vector<std::string> known;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".toml") continue;
    if (file.stem() == name || file.filename() == name) return file;
    known.push_back(file.stem().string());
  }
  std::sort(known.begin(), known.end());
  throw InputError(fmt::format("{}: there is no such scene file, and no such example in {}/ (examples: {})",
                               name, folder.string(), fmt::join(known, ", ")));
}

}  // namespace

fs::path file_or_example(const fs::path& folder, const std::string& name) {
  const fs::path file = (folder / name).lexically_normal();
  std::error_code error;
  return fs::exists(file, error) || error || name.find('/') != std::string::npos ? file : example_scene(name);
}

}  // namespace pelage
