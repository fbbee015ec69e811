#include "harness/scene/readings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/base/toml_table.hpp"
#include "harness/data_folder.hpp"
#include "harness/error.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

struct Paper {
  std::string_view letter, key;
};
constexpr Paper papers[] = {{"S", "silva2010-curling-clumping"},
                            {"W", "silva2010-wet-fur"},
                            {"B", "banisch2006-grass-and-fur"},
                            {"D", "demoreuille2011-once-upon-a-monster"}};

/// Returns the value of a key as TOML. Throws InputError if the scene key does not accept it.
std::string reading_value(TomlTable& in, const std::string& key, const char* reading) {
  const toml::node* node = in.get(reading);
  if (!node) in.refuse(reading, fmt::format("{} = ... is missing", reading));
  Scene scratch;
  try {
    apply_set(scratch, fmt::format("{}={}", key, literal(*node)), reading);
  } catch (const InputError& error) {
    in.refuse(reading, error.what());
  }
  return literal(*node);
}

PaperReading read_reading(const fs::path& file, const Paper& paper) {
  const toml::table table = read_toml(file);
  TomlTable in(file, table, "");
  PaperReading result{std::string(paper.letter), in.required_text("paper"), in.flag("first_light"), {}};
  if (result.paper != paper.key) in.refuse("paper", fmt::format("paper must be \"{}\"", paper.key));
  in.texts("open");
  const toml::node* keys = in.get("key");
  in.finish();
  if (!keys || !keys->is_array_of_tables()) in.refuse("key", "a reading needs [[key]]");
  for (const toml::node& node : *keys->as_array()) {
    TomlTable key(file, *node.as_table(), "key");
    ReadingKey entry;
    entry.name = key.required_text("name");
    key.rename(entry.name);
    entry.section = key.required_text("section");
    entry.paper = reading_value(key, entry.name, "paper");
    entry.pelage = reading_value(key, entry.name, "pelage");
    key.required_text("text");
    key.text("repair");
    key.finish();
    result.keys.push_back(std::move(entry));
  }
  return result;
}

}  // namespace

const std::vector<PaperReading>& paper_readings() {
  static const std::vector<PaperReading> all = [] {
    const fs::path folder = data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR).back() / "readings";
    std::vector<PaperReading> readings;
    for (const Paper& paper : papers)
      readings.push_back(read_reading(folder / fmt::format("{}.toml", paper.key), paper));
    return readings;
  }();
  return all;
}

const PaperReading& reading_of(const Scene& scene, std::string_view pipeline) {
  const std::string_view drawn = pipeline.empty() ? std::string_view(scene.pipeline) : pipeline;
  const std::string_view letter = drawn.starts_with("strands")   ? "D"
                                  : has_springs(scene.dynamics)  ? "B"
                                  : scene.shading.model == "wet" ? "W"
                                                                 : "S";
  return *std::ranges::find(paper_readings(), letter, &PaperReading::letter);
}

void read_lights(Scene& scene, const PaperReading& reading) {
  if (!reading.first_light) return;
  scene.shading.lights.resize(1);
  scene.shading.lights.front().intensity = 1;
}

void apply_reading(Scene& scene, std::string_view reading, const PaperReading& paper) {
  if (std::ranges::find(reading_names, reading) == reading_names.end())
    throw InputError(
        fmt::format("reading '{}' is unknown (known: {})", reading, fmt::join(reading_names, ", ")));
  if (reading == "pelage") return;
  for (const ReadingKey& key : paper.keys)
    apply_set(scene, fmt::format("{}={}", key.name, key.paper), "--reading");
  read_lights(scene, paper);
}

}  // namespace pelage
