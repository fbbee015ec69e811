// Tuning: the kernels' tunable axes, and files with the values found for one device.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pelage {

/// Values of axes; one that is absent has its shipped value.
using Tuning = std::map<std::string, int>;

/// A number that changes a kernel's speed and not its picture.
struct TuningAxis {
  std::string name;            ///< "TILE_W"
  std::string what;            ///< one line
  std::vector<int> values;     ///< candidates, the shipped value apart
  std::optional<int> shipped;  ///< empty: it depends on the scene or is the driver's choice
};

/// The rooms of kernels/ that have axes, sorted: those with a tuning.toml.
std::vector<std::string> tunable_stages();

/// The axes of kernels/<stage>/tuning.toml, in the order of their lines. Throws InputError naming file, line
/// and what would be right; for a stage without axes, those that have some.
std::vector<TuningAxis> tuning_axes(const std::string& stage);

/// AXIS = whole number, at the top or in tables named after a room of kernels/ (the tables only order them).
/// Throws InputError naming file, line and key; an axis that no room has is an error too.
Tuning read_tuning(const std::filesystem::path& file);

/// The file's text with `values` in place of those of `stage` and the other stages' kept; `note` is a comment
/// of one or more lines. `before` is the file as it is, empty when there is none.
std::string with_stage(const std::string& before, const std::string& stage, const Tuning& values,
                       const std::string& note);

/// "TILE_W=8 GROUP=2"; "shipped" for none.
std::string text_of(const Tuning& tuning);

}  // namespace pelage
