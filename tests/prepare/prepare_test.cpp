#include "harness/prepare/prepare.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/error.hpp"
#include "tests/prepare/meshes.hpp"

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

}  // namespace
}  // namespace pelage
