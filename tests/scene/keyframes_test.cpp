// Tests keys that change over time: reading, errors, interpolation, writing and hashing. Tests the motion of
// colliders.
#include "harness/scene/keyframes.hpp"

#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/scene/scene_toml.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

const std::vector<test::Bad> bad_keyframes = {
    {"[keyframes]\n\"strands.fractoin\" = [[0, 1]]",
     "s.toml:2: keyframes.\"strands.fractoin\": no such key; did you mean strands.fraction?"},
    {"[keyframes]\n\"model\" = [[0, \"torus\"]]", "s.toml:2: keyframes.\"model\": this key cannot change"},
    {"[keyframes]\n\n\"mesh.up\" = [[0, \"z\"]]", "s.toml:3: keyframes.\"mesh.up\": this key cannot change"},
    {"[keyframes]\n\"shading.light\" = [[0, 1]]", "s.toml:2: keyframes.\"shading.light\": no such key"},
    {"keyframes = 3", "s.toml:1: keyframes: is a whole number; give a TOML table [keyframes]"},
    {"[keyframes]\n\"strands.fraction\" = 0.5",
     "s.toml:2: keyframes.\"strands.fraction\": is a number; give pairs [time in s, value], where the value is 0.001 to 1"},
    {"[keyframes]\n\"strands.fraction\" = []", "has 0 keyframes; give 1 to 1000"},
    {"[keyframes]\n\"strands.fraction\" = [0, 1]",
     "keyframes.\"strands.fraction\"[1]: is a whole number; give pairs"},
    {"[keyframes]\n\"strands.fraction\" = [[0, 1, 2]]", "[1]: has 3 entries; give pairs"},
    {"[keyframes]\n\"strands.fraction\" = [\n  [0, 1],\n  [\"1 s\", 1]\n]",
     "s.toml:4: keyframes.\"strands.fraction\"[2]: its time is a string; give pairs"},
    {"[keyframes]\n\"strands.fraction\" = [\n  [0, 1],\n  [1, 2]\n]",
     "s.toml:4: keyframes.\"strands.fraction\"[2]: 2 is out of range; give 0.001 to 1"},
    {"[keyframes]\n\"strands.fraction\" = [[0, \"one\"]]", "[1]: is a string; give 0.001 to 1"},
    {"[keyframes]\n\"strands.segments\" = [[0, 2.5]]", "[1]: is a number; give 1 to 7"},
    {"[keyframes]\n\"camera.framed\" = [[0, 1]]", "[1]: is a whole number; give true or false"},
    {"[keyframes]\n\"strands.shadow\" = [[0, \"soft\"]]", "[1]: \"soft\" is not known"},
    {"[keyframes]\n\"camera.direction\" = [[0, [1, 0]]]", "[1]: has 2 entries; give a direction"},
    {"[keyframes]\n\"camera.direction\" = [[0, [0, 0, 0]]]", "[1]: points nowhere"},
    {"[keyframes]\n\"strands.fraction\" = [[1, 1], [1, 0.5]]",
     "[2]: the time 1 s is not after 1 s; give ascending times"},
    {"[keyframes]\n\"strands.fraction\" = [[2, 1], [1, 0.5]]", "[2]: the time 1 s is not after 2 s"},
    {"[keyframes]\n\"strands.fraction\" = [[-1, 1]]", "[1]: the time -1 s is out of range; give 0 to 3600 s"},
    {"[keyframes]\n\"strands.fraction\" = [[nan, 1]]", "[1]: the time nan s is out of range"},
    {"[keyframes]\n\"camera.up\" = [[0, [0, 1, 0]], [2, [1.3, 1.15, 2.35]]]",
     "s.toml: keyframes at 2 s: camera.up: is parallel to the view"},
};

TEST(Keyframes, BadLinesAreErrorsWithFileLineAndKey) {
  test::expect_refusals(bad_keyframes, [](const std::string& text) { parse_scene(text, "s.toml"); });
}

const char* const lively = R"(
[strands]
fraction = 0.25

[keyframes]
"strands.fraction" = [[1.0, 1.0], [5, 0.2]]
"camera.direction" = [[0, [1, 0, 2]], [2, [2, 0, 1]], [3, [2, 4, 1]]]
"strands.segments" = [[0, 2], [1, 6], [2.5, 3]]
"strands.shadow" = [[0, "none"], [1.5, "exp"]]
camera.framed = [[0, true], [1, false]]
"coat.image" = [[0, ""], [4, "fur.png"]]
"coat.seed" = [[0, 4294967295]]
)";

