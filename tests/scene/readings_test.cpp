// Tests the readings of the papers (readings/*.toml) and what --reading does to a scene.
#include "harness/scene/readings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "harness/error.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::string letter_of(const std::string& scene, std::string_view pipeline = {}) {
  return reading_of(parse_scene(scene, "s.toml"), pipeline).letter;
}

TEST(Readings, PelageIsTheDefault) {
  for (const PaperReading& reading : paper_readings()) {
    Scene scene;
    for (const ReadingKey& key : reading.keys) apply_set(scene, key.name + "=" + key.pelage);
    EXPECT_TRUE(changed_keys(scene).empty()) << reading.paper << ": " << changed_keys(scene).front().first;
  }
}

TEST(Readings, EachKeyOfAFileOccursOnce) {
  for (const PaperReading& reading : paper_readings()) {
    std::set<std::string> names;
    for (const ReadingKey& key : reading.keys) EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_GE(names.size(), 5u);
  }
}

TEST(Readings, ThePaperIsThatOfTheMethod) {
  EXPECT_EQ(letter_of(""), "S");
  EXPECT_EQ(letter_of("shading.model = \"wet\""), "W");
  EXPECT_EQ(letter_of("shading.model = \"wet\"\ndynamics.topology = \"prisms\""), "B");
  EXPECT_EQ(letter_of("pipeline = \"strands\""), "D");
  EXPECT_EQ(letter_of("", "strands+opengl"), "D");
  EXPECT_EQ(letter_of("pipeline = \"strands\"", "shells"), "S");
}

TEST(Readings, ThePapersOfSilvaHaveUprightFurAndPlainLight) {
  for (const char* model : {"curling", "wet"}) {
    Scene scene;
    scene.shading.model = model;
    scene.soaked.threshold = .5f;
    scene.fur.comb_noise = .3f;
    apply_reading(scene, "paper", reading_of(scene, {}));
    EXPECT_NO_THROW(check_scene(scene));
    EXPECT_EQ(scene.shading.model, model);
    EXPECT_EQ(scene.fur.comb, 0);
    EXPECT_EQ(scene.fur.comb_noise, 0);
    EXPECT_EQ(scene.soaked.threshold, 1);
    EXPECT_EQ(scene.shading.wrap, 0);
    EXPECT_EQ(scene.shading.ambient, 0);
    ASSERT_EQ(scene.shading.lights.size(), 1u);
    EXPECT_EQ(scene.shading.lights[0].intensity, 1);
    EXPECT_EQ(scene.shading.lights[0].direction, LightScene{}.direction);
    EXPECT_EQ(scene.wetness.spacing, 0);
    EXPECT_EQ(scene.wetness.blend, "near");
    EXPECT_EQ(scene.clump.cells, "literal");
    EXPECT_EQ(scene.clump.gain, 256);
    EXPECT_EQ(scene.blend.faces, "all");
  }
}

TEST(Readings, PelageAndScenesOfTheirOwn) {
  const Scene scene = parse_scene(
      "fur.comb = 0.3\nfur.length = 0.2\n[keyframes]\n\"shading.wrap\" = [[0.0, 0.1], [1.0, 0.9]]\n",
      "s.toml");
  Scene read = scene;
  apply_reading(read, "pelage", reading_of(read, {}));
  EXPECT_EQ(scene_hash(read), scene_hash(scene));
  apply_reading(read, "paper", reading_of(read, {}));
  EXPECT_EQ(read.fur.length, .2f);  // the paper leaves it open
  EXPECT_EQ(scene_at(read, .5).shading.wrap, 0);
  EXPECT_THROW(apply_reading(read, "loose", reading_of(read, {})), InputError);
}

TEST(Readings, EveryExampleCanBeReadAsThePaper) {
  for (const auto& entry : fs::directory_iterator(fs::path(PELAGE_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() != ".toml") continue;
    Scene scene = read_scene(entry.path());
    apply_reading(scene, "paper", reading_of(scene, {}));
    EXPECT_NO_THROW(check_scene(scene)) << entry.path();
  }
}

}  // namespace
}  // namespace pelage
