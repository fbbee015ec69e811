// Tests keyframes of forces: the values of each simulated frame, and the scene of a picture.
#include <gtest/gtest.h>

#include "harness/error.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/scene/scene_toml.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

const char* const gust = R"(
[dynamics]
step = 0.0078125
substeps = 4

[keyframes]
"dynamics.wind.strength" = [[0.0, 0.25], [0.1, 0.75], [0.2, 0.0]]
"dynamics.wind.direction" = [[0.0, [1, 0, 0]], [1.0, [-1, 0, 0]]]
"fur.length" = [[0.0, 0.1], [1.0, 0.2]]
)";

TEST(ForceKeyframes, HaveTheValueOfTheBeginningOfEachFrame) {
  const Scene scene = parse_scene(gust, "s.toml");
  EXPECT_TRUE(forces_change(scene));
  for (const auto& [frame, strength] :
       {std::pair(0, .25), {1, .40625}, {3, .71875}, {4, .5625}, {7, .0}, {99, .0}})
    EXPECT_NEAR(dynamics_of_frame(scene, frame).wind.strength, strength, 1e-6) << frame;
  EXPECT_NEAR(dynamics_of_frame(scene, 8).wind.direction.x, .5, 1e-6);
  EXPECT_EQ(dynamics_of_frame(scene, 10).step, .0078125f);
  test::expect_has(test::refusal([&] { dynamics_of_frame(scene, 16); }),
                   "dynamics.wind.direction: points nowhere");
}

TEST(ForceKeyframes, StayInTheSceneOfAPicture) {
  const Scene scene = parse_scene(gust, "s.toml");
  const Scene then = picture_scene(scene, .3f);
  EXPECT_EQ(then.keyframes.tracks.size(), 2u);
  EXPECT_EQ(then.dynamics.wind.strength, .25f) << "the value at the time 0";
  EXPECT_NEAR(then.fur.length, .13, 1e-7);
  EXPECT_EQ(dynamics_of_frame(then, 8).wind.strength, dynamics_of_frame(scene, 8).wind.strength);
  const auto is_time = [](std::string_view key) { return key == "dynamics.time" || key == "fur.length"; };
  EXPECT_TRUE(equal_except(then, picture_scene(scene, .1f), is_time));
  EXPECT_FALSE(forces_change(scene_at(parse_scene("[keyframes]\n\"fur.length\" = [[0, 0.1]]", "s.toml"), 1)));
}

TEST(ForceKeyframes, AreGravityWindAndLocalForce) {
  for (const char* key :
       {"dynamics.gravity", "dynamics.wind.gust", "dynamics.poke.spread", "dynamics.poke.ray"})
    EXPECT_TRUE(is_force_key(key)) << key;
  for (const char* key : {"dynamics.step", "dynamics.wind.gust_at", "dynamics.motion.spin", "fur.length"})
    EXPECT_FALSE(is_force_key(key)) << key;
}

TEST(ForceKeyframes, AnInvalidForceIsAnError) {
  test::expect_has(test::refusal([] {
                     parse_scene("[keyframes]\n\"dynamics.poke.along\" = [[0, [0, 0, 1]], [1, [0, 0, 0]]]",
                                 "s.toml");
                   }),
                   "points nowhere");
}

TEST(ForceKeyframes, ThatTheSceneOfAnotherTimeDoesNotPermitAreAnError) {
  const std::string wind =
      "[dynamics]\ntopology = \"sticks\"\n[keyframes]\n\"dynamics.wind.strength\" = [[0, 0.03], [1, 0]]\n";
  EXPECT_NO_THROW(parse_scene(wind + "\"dynamics.drag\" = [[0, 0.004], [1, 0.001]]", "s.toml"));
  // Without drag, the picture at 1 s would lose the wind before.
  test::expect_has(
      test::refusal([&] { parse_scene(wind + "\"dynamics.drag\" = [[0, 0.004], [1, 0]]", "s.toml"); }),
      "keyframes at 1 s: dynamics.wind.strength: with a mass-spring topology, the wind has no effect");
  test::expect_has(test::refusal([] {
                     parse_scene(
                         "[keyframes]\n\"dynamics.topology\" = [[0, \"sticks\"], [1, \"silva\"]]\n"
                         "\"dynamics.poke.radius\" = [[0, 0.5], [1, 0]]",
                         "s.toml");
                   }),
                   "keyframes at 1 s: dynamics.poke.radius: not supported by dynamics.topology");
}

}  // namespace
}  // namespace pelage
