// An experiment file (experiments/*.toml) and the cases it stands for. docs/results.md describes the format.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/journal/row.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// A scene key and its value, written as in TOML: {"fur.length", "0.08"}.
using Setting = std::pair<std::string, std::string>;

/// A quantity that varies over the cases: "model", "layers" (fur.layers), "size" (image.width x
/// image.height), "reading" or "variant" (names of the file's own tables), or any scene key.
struct Axis {
  std::string key;
  std::vector<std::string> values;
};

/// How often a case is timed.
struct SamplingLimits {
  double warm_up_s = 0.5;   ///< frames drawn and thrown away before the first sample, s; at least one frame
  int least = 10;           ///< samples before the interval is looked at
  int most = 200;           ///< samples at which sampling stops in any case
  double precision = 0.01;  ///< stop when the 95% interval of the median is no wider than +- this fraction
  double limit_s = 20;      ///< wall clock for all samples, s; at least one is taken
};

struct Preset {
  SamplingLimits limits;
  std::vector<Axis> axes;  ///< take the place of the experiment's axes of the same key
};

/// One published number: it belongs to every case whose axes have these values.
struct Published {
  std::map<std::string, std::string> at;
  Metric figure;
};

/// What a case runs where the experiment names no variant: this pipeline, with the mapping that suits the
/// device. Rows of a processor's default mapping have the variant below; report tables leave it unsaid.
inline constexpr std::string_view default_pipeline = "shells", default_variant = "shells/tile";

/// Keys of a variant that are not keys of the scene.
inline constexpr std::string_view pipeline_key = "pipeline", mapping_key = "mapping", opengl_key = "opengl";

struct Experiment {
  std::string name, title, paper, table, hardware;
  std::filesystem::path file;
  std::vector<Setting> scene;                                             ///< shared by all cases
  std::vector<Axis> axes;                                                 ///< in the order in which they nest
  std::map<std::string, std::map<std::string, std::vector<Setting>>> at;  ///< axis, value -> further settings
  std::map<std::string, std::map<std::string, std::string>> variants;  ///< name -> pipeline, mapping, opengl
  std::map<std::string, Preset> presets;
  std::vector<Published> published;
  std::map<std::string, double> require;  ///< metric -> least value that a case of this experiment must have
};

struct Case {
  std::string name;     ///< unique in the experiment, fit for a file name: "torus-16-800x600"
  std::string variant;  ///< such as default_variant
  std::string pipeline;
  std::string mapping;  ///< of the shells; "": the device's own
  std::string opengl;   ///< how the OpenGL rival is written (docs/rival.md)
  std::map<std::string, std::string> axes;
  std::map<std::string, std::string> overrides;
  std::map<std::string, std::string> settings;  ///< scene keys that the experiment gives, values as in TOML
  std::vector<Setting> set;                     ///< other axes, then --set: applied last
  std::optional<Metric> published;              ///< only without overrides
  std::map<std::string, double> require;        ///< only without overrides
};

/// What the command line changes: --set, --axis, --model.
struct Overrides {
  std::vector<Setting> set;
  std::vector<Axis> axes;
  std::string model;
};

/// Reads a published figure: "267" (=, whole: +-0.5), "< 1" (censored), "~ 30" (about), "20..30" (range).
/// Throws InputError for anything else.
Metric published_figure(const std::string& text, const std::string& unit);

/// Throws InputError with file, line, key and what would be right.
Experiment read_experiment(const std::filesystem::path& file);

/// The file that a name of `pelage list` or a path means. Throws InputError naming the known experiments.
std::filesystem::path experiment_file(const std::string& name_or_file);
std::vector<std::filesystem::path> experiment_files();  ///< the shipped ones, sorted

/// The preset of that name. Throws InputError naming those there are.
const Preset& preset_of(const Experiment& experiment, const std::string& name);

/// All cases, axes nested in the file's order. Throws InputError for an axis value the file does not know.
std::vector<Case> cases_of(const Experiment& experiment, const Preset& preset,
                           const Overrides& overrides = {});

/// The case's whole scene, checked. Relative paths start at the experiment's own folder, those of --set at
/// the working one. Throws InputError naming the case and the key.
Scene scene_of(const Experiment& experiment, const Case& which);

/// Those whose name holds a match of `regex` (empty: all). Throws InputError for a malformed expression.
std::vector<Case> filtered(std::vector<Case> cases, const std::string& regex);

struct Shard {
  int index = 0, count = 1;
};
/// "i/n" with 0 <= i < n, else InputError.
Shard shard_from_text(const std::string& text);
/// Every count-th case from the index-th on: the shards of one list partition it.
std::vector<Case> sharded(const std::vector<Case>& cases, const Shard& shard);

/// The same cases in an order drawn by `seed`, so that drift of the machine does not follow an axis.
std::vector<Case> shuffled(std::vector<Case> cases, std::uint64_t seed);

}  // namespace pelage
