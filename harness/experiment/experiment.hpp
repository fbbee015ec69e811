// An experiment file (experiments/*.toml) and its cases. docs/experiments.md describes the file format.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/experiment/view.hpp"
#include "harness/record/row.hpp"
#include "harness/scene/scene.hpp"

namespace re2 {
class RE2;
}

namespace pelage {

/// A scene key and its value, written as in TOML: {"fur.length", "0.08"}.
using Setting = std::pair<std::string, std::string>;

/// A quantity that varies over the cases of an experiment. The key is one of the built-in keys, a scene key,
/// or a name that the author of the experiment file chose. The built-in keys are
/// - "model";
/// - "layers": the scene key fur.layers;
/// - "size": image.width x image.height;
/// - "reading": "paper" or "pelage" (harness/scene/readings.hpp), or a name of a table in the file;
/// - "variant": a pipeline with its options.
/// The values of "variant", of an axis with a chosen name, and the other values of "reading" are names of
/// tables in the file.
struct Axis {
  std::string key;
  std::vector<std::string> values;  ///< as written in the file or on the command line: "0.10" stays "0.10"
};

/// The number of samples of a case, and the conditions that end its sampling.
struct SamplingLimits {
  double warm_up_s = 0.5;  ///< duration of the warm-up frames in seconds; at least one frame is drawn
  int least = 10;          ///< smallest number of samples
  int most = 200;          ///< largest number of samples
  /// Sampling ends when the half width of the median's 95% interval is at most this fraction of the median.
  double precision = 0.01;
  /// Sampling ends after this wall-clock time in seconds, but not before the first sample.
  double limit_s = 20;
};

struct Preset {
  SamplingLimits limits;
  /// Each axis replaces the experiment's axis with the same key, or is added if there is none.
  std::vector<Axis> axes;
};

/// One number from a paper. It applies to every case whose axes have the values in `at` (axis -> value).
struct Published {
  std::map<std::string, std::string> at;
  Metric figure;
};

/// A variant without the key `pipeline` has the pipeline that its scene names; `default_pipeline` is that of
/// scenes that name none. `default_variant` is the variant of a case without the axis "variant". When such a
/// case runs on a device, it is renamed to "shells/MAPPING"; on CPUs the default mapping is "tile".
inline constexpr std::string_view default_pipeline = "shells", default_variant = "shells/tile";

/// Besides scene keys, the table of a variant in an experiment file may contain these three keys.
inline constexpr std::string_view pipeline_key = "pipeline", mapping_key = "mapping", opengl_key = "opengl";

/// Returns what one sample of the pipeline is: "frame", "one simulated second", ...
std::string sample_of(std::string_view pipeline);

struct Experiment {
  std::string name, title, paper, table, hardware;
  std::string collection;  ///< name with which `pelage run` runs the whole collection; may be empty
  /// Axes that control_case() sets to their first values; empty: see there.
  std::vector<std::string> baseline;
  std::filesystem::path file;
  std::filesystem::path scene_file;  ///< value of the key `file` in the table [scene]; may be empty
  Scene base;                        ///< the scene in `scene_file`; if that is empty, the default scene
  std::vector<Setting> scene;        ///< scene keys that apply to all cases; they override those of `base`
  std::vector<Axis> axes;            ///< in the order of the file; the last axis varies fastest
  /// Axis key -> value of the axis -> the scene keys that apply to all cases with this value.
  std::map<std::string, std::map<std::string, std::vector<Setting>>> at;
  /// Name of a variant -> its values of the keys `pipeline`, `mapping` and `opengl`.
  std::map<std::string, std::map<std::string, std::string>> variants;
  std::map<std::string, Preset> presets;
  std::vector<Published> published;
  std::map<std::string, double> require;  ///< metric -> least value that every case must reach
  /// Axis key -> value of the axis -> metric -> least value that the cases with this value must reach.
  std::map<std::string, std::map<std::string, std::map<std::string, double>>> require_at;
  View view;  ///< the keys of the table [report]
};

struct Case {
  std::string name;     ///< unique in the experiment, usable as a file name: "torus-16-800x600"
  std::string variant;  ///< a name such as default_variant
  std::string pipeline;
  std::string mapping;  ///< mapping of pixels to work-items; "": the device's default
  std::string opengl;   ///< implementation options of the OpenGL baseline (docs/baselines.md)
  std::map<std::string, std::string> axes;
  std::map<std::string, std::string> overrides;  ///< values of the options --set, --axis and --model
  std::map<std::string, std::string> settings;   ///< scene keys of the experiment file, values as in TOML
  /// The scene keys that are axes, followed by those of --set. They override `settings`.
  std::vector<Setting> set;
  std::optional<Metric> published;  ///< value from the experiment's paper; absent if there are overrides
  std::map<std::string, double> require;  ///< metric -> required minimum; no entries if there are overrides
};

/// The command-line options --set, --axis, --model and --reading, which change an experiment.
struct Overrides {
  std::vector<Setting> set = {};
  std::vector<Axis> axes = {};
  std::string model = {};
  std::string reading = {};  ///< the only value of the axis "reading"; rows have it there, not as an override
};

/// Reads a number in the form in which a paper prints it: "267" (rounded: between 266.5 and 267.5), "< 1" (an
/// upper bound), "~ 30" (an approximate value) or "20..30" (a range). Throws InputError for other texts.
Metric published_figure(const std::string& text, const std::string& unit);

/// Reads an experiment file. The InputError for an invalid file names the file, the line, the key and the
/// permitted values.
Experiment read_experiment(const std::filesystem::path& file);

/// Reads `name` and the table [report] of an experiment file, which needs no other key.
std::pair<std::string, View> read_view_of(const std::filesystem::path& file);

/// Returns the path of an experiment file, given as a name that `pelage list` shows or a path that ends in
/// .toml. The InputError for an unknown name lists the known ones.
std::filesystem::path experiment_file(const std::string& name_or_file);
/// Returns the files of the experiments that `pelage run` runs for a word: those of the collection with this
/// name, sorted, or else the experiment_file().
std::vector<std::filesystem::path> experiments_named(const std::string& name_or_file);
std::vector<std::filesystem::path> experiment_files();  ///< all shipped experiment files, sorted
/// Returns the shipped experiment with this name; nothing if there is no such file, or if it cannot be read.
std::optional<Experiment> shipped_experiment(const std::string& name);

/// Returns the path of a scene file, relative to `folder`. If there is no such file, and `name` contains no
/// '/', returns the path of the example NAME or NAME.toml. The InputError for an unknown name lists all
/// examples.
std::filesystem::path file_or_example(const std::filesystem::path& folder, const std::string& name);

/// Returns the preset `name`. The InputError for an unknown name lists the presets.
const Preset& preset_of(const Experiment& experiment, const std::string& name);

/// Largest number of cases of an experiment. This limit bounds the memory of the list of cases.
inline constexpr int most_cases = 100'000;

/// Largest number of characters in the name of a case. Files are named after the case.
inline constexpr std::size_t longest_case_name = 200;

/// Returns all cases; the last axis of the file varies fastest. Throws InputError if an axis or a value is
/// not valid (check_axes()), or if two cases have the same name.
std::vector<Case> cases_of(const Experiment& experiment, const Preset& preset,
                           const Overrides& overrides = {});

/// Returns the case's scene with all keys, after range checks; keyframes have their values at the time
/// dynamics.time. A relative path is relative to the folder of the file that contains it, or to the working
/// folder in --set. The InputError for an invalid value names the case, the key, the experiment file and the
/// scene file.
Scene scene_of(const Experiment& experiment, const Case& which);

/// Returns the case with the first value, in the experiment file, of each axis in Experiment::baseline. If
/// that is empty, of each axis whose values are names of tables, other than model, layers, size and variant.
/// Other axes, the readings paper and pelage, and --set stay.
Case control_case(const Experiment& experiment, const Case& which);

/// The option --filter: a regular expression in RE2's syntax that selects cases by their names. RE2 matches
/// in a time proportional to the length of the text; std::regex can take exponential time or overflow the
/// stack.
class Filter {
 public:
  /// Throws InputError if the expression is invalid, or if its compiled form needs more than 8 MiB.
  explicit Filter(const std::string& expression);
  bool finds(const std::string& name) const;  ///< whether a part of `name` matches

 private:
  std::shared_ptr<const re2::RE2> expression_;
};

/// Returns the cases whose names contain a match of `regex` (empty: all cases). Throws InputError for a
/// malformed expression.
std::vector<Case> filtered(std::vector<Case> cases, const std::string& regex);

struct Shard {
  int index, count;
};
/// Reads "i/n" with 0 <= i < n: shard (part of a run) i of n. Throws InputError for other texts.
Shard shard_from_text(const std::string& text);
/// Returns the cases in a random order that depends only on `seed`, so that a slow change of the machine's
/// speed affects all values of an axis about equally.
std::vector<Case> shuffled(std::vector<Case> cases, std::uint64_t seed);

}  // namespace pelage
