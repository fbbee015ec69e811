// The tuning axes of the kernels (parameters that affect only speed), and files with the best values for one
// device.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pelage {

/// Values of tuning axes by name. An axis that is absent has its shipped (default) value.
using Tuning = std::map<std::string, int>;

/// A parameter that changes a kernel's speed but not its results.
struct TuningAxis {
  std::string name;            ///< "TILE_W"
  std::string what;            ///< description, one line
  std::vector<int> values;     ///< candidate values, without the shipped value
  std::optional<int> shipped;  ///< default value; empty if the scene or the driver sets the value
};

/// Returns the folders of kernels/ that contain a tuning.toml, sorted by name.
std::vector<std::string> tunable_stages();

/// Returns the axes of kernels/<stage>/tuning.toml, in the order of the file. If the file is invalid, throws
/// InputError; the message gives the file, the line and the valid form. If the stage has no axes, throws
/// InputError with a list of the stages that have axes.
std::vector<TuningAxis> tuning_axes(const std::string& stage);

/// Reads a TOML file with lines of the form `AXIS = whole number`, at the top level or in tables named after
/// folders of kernels/. The tables only group the axes. If a value is invalid or an axis does not exist,
/// throws InputError; the message gives the file, the line and the key.
Tuning read_tuning(const std::filesystem::path& file);

/// Returns the text of a tuning file in which `values` replace the values of `stage`. The values of other
/// stages are kept. `before` is the text of the file before the replacement; it is empty if there is no file.
/// `note` becomes a comment above the values of `stage`.
std::string with_stage(const std::string& before, const std::string& stage, const Tuning& values,
                       const std::string& note);

/// Returns the values as text, such as "TILE_W=8 GROUP=2", or "shipped" if `tuning` is empty.
std::string text_of(const Tuning& tuning);

}  // namespace pelage
