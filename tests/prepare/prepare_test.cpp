#include "harness/prepare/prepare.hpp"

#include <algorithm>
#include <cmath>

#include "harness/error.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/prepare/random.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "tests/prepare/meshes.hpp"
#include "tests/support/files.hpp"

namespace pelage {
namespace {

Scene small_scene() {
  Scene scene;
  scene.fur.layers = 4;
  scene.fur.texture = 32;
  scene.coat.texture = 64;
  scene.wetness.size = 64;
  scene.wetness.random = 100;
  return scene;
}

TEST(Prepare, FillsEveryPart) {
  const auto mesh = test::two_charts();
  const auto input = prepare(small_scene(), mesh);
  EXPECT_EQ(input->mesh, mesh);
  EXPECT_EQ(input->strands.root.size(), mesh->triangle.size());
  EXPECT_EQ(input->strands.normal.size(), mesh->triangle.size());
  EXPECT_EQ(input->strands.anchor.size(), mesh->triangle.size());
  EXPECT_EQ(input->strands.phase.size(), mesh->triangle.size());
  EXPECT_EQ(input->strands.row.size(), mesh->welded + 1u);
  EXPECT_EQ(input->curl.u.size(), mesh->welded);
  EXPECT_EQ(input->curl.mask_uv.size(), mesh->welded);
  EXPECT_EQ(input->tangents.t.size(), mesh->position.size());
  EXPECT_EQ(input->fur.layers, 4);
  EXPECT_EQ(input->coat.size, 64);
  EXPECT_GT(input->droplets.size(), 50u);
  EXPECT_EQ(input->mask_surface.size(), 64u * 64u);
  EXPECT_GT(input->camera.width, 0);
}

TEST(Prepare, IsAFunctionOfItsArguments) {
  const auto mesh = test::two_charts();
  const auto a = prepare(small_scene(), mesh), b = prepare(small_scene(), mesh);
  EXPECT_EQ(a->strands.anchor, b->strands.anchor);
  EXPECT_EQ(a->fur.level, b->fur.level);
  EXPECT_EQ(a->coat.texel, b->coat.texel);
  EXPECT_EQ(a->curl.u, b->curl.u);
  EXPECT_EQ(a->camera.eye, b->camera.eye);
}

TEST(Prepare, AnotherViewOfTheSameInputIsPreparedAlike) {
  const auto mesh = test::two_charts();
  Scene turned = small_scene();
  turned.camera.direction = {-1.0f, 0.5f, 2.0f};
  turned.camera.fov = 20;
  turned.shading.ambient = 0.7f;
  const auto before = prepare(small_scene(), mesh), wanted = prepare(turned, mesh),
             changed = with_view(*before, turned, framed_points(*before));
  EXPECT_NE(before->camera.eye, wanted->camera.eye);
  EXPECT_EQ(changed->camera.eye, wanted->camera.eye);
  EXPECT_EQ(changed->camera.row_x, wanted->camera.row_x);
  EXPECT_EQ(changed->camera.row_y, wanted->camera.row_y);
  EXPECT_EQ(changed->camera.row_w, wanted->camera.row_w);
  EXPECT_EQ(changed->camera.pixel, wanted->camera.pixel);
  EXPECT_EQ(changed->scene.shading.ambient, 0.7f);
  EXPECT_EQ(changed->mesh, mesh);
  EXPECT_EQ(changed->mask_surface, wanted->mask_surface);
}

TEST(Prepare, FurRepeatsAsOftenPerRAlongBothAxes) {
  const Scene scene = small_scene();
  const auto mesh = test::two_charts();
  const auto input = prepare(scene, mesh);
  EXPECT_FLOAT_EQ(input->fur_scale.x, scene.fur.tile * mesh->length_per_uv.x);
  const auto torus = prepare(scene, load_model("torus"));  // periodic UV map
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_EQ(torus->fur_scale[axis], std::round(torus->fur_scale[axis]));
    EXPECT_NEAR(torus->fur_scale[axis] / torus->mesh->length_per_uv[axis], scene.fur.tile,
                0.3 * scene.fur.tile);
  }
}

TEST(Prepare, RefusesAnEmptyMesh) {
  EXPECT_THROW(prepare(small_scene(), nullptr), InputError);
  EXPECT_THROW(prepare(small_scene(), std::make_shared<Mesh>()), InputError);
}

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
  const test::Folder folder;
  Scene scene =
      of_model(folder.write("mesh.obj",
                            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.25 0.25\nvt 0.75 0.25\nvt 0.75 0.5\n"
                            "vt 0.25 0.5\nf 1/1 2/2 3/3 4/4\n"));
  SceneMeshes meshes;
  const auto computed = meshes.of(scene, {});
  EXPECT_EQ(std::count(computed->uv.begin(), computed->uv.end(), glm::vec2(0.75f, 0.5f)), 0);
  scene.fur.uv = "file";
  const auto kept = meshes.of(scene, {});
  EXPECT_EQ(std::count(kept->uv.begin(), kept->uv.end(), glm::vec2(0.75f, 0.5f)), 1);
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
  const test::Folder folder;
  Scene scene = of_model(folder.write("two.off",
                                      "OFF\n7 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 0\n4 0 0\n3 1 0\n"
                                      "3 0 1 2\n3 0 2 3\n3 4 5 6\n"));
  SceneMeshes meshes;
  EXPECT_EQ(meshes.of(scene, {})->triangle.size(), 3u);
  scene.mesh.components = "largest";
  EXPECT_EQ(meshes.of(scene, {})->triangle.size(), 2u);
}

TEST(Random, IsTheSameEverywhere) {
  const Random random(1, 2);
  EXPECT_EQ(random.bits(0), Random(1, 2).bits(0));
  EXPECT_NE(random.bits(0), random.bits(1));
  EXPECT_NE(random.bits(0, 0), random.bits(0, 1));
  EXPECT_NE(random.bits(0), Random(2, 2).bits(0));
  EXPECT_NE(random.bits(0), Random(1, 3).bits(0));
  double sum = 0, square = 0;
  for (std::uint64_t i = 0; i < 100000; ++i) {
    const double u = random.uniform(i);
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    square += u * u;
  }
  EXPECT_NEAR(sum / 1e5, 0.5, 0.005);
  EXPECT_NEAR(square / 1e5, 1.0 / 3.0, 0.005);
}

}  // namespace
}  // namespace pelage
