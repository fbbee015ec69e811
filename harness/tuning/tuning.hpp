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

struct TuningAxis {
  std::string name;            ///< "TILE_W"
  std::string what;            ///< description, one line
  std::vector<int> values;     ///< candidate values, without the shipped value
  std::optional<int> shipped;  ///< default value; empty if the scene or the driver sets the value
};

/// Returns the folders of kernels/ that contain a tuning.toml, sorted by name.
std::vector<std::string> tunable_stages();

/// Returns the axes of kernels/<stage>/tuning.toml, in the order of the file. The InputError for an invalid
/// file has the file, the line and the valid form; that for a stage without axes lists the stages that have
/// some.
std::vector<TuningAxis> tuning_axes(const std::string& stage);

/// Reads a TOML file with lines of the form `AXIS = whole number`, at the top level or in tables named after
/// folders of kernels/, which only group the axes. The InputError for an invalid value or axis has the file,
/// the line and the key.
Tuning read_tuning(const std::filesystem::path& file);

/// Returns the text of a tuning file, `before` (empty if there is none), in which `values` replace the values
/// of `stage`. `note` becomes a comment above them.
std::string with_stage(const std::string& before, const std::string& stage, const Tuning& values,
                       const std::string& note);

/// Returns the values as text, such as "TILE_W=8 GROUP=2", or "shipped" if `tuning` is empty.
std::string text_of(const Tuning& tuning);

}  // namespace pelage
