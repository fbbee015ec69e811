// Tests the scene of a picture at a time, and the comparison of two such scenes.
#include <gtest/gtest.h>

#include "harness/scene/keyframes.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

const char* const moving =
    "[dynamics]\ntime = 7.0\n[keyframes]\n\"fur.length\" = [[1.0, 0.1], [3.0, 0.2]]\n\"dynamics.time\" = "
    "[[0, 5.0]]\n";

bool none(std::string_view) {
  return false;
}

TEST(PictureScene, HasTheKeysAndTheTimeOfThePicture) {
  const Scene scene = picture_scene(parse_scene(moving, "scene.toml"), 2.0f);
  EXPECT_FLOAT_EQ(scene.fur.length, 0.15f);
  EXPECT_EQ(scene.dynamics.time, 2.0f);
  EXPECT_TRUE(scene.keyframes.tracks.empty());
}

TEST(PictureScene, IsTheSceneThatRenderDraws) {
  const Scene scene = parse_scene(moving, "scene.toml");
  for (const char* time : {"0", "1.7", "0.041666668"}) {
    Scene set = scene;
    apply_set(set, std::string("dynamics.time=") + time);
    const Scene rendered = scene_at(set, double(set.dynamics.time));
    EXPECT_TRUE(equal_except(picture_scene(scene, std::strtof(time, nullptr)), rendered, none)) << time;
  }
}

TEST(EqualExcept, ComparesEveryKeyAndList) {
  const Scene scene;
  EXPECT_TRUE(equal_except(scene, scene, none));
  Scene other = scene;
  other.camera.up.z = 0.25f;
  EXPECT_FALSE(equal_except(scene, other, none));
  EXPECT_TRUE(equal_except(scene, other, [](std::string_view key) { return key == "camera.up"; }));
  EXPECT_FALSE(equal_except(scene, other, [](std::string_view key) { return key == "camera.fov"; }));
  other = scene;
  other.shading.lights.back().intensity = 2;
  EXPECT_FALSE(equal_except(scene, other, [](std::string_view) { return true; }));
}

TEST(EqualExcept, ComparesBits) {
  Scene plus, minus;
  plus.dynamics.wind.direction = {0.0f, 0.0f, 1.0f};
  minus.dynamics.wind.direction = {-0.0f, 0.0f, 1.0f};
  EXPECT_FALSE(equal_except(plus, minus, none));
}

}  // namespace
}  // namespace pelage