TEST(Keyframes, AreInterpolated) {
  const Scene scene = parse_scene(lively, "s.toml", "/folder");
  EXPECT_EQ(scene.keyframes.tracks.size(), 7u);
  EXPECT_EQ(scene.strands.fraction, 0.25f) << "scene_at() alone uses the keyframes";
  for (const auto& [time, fraction] :
       std::vector<std::pair<double, double>>{{0, 1}, {1, 1}, {2, 0.8}, {4, 0.4}, {5, 0.2}, {900, 0.2}})
    EXPECT_NEAR(scene_at(scene, time).strands.fraction, fraction, 1e-7) << time;
  EXPECT_EQ(scene_at(scene, 5).strands.fraction, 0.2f);
  const auto direction = [&](double time) { return scene_at(scene, time).camera.direction; };
  EXPECT_EQ(direction(-3), glm::vec3(1, 0, 2));
  EXPECT_LT(glm::distance(direction(0.5), glm::vec3(1.25f, 0, 1.75f)), 1e-6f);
  EXPECT_EQ(direction(2), glm::vec3(2, 0, 1));
  EXPECT_LT(glm::distance(direction(2.75), glm::vec3(2, 3, 1)), 1e-6f);
  EXPECT_EQ(direction(3.5), glm::vec3(2, 4, 1));
}

TEST(Keyframes, WholeNumbersTextsAndTruthValuesChangeInSteps) {
  const Scene scene = parse_scene(lively, "s.toml", "/folder");
  for (const auto& [time, segments] :
       std::vector<std::pair<double, int>>{{0, 2}, {0.999, 2}, {1, 6}, {2.499, 6}, {2.5, 3}, {9, 3}})
    EXPECT_EQ(scene_at(scene, time).strands.segments, segments) << time;
  EXPECT_EQ(scene_at(scene, 1.4).strands.shadow, "none");
  EXPECT_EQ(scene_at(scene, 1.5).strands.shadow, "exp");
  EXPECT_TRUE(scene_at(scene, 0.9).camera.framed);
  EXPECT_FALSE(scene_at(scene, 1).camera.framed);
  EXPECT_EQ(scene_at(scene, 3.9).coat.image, "");
  EXPECT_EQ(scene_at(scene, 4).coat.image, "/folder/fur.png") << "relative to the scene file";
  EXPECT_EQ(scene_at(scene, 7).coat.seed, 4294967295u);
}

TEST(Keyframes, AnOverrideAppliesAtAllTimes) {
  Scene scene = parse_scene(lively, "s.toml", "/folder");
  apply_set(scene, "strands.fraction=0.7");
  apply_set(scene, "strands.shadow=linear");
  apply_set(scene, "fur.length=0.2");
  EXPECT_EQ(scene.keyframes.tracks.size(), 5u);
  for (const double time : {0.0, 1.0, 3.0, 9.0}) {
    EXPECT_EQ(scene_at(scene, time).strands.fraction, 0.7f);
    EXPECT_EQ(scene_at(scene, time).strands.shadow, "linear");
  }
  EXPECT_EQ(scene_at(scene, 2).camera.direction, glm::vec3(2, 0, 1)) << "other keys keep their keyframes";

  const Scene edited = parse_scene("strands.segments = 4\n", "t.toml", "/folder", scene);
  EXPECT_EQ(edited.keyframes.tracks.size(), 4u);
  EXPECT_EQ(scene_at(edited, 2.5).strands.segments, 4);
  const Scene both = parse_scene("strands.segments = 4\nkeyframes.\"strands.segments\" = [[0, 5]]\n",
                                 "t.toml", "/folder", scene);
  EXPECT_EQ(scene_at(both, 0).strands.segments, 5) << "the keyframes of the same text count";
}

TEST(Keyframes, TheSceneAtATimeHasNoKeyframes) {
  const Scene scene = parse_scene(lively, "s.toml", "/folder");
  const Scene then = scene_at(scene, 2);
  EXPECT_TRUE(then.keyframes.tracks.empty());
  EXPECT_EQ(write_scene(scene_at(then, 4)), write_scene(then));
  EXPECT_EQ(write_scene(scene_at(Scene{}, 1)), write_scene(Scene{}));
  EXPECT_THROW(scene_at(scene, std::nan("")), InputError);
}

TEST(Keyframes, AnInvalidSceneBetweenTwoKeyframesIsAnError) {
  const Scene scene =
      parse_scene("[keyframes]\n\"camera.direction\" = [[0, [1, 0, 0]], [2, [-1, 0, 0]]]", "s.toml");
  EXPECT_NO_THROW(scene_at(scene, 0.5));
  const std::string said = test::refusal([&] { scene_at(scene, 1); });
  EXPECT_EQ(said.find("keyframes at 1 s: camera.direction: points nowhere"), 0u) << said;
}

