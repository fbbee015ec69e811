// Tests the table of systems, and the keys of a scene that a pipeline does not use.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "harness/scene/pipelines.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/system/renderer.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

TEST(Systems, HaveTheBackendsThatScenesName) {
  std::set<std::string_view> backends, names;
  for (const System* system : systems())
    for (const BackendKind& kind : system->backends) {
      EXPECT_TRUE(backends.insert(kind.name).second) << kind.name;
      EXPECT_EQ(backend_named(kind.name).system, system);
    }
  for (const PipelineName& pipeline : drawing_pipelines()) EXPECT_TRUE(names.insert(pipeline.name).second);
  EXPECT_EQ(names, backends);
  EXPECT_FALSE(backend_named("string"));
}

Picture drawn(const Scene& scene, std::string_view pipeline) {
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 12, 8));
  return Renderer(backend_named(pipeline), {}, scene).draw(scene, mesh);
}

/// Changes every number, truth value and colour that the pipeline does not use.
Scene with_ignored_keys_changed(Scene scene, const PipelineName& pipeline, std::size_t& changed) {
  for (const Key& key : scene_keys(scene)) {
    if (!pipeline.ignores(key.name, scene)) continue;
    if (auto* const* real = std::get_if<float*>(&key.slot))
      **real = std::nextafter(**real * 0.9f + 0.01f, 1.0f);
    else if (auto* const* whole = std::get_if<int*>(&key.slot))
      **whole = key.power_of_two ? 2 * **whole : **whole + 1;
    else if (auto* const* vector = std::get_if<glm::vec3*>(&key.slot))
      **vector = **vector * 0.9f + 0.01f;
    else
      continue;
    ++changed;
  }
  return scene;
}

// The warning of render says that these keys have no effect on the picture.
TEST(IgnoredKeys, DoNotChangeThePicture) {
  for (const char* name : {"reference", "strands-reference", "strands-raycast"}) {
    SCOPED_TRACE(name);
    Scene scene;
    scene.image.width = 60;
    scene.image.height = 40;
    scene.fur.layers = 3;
    scene.fur.texture = 32;
    scene.dynamics.gravity = {0, -4, 0};
    scene.strands.layers.front().count = 300;
    const auto pipelines = drawing_pipelines();
    const auto pipeline = std::find_if(pipelines.begin(), pipelines.end(),
                                       [&](const PipelineName& p) { return p.name == name; });
    ASSERT_NE(pipeline, pipelines.end());
    std::size_t changed = 0;
    const Scene other = with_ignored_keys_changed(scene, *pipeline, changed);
    EXPECT_GT(changed, 20u);
    EXPECT_TRUE(drawn(scene, name).pixel == drawn(other, name).pixel);
  }
}

// A renderer continues its simulation only where the picture has the bits of a new renderer.
TEST(Renderer, DrawsTheBitsOfANewRenderer) {
  Scene scene;
  scene.image.width = 60;
  scene.image.height = 40;
  scene.strands.layers.front().count = 300;
  scene.dynamics.gravity = {0, -4, 0};
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 12, 8));
  Renderer renderer(backend_named("strands-reference"), {}, scene);
  Scene later = scene, lit = scene, heavier = scene, earlier = scene;
  later.dynamics.time = 0.1f;
  lit.dynamics.time = 0.1f;
  lit.shading.ambient = 0.4f;
  heavier.dynamics.time = 0.1f;
  heavier.dynamics.gravity = {0, -6, 0};
  std::set<std::vector<float>> different;
  for (const Scene& shown : {scene, later, lit, heavier, earlier}) {
    const Picture picture = renderer.draw(shown, mesh);
    EXPECT_TRUE(picture.pixel == drawn(shown, "strands-reference").pixel);
    std::vector<float> values;
    for (const glm::vec4& p : picture.pixel) values.insert(values.end(), {p.x, p.y, p.z, p.w});
    different.insert(values);
  }
  EXPECT_EQ(different.size(), 4u);
}

}  // namespace
}  // namespace pelage
