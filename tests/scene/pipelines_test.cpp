// Tests the scene key `pipeline`, and which keys of a scene a pipeline does not use.
#include "harness/scene/pipelines.hpp"

#include <gtest/gtest.h>

#include "harness/error.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

using Names = std::vector<std::string>;

TEST(ScenePipeline, IsShellsUnlessTheSceneNamesAnother) {
  EXPECT_EQ(parse_scene("", "a.toml").pipeline, "shells");
  EXPECT_EQ(parse_scene("pipeline = \"strands\"", "a.toml").pipeline, "strands");
  EXPECT_THROW(parse_scene("pipeline = \"string\"", "a.toml"), InputError);
  EXPECT_THROW(parse_scene("[keyframes]\npipeline = [[0.0, \"strands\"]]", "a.toml"), InputError);
}

// Rows of results that were recorded before the key existed must keep their scenes. This hash changed when
// clump.gain became the unit of the radius.
TEST(ScenePipeline, IsNotPartOfTheHash) {
  Scene scene = parse_scene(
      "model = \"torus-24x12\"\n[fur]\nlayers = 2\ntexture = 16\n[image]\nwidth = 16\nheight = 16", "a.toml");
  const std::string hash = scene_hash(scene);
  EXPECT_EQ(hash, "6d0d393538229082");
  scene.pipeline = "strands";
  EXPECT_EQ(scene_hash(scene), hash);
}

TEST(IgnoredKeys, OfTheDefaultSceneAreNone) {
  for (const PipelineName& pipeline : drawing_pipelines())
    EXPECT_EQ(ignored_keys(Scene{}, pipeline.name), Names{}) << pipeline.name;
}

TEST(IgnoredKeys, AreThoseThatThePipelineDoesNotUse) {
  const Scene both = parse_scene(
      "[fur]\nlength = 0.2\nuv = \"even\"\n[strands]\ntaper = 0.5\n[[strands.layer]]\ncount = 10\n"
      "[shading]\nambient = 0.1\nwrap = 0.1\n[dynamics.springs]\nstiffness = 2\n"
      "[keyframes]\n\"curl.radius\" = [[0.0, 0.1]]",
      "a.toml");
  EXPECT_EQ(ignored_keys(both, "shells"),
            (Names{"dynamics.springs.stiffness", "strands.taper", "strands.layer"}));
  EXPECT_EQ(ignored_keys(both, "strands"),
            (Names{"fur.length", "dynamics.springs.stiffness", "shading.wrap", "keyframes.\"curl.radius\""}));
  EXPECT_THROW(ignored_keys(both, "string"), InputError);
}

TEST(IgnoredKeys, DependOnTheTopology) {
  const Scene grass = parse_scene(
      "[dynamics]\ntopology = \"sticks\"\ndrag = 0.1\n[dynamics.springs]\nstiffness = 2", "a.toml");
  EXPECT_EQ(ignored_keys(grass, "shells"), Names{});
  EXPECT_EQ(ignored_keys(grass, "strands"),
            (Names{"dynamics.topology", "dynamics.drag", "dynamics.springs.stiffness"}));
  EXPECT_EQ(ignored_keys(parse_scene("[dynamics]\ntopology = \"chains\"", "a.toml"), "strands"), Names{});
}

}  // namespace
}  // namespace pelage
