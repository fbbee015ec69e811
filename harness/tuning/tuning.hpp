// The tuning axes of the kernels, and files with the best values for one device.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pelage {

/// Values of tuning axes. An absent axis has its shipped value.
using Tuning = std::map<std::string, int>;

/// A parameter that changes a kernel's speed but not its results.
struct TuningAxis {
  std::string name;            ///< "TILE_W"
  std::string what;            ///< description, one line
  std::vector<int> values;     ///< candidate values, without the shipped value
  std::optional<int> shipped;  ///< empty if it depends on the scene or the driver chooses it
};

/// Returns the folders of kernels/ that contain a tuning.toml, sorted by name.
std::vector<std::string> tunable_stages();

/// Returns the axes of kernels/<stage>/tuning.toml, in the order of their lines. Throws InputError with file,
/// line and the valid form. For a stage without axes, the error lists the stages that have axes.
std::vector<TuningAxis> tuning_axes(const std::string& stage);

/// Reads a file of lines AXIS = whole number, at the top level or in tables named after folders of kernels/.
/// The tables only group the axes. Throws InputError with file, line and key, also for an axis that does not
/// exist.
Tuning read_tuning(const std::filesystem::path& file);

/// Returns the text of a tuning file in which `values` replace the values of `stage`; other stages are kept.
/// `before` is the present text of the file, or empty. `note` becomes a comment of one or more lines.
std::string with_stage(const std::string& before, const std::string& stage, const Tuning& values,
                       const std::string& note);

/// Returns the values as text, such as "TILE_W=8 GROUP=2"; "shipped" if there are none.
std::string text_of(const Tuning& tuning);

}  // namespace pelage