TEST(Keyframes, SurviveWritingAndReading) {
  const Scene scene = parse_scene(lively, "s.toml", "/folder");
  const Scene again = parse_scene(write_scene(scene), "written");
  EXPECT_EQ(again.keyframes, scene.keyframes) << write_scene(scene);
  EXPECT_EQ(write_scene(again), write_scene(scene));
  // Later tables replace the track of a key in the base scene, and keep the other tracks.
  const Scene more = parse_scene("[keyframes]\n\"strands.fraction\" = [[0, 0.5]]", "more", ".", scene);
  EXPECT_EQ(more.keyframes.tracks.size(), 7u);
  EXPECT_EQ(scene_at(more, 3).strands.fraction, 0.5f);
  EXPECT_EQ(scene_at(more, 9).strands.segments, 3);
}

TEST(Keyframes, AreInTheHashOfTheScene) {
  const auto hash = [](const std::string& line) {
    return scene_hash(parse_scene("[keyframes]\n" + line, "s.toml"));
  };
  const std::string first = hash("\"strands.fraction\" = [[0, 1], [2, 0.5]]");
  EXPECT_NE(first, scene_hash(Scene{}));
  EXPECT_NE(first, hash("\"strands.fraction\" = [[0, 1], [3, 0.5]]"));
  EXPECT_NE(first, hash("\"strands.fraction\" = [[0, 1], [2, 0.6]]"));
  EXPECT_NE(first, hash("\"strands.opacity\" = [[0, 1], [2, 0.5]]"));
  EXPECT_EQ(first, hash("\"strands.fraction\" = [[0.0, 1.0], [2.0, 0.5]]"));
  const test::Folder folder;
  folder.write("a.png", "1");
  const auto hash_of_file = [&] {
    return hash("\"coat.image\" = [[0, \"" + (folder.path / "a.png").string() + "\"]]");
  };
  const std::string before = hash_of_file();
  folder.write("a.png", "2");
  EXPECT_NE(hash_of_file(), before) << "the content of the file counts";
}

TEST(Keyframes, CannotBeSet) {
  Scene scene = parse_scene(lively, "s.toml", "/folder");
  EXPECT_THROW(apply_set(scene, "keyframes=[]"), InputError);
}

TEST(Keyframes, TracksOfAProgramAreChecked) {
  const auto refused = [](const KeyTrack& track) {
    Scene scene;
    scene.keyframes.tracks = {track, {"strands.taper", {{0, 0.5f}}}};
    return test::refusal([&] { check_scene(scene, "test"); }, "no error");
  };
  EXPECT_EQ(refused({"strands.fraction", {{0, 0.5f}, {1, 0.7f}}}), "no error");
  test::expect_has(refused({"strands.fraction", {{0, 5}}}), "wrong type");
  test::expect_has(refused({"strands.fraction", {{0, 5.0f}}}), "out of range");
  test::expect_has(refused({"strands.fraction", {{1, 0.5f}, {0, 0.5f}}}), "ascending");
  test::expect_has(refused({"strands.fraction", {}}), "0 keyframes");
  test::expect_has(refused({"strands.taper", {{0, 0.5f}}}), "occurs twice");
  test::expect_has(refused({"mesh.up", {{0, std::string("z")}}}), "cannot change");
  test::expect_has(refused({"fraction", {{0, 0.5f}}}), "no such key");
}

const char* const moving =
    "[dynamics]\ntime = 7.0\n[keyframes]\n\"fur.length\" = [[1.0, 0.1], [3.0, 0.2]]\n\"dynamics.time\" = [[0, 5.0]]\n";

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

// The reference and the devices share these functions, so a comparison of their pictures finds no error here.
TEST(ContactMotion, StartsAtBeginMovesUniformlyAndStopsBeforeEnd) {
  const ContactMotion motion{.velocity = {2, 0, -1}, .begin = 0.5f, .end = 3};
  EXPECT_EQ(motion.moved({1, 2, 3}, 0.5), glm::dvec3(1, 2, 3));
  EXPECT_EQ(motion.moved({1, 2, 3}, 2.5), glm::dvec3(5, 2, 1));
  EXPECT_EQ(motion.moved({1, 2, 3}, 1e4 + 0.5), glm::dvec3(20001, 2, -9997));
  EXPECT_FALSE(motion.exists(0.49));
  EXPECT_TRUE(motion.exists(0.5));
  EXPECT_TRUE(motion.exists(2.99));
  EXPECT_FALSE(motion.exists(3));
}

}  // namespace
}  // namespace pelage
