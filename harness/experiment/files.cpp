#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/data_folder.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

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
  std::ranges::sort(known);
  throw InputError(fmt::format("{}: there is no such scene file, and no such example in {}/ (examples: {})",
                               name, folder.string(), fmt::join(known, ", ")));
}

}  // namespace

std::vector<fs::path> experiment_files() {
  std::vector<fs::path> result;
  for (const fs::path& data : data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR)) {
    const fs::path folder = data / "experiments";
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".toml" && entry.path().filename() != "models.toml" &&
          !entry.path().filename().string().starts_with("claims"))
        result.push_back(entry.path());
    break;
  }
  std::ranges::sort(result);
  return result;
}

fs::path experiment_file(const std::string& name_or_file) {
  if (name_or_file.ends_with(".toml")) {
    if (!fs::is_regular_file(name_or_file))
      throw InputError(fmt::format("{}: no such experiment file", name_or_file));
    return name_or_file;
  }
  std::vector<std::string> known;
  for (const fs::path& file : experiment_files()) {
    if (file.stem() == name_or_file) return file;
    known.push_back(file.stem().string());
  }
  throw InputError(fmt::format("there is no experiment '{}' (known: {}; or give a FILE.toml)", name_or_file,
                               fmt::join(known, ", ")));
}

std::vector<fs::path> experiments_named(const std::string& name_or_file) {
  const std::vector<fs::path> files = experiment_files();
  const auto shipped = [&](const fs::path& file) { return file.stem() == name_or_file; };
  std::vector<fs::path> collection;
  if (!name_or_file.ends_with(".toml") && std::ranges::none_of(files, shipped))
    for (const fs::path& file : files)
      if (read_experiment(file).collection == name_or_file) collection.push_back(file);
  return collection.empty() ? std::vector{experiment_file(name_or_file)} : collection;
}

fs::path file_or_example(const fs::path& folder, const std::string& name) {
  const fs::path file = (folder / name).lexically_normal();
  std::error_code error;
  return fs::exists(file, error) || error || name.find('/') != std::string::npos ? file : example_scene(name);
}

std::optional<Experiment> shipped_experiment(const std::string& name) {
  try {
    return read_experiment(experiment_file(name));
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace pelage
