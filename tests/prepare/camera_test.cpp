#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "harness/error.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/random.hpp"
#include "harness/prepare/skin.hpp"
#include "harness/prepare/strands.hpp"

namespace pelage {
namespace {

glm::vec3 project(const Camera& c, glm::vec3 p) {
  const glm::vec4 q(p, 1.0f);
  const float w = glm::dot(c.row_w, q);
  return {glm::dot(c.row_x, q) / w, glm::dot(c.row_y, q) / w, w};
}

TEST(Camera, APixelsRayHitsThePointThatFellOnIt) {
  CameraScene scene{.framed = false, .target = {0.1f, -0.2f, 0.05f}};
  const Camera c = make_camera(scene, {}, {}, 0);
  EXPECT_EQ(c.eye, scene.eye);
  const Random random(3, 0);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const glm::vec3 p(glm::dvec3(random.symmetric(i, 0), random.symmetric(i, 1), random.symmetric(i, 2)));
    const glm::vec3 s = project(c, p);
    ASSERT_GT(s.z, 0.0f);
    const glm::vec3 ray = glm::normalize(c.ray + s.x * c.ray_dx + s.y * c.ray_dy);
    EXPECT_LT(glm::length(glm::cross(ray, p - c.eye)), 1e-5f);
    EXPECT_GT(glm::dot(ray, p - c.eye), 0.0f);
  }
}

TEST(Camera, RightIsRightAndDownIsDown) {
  CameraScene scene{.framed = false, .eye = {0, 0, 3}, .near = 0.02f};
  const ImageScene image;
  const Camera c = make_camera(scene, image, {}, 0);
  EXPECT_GT(project(c, {1, 0, 0}).x, 1.0f);
  EXPECT_LT(project(c, {0, 1, 0}).y, -1.0f);
  EXPECT_NEAR(project(c, {0, 0, 0}).x, 0.0f, 1e-4f);
  EXPECT_NEAR(project(c, {0, 0, 0}).z, 3.0f, 1e-6f);
  EXPECT_EQ(c.width, image.width);
  EXPECT_EQ(c.height, image.height);
  EXPECT_EQ(c.near, 0.02f);
  // The origin is at view depth 3, where a pixel is 3 * c.pixel wide.
  EXPECT_NEAR(project(c, {3 * c.pixel, 0, 0}).x, 1.0f, 1e-4f);
  // The vertical field of view covers the whole height of the picture.
  const float edge = 3.0f * std::tan(glm::radians(0.5f * scene.fov));
  EXPECT_NEAR(project(c, {0, -edge, 0}).y, 0.5f * float(image.height), 0.01f);
}

TEST(Camera, FramesTheFurredModel) {
  const auto mesh = load_model("torus");
  const Skin skin = weld(*mesh);
  const auto tips = rest_tips(skin, make_strands(skin, {}, {}));
  for (const glm::ivec2 size : {glm::ivec2(800, 600), glm::ivec2(320, 200), glm::ivec2(400, 900)})
    for (const glm::vec3 direction : {glm::vec3(1.3f, 1.15f, 2.35f), glm::vec3(0, 0, 1), glm::vec3(0, 1, 0)})
      for (const float fov : {10.0f, 37.0f, 100.0f}) {
        CameraScene scene{.direction = direction, .fov = fov};
        ImageScene image{.width = size.x, .height = size.y};
        const float margin = 0.02f;
        const Camera c = make_camera(scene, image, tips, margin);
        float x0 = 1e9f, x1 = -1e9f, y0 = 1e9f, y1 = -1e9f;
        for (const glm::vec3& p : tips) {
          const glm::vec3 s = project(c, p);
          ASSERT_GT(s.z, scene.near);
          const float m = margin / (c.pixel * s.z);
          x0 = std::min(x0, s.x - m);
          x1 = std::max(x1, s.x + m);
          y0 = std::min(y0, s.y - m);
          y1 = std::max(y1, s.y + m);
        }
        const float height = (y1 - y0) / float(size.y), width = (x1 - x0) / float(size.x);
        EXPECT_LE(height, 0.9f);
        EXPECT_LE(width, 0.95f);
        EXPECT_TRUE(height > 0.8f || width > 0.9f) << size.x << "x" << size.y << " fov " << fov;
        EXPECT_NEAR(x0 + x1, 0.0f, 1.0f);
        EXPECT_NEAR(y0 + y1, 0.0f, 1.0f);
      }
}

TEST(Camera, FramesASmallThingFromTwiceTheNearPlane) {
  const std::vector<glm::vec3> points{{-0.01f, 0, 0.02f}, {0.01f, 0.01f, -0.02f}, {0, -0.01f, 0}};
  CameraScene scene{.direction = {0, 0, 1}, .near = 0.5f};
  const Camera c = make_camera(scene, {}, points, 0);
  float nearest = 1e9f;
  for (const glm::vec3& p : points) nearest = std::min(nearest, project(c, p).z);
  EXPECT_NEAR(nearest, 1.0f, 1e-5f);
}

TEST(Camera, LooksStraightDown) {
  CameraScene scene{.framed = false, .eye = {0, 2, 0}, .up = {0, 1, 0}};
  const Camera c = make_camera(scene, {}, {}, 0);
  EXPECT_NEAR(project(c, {0, 0, 0}).z, 2.0f, 1e-6f);
  EXPECT_NEAR(glm::length(c.ray_dx), c.pixel, 1e-9f);
}

TEST(Camera, RefusesAnEyeOnItsTarget) {
  CameraScene scene;
  scene.framed = false;
  scene.target = scene.eye;
  EXPECT_THROW(make_camera(scene, {}, {}, 0), InputError);
}

}  // namespace
}  // namespace pelage
