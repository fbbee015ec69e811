// An experiment file (experiments/*.toml) and its cases. The file format is described in docs/results.md.
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

/// The number of samples of a case, and the conditions that end its sampling.
struct SamplingLimits {
  double warm_up_s = 0.5;   ///< duration of the frames before the first sample, s; at least one frame
  int least = 10;           ///< number of samples before `precision` is tested
  int most = 200;           ///< largest number of samples
  double precision = 0.01;  ///< sampling ends at this relative half width of the median's 95% interval
  double limit_s = 20;      ///< wall-clock time after which sampling ends, s; at least one sample is taken
};

struct Preset {
  SamplingLimits limits;
  std::vector<Axis> axes;  ///< these replace the experiment's axes of the same key
};

/// One published number. It belongs to every case whose axes have the values `at` (axis -> value).
struct Published {
  std::map<std::string, std::string> at;
  Metric figure;
};

/// Pipeline and variant of a case if the experiment names no variant. The variant is then "shells/MAPPING"
/// with the device's default mapping, on CPUs `default_variant`. Report tables do not print
/// `default_variant`.
inline constexpr std::string_view default_pipeline = "shells", default_variant = "shells/tile";

/// Keys of a variant that are not keys of the scene.
inline constexpr std::string_view pipeline_key = "pipeline", mapping_key = "mapping", opengl_key = "opengl";

struct Experiment {
  std::string name, title, paper, table, hardware;
  std::filesystem::path file;
  std::vector<Setting> scene;  ///< scene keys of all cases
  std::vector<Axis> axes;      ///< the last axis varies fastest
  std::map<std::string, std::map<std::string, std::vector<Setting>>>
      at;  ///< axis -> value -> scene keys of its cases
  std::map<std::string, std::map<std::string, std::string>> variants;  ///< name -> pipeline, mapping, opengl
  std::map<std::string, Preset> presets;
  std::vector<Published> published;
  std::map<std::string, double> require;  ///< metric -> least value that every case must reach
};

struct Case {
  std::string name;     ///< unique in the experiment, usable as a file name: "torus-16-800x600"
  std::string variant;  ///< a name such as default_variant
  std::string pipeline;
  std::string mapping;  ///< mapping of the shells; "": the device's default
  std::string opengl;   ///< implementation options of the OpenGL baseline (docs/rival.md)
  std::map<std::string, std::string> axes;
  std::map<std::string, std::string> overrides;
  std::map<std::string, std::string> settings;  ///< scene keys of the experiment file, values as in TOML
  std::vector<Setting> set;               ///< axes that are scene keys, then --set; applied after `settings`
  std::optional<Metric> published;        ///< empty if there are overrides
  std::map<std::string, double> require;  ///< empty if there are overrides
};

/// The command-line options --set, --axis and --model, which change an experiment.
struct Overrides {
  std::vector<Setting> set;
  std::vector<Axis> axes;
  std::string model;
};

/// Reads a published figure: "267" (an exact print, here +-0.5), "< 1" (an upper bound), "~ 30" (an
/// approximate value) or "20..30" (a range). Throws InputError for other texts.
Metric published_figure(const std::string& text, const std::string& unit);

/// Reads an experiment file. Throws InputError with file, line, key and the permitted values.
Experiment read_experiment(const std::filesystem::path& file);

/// Returns the file of an experiment, given by its name in `pelage list` or by a path that ends in .toml.
/// Throws InputError, with the known names, if there is no such file.
std::filesystem::path experiment_file(const std::string& name_or_file);
std::vector<std::filesystem::path> experiment_files();  ///< all shipped experiment files, sorted

/// Returns the preset `name`. Throws InputError, with the names of the experiment's presets, if it does not
/// exist.
const Preset& preset_of(const Experiment& experiment, const std::string& name);

/// Returns all cases; the last axis of the file varies fastest. Throws InputError for a variant, reading or
/// size that is not valid, and for two cases of the same name.
std::vector<Case> cases_of(const Experiment& experiment, const Preset& preset,
                           const Overrides& overrides = {});

/// Returns the case's scene with all keys, after range checks. Relative paths in the experiment file start at
/// the file's folder, and those of --set at the working folder. Throws InputError that names the case and the
/// key.
Scene scene_of(const Experiment& experiment, const Case& which);

/// Returns the cases whose names contain a match of `regex` (empty: all cases). Throws InputError for a
/// malformed expression.
std::vector<Case> filtered(std::vector<Case> cases, const std::string& regex);

struct Shard {
  int index = 0, count = 1;
};
/// Reads "i/n" with 0 <= i < n. Throws InputError for other texts.
Shard shard_from_text(const std::string& text);
/// Returns every count-th case, beginning with case `index` (from 0). The shards of a list partition the
/// list.
std::vector<Case> sharded(const std::vector<Case>& cases, const Shard& shard);

/// Returns the cases in a random order that depends only on `seed`. In a random order a slow change of the
/// machine's speed does not bias one end of an axis.
std::vector<Case> shuffled(std::vector<Case> cases, std::uint64_t seed);

}  // namespace pelage
