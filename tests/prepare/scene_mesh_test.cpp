// Tests that the mesh options of a scene are applied, and that SceneMeshes keeps one mesh per combination of
// options.
#include "harness/prepare/scene_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "harness/mesh/quality.hpp"

namespace pelage {
namespace {

Scene of_model(const std::string& model) {
  Scene scene;
  scene.model = model;
  return scene;
}

TEST(SceneMesh, IsTurnedAsTheSceneSays) {
  Scene scene = of_model("square");
  const auto plain = load_scene_mesh(scene, {});
  scene.mesh.rotate = {0, 45, 0};
  const auto turned = load_scene_mesh(scene, {});
  EXPECT_NE(turned->hash, plain->hash);

  SceneMeshes meshes;
  EXPECT_EQ(meshes.of(scene, {})->hash, turned->hash);
  EXPECT_EQ(meshes.of(of_model("square"), {})->hash, plain->hash);
  EXPECT_EQ(meshes.of(scene, {}), meshes.of(scene, {}));  // both calls return a pointer to the same mesh
}

TEST(SceneMesh, ZUpAddsARotationAboutX) {
  MeshScene mesh;
  mesh.rotate = {10, 20, 30};
  EXPECT_EQ(rotation_of(mesh), glm::vec3(10, 20, 30));
  mesh.up = std::string("z");  // std::string avoids a false warning of g++ 12 (GCC bug 105651)
  EXPECT_EQ(rotation_of(mesh), glm::vec3(-80, 20, 30));
  mesh.rotate.x = -300;  // -300 - 90 = -390 is below -360, so 360 degrees are added
  EXPECT_EQ(rotation_of(mesh), glm::vec3(-30, 20, 30));
  mesh.rotate.x = 361;  // 361 - 90 = 271
  EXPECT_GT(rotation_of(mesh).x, 270);
}

TEST(SceneMesh, HasTheFilesOwnMapWhereTheSceneAsksForIt) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "pelage-scene-mesh.obj";
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.25 0.25\nvt 0.75 0.25\nvt 0.75 0.5\n"
                         "vt 0.25 0.5\nf 1/1 2/2 3/3 4/4\n";
  Scene scene = of_model(file.string());
  SceneMeshes meshes;
  const auto computed = meshes.of(scene, {});
  EXPECT_EQ(std::count(computed->uv.begin(), computed->uv.end(), glm::vec2(0.75f, 0.5f)), 0);
  scene.fur.uv = "file";
  const auto kept = meshes.of(scene, {});
  EXPECT_EQ(std::count(kept->uv.begin(), kept->uv.end(), glm::vec2(0.75f, 0.5f)), 1);
  std::filesystem::remove(file);
}

TEST(SceneMesh, HasAMoreEvenMapWhereTheSceneAsksForIt) {
  Scene scene = of_model("banisch-dog");
  SceneMeshes meshes;
  const UvQuality computed = uv_quality(*meshes.of(scene, {}));
  scene.fur.uv = "even";
  const UvQuality even = uv_quality(*meshes.of(scene, {}));
  EXPECT_LT(even.area_95 / even.area_5, 0.9 * computed.area_95 / computed.area_5);
  EXPECT_EQ(even.overlapping, 0.0);
  EXPECT_GT(even.charts, computed.charts);
}

TEST(SceneMesh, HasTheComponentsTheSceneAsksFor) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "pelage-scene-two.off";
  std::ofstream(file) << "OFF\n7 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 0\n4 0 0\n3 1 0\n"
                         "3 0 1 2\n3 0 2 3\n3 4 5 6\n";
  Scene scene = of_model(file.string());
  SceneMeshes meshes;
  EXPECT_EQ(meshes.of(scene, {})->triangle.size(), 3u);
  scene.mesh.components = "largest";
  EXPECT_EQ(meshes.of(scene, {})->triangle.size(), 2u);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace pelage
