// Compares the device's pictures of strands above a skin with the double-precision reference.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/strands/scene/strand_input.hpp"
#include "tests/strands/support/device_picture.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::strands {
namespace {

std::shared_ptr<const Mesh> torus() {
  return std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 40, 24));
}

/// A torus with short strands and all kinds of light.
Scene scene_with(int strands) {
  Scene scene;
  scene.model = "torus";
  scene.image.width = 210;
  scene.image.height = 150;
  scene.strands.rim = glm::vec3(0.2f);
  scene.strands.layers.front().count = strands;
  scene.strands.layers.front().length = 0.08f;
  return scene;
}

DrawingScene drawing_of(const StrandInput& input) {
  return {input.camera, input.look, input.range, input.dynamics.first_segment, input.skin};
}

DevicePicture draw(const Scene& scene, const DrawerOptions& options = {}) {
  const auto input = prepare_strands(scene, torus());
  return draw_on_device(drawing_of(*input), input->fur.strands, input->fur.keys, options);
}

void expect_agreement(const Scene& scene, const DrawerOptions& options = {}) {
  expect_reference_picture(drawing_of(*prepare_strands(scene, torus())), draw(scene, options));
}

double changed(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixel.size(); ++i) count += a.pixel[i] != b.pixel[i];
  return double(count) / double(a.pixel.size());
}

TEST(SkinPicture, IsThatOfTheReference) {
  for (const Drawing mapping : {Drawing::item, Drawing::group})
    expect_agreement(scene_with(3000), {.mapping = mapping});
}

TEST(SkinPicture, WithFewLightsIsThatOfTheReference) {
  Scene scene = scene_with(500);
  scene.strands.rim = glm::vec3(0);
  scene.strands.skin_shadow = 0;
  scene.strands.shadow = "none";
  scene.shading.lights.resize(1);
  expect_agreement(scene);
}

TEST(SkinPicture, InsideTheObjectIsThatOfTheReference) {
  Scene scene = scene_with(2000);
  scene.camera.framed = false;
  scene.camera.eye = {0.62f, 0.1f, 0.1f};  // triangles cross the near plane
  scene.camera.target = {0, 0, 0.7f};
  expect_agreement(scene);
}

TEST(SkinPicture, HidesStrandsAndIsOpaque) {
  Scene scene = scene_with(300);
  const Picture with = draw(scene).picture;
  scene.strands.skin = false;
  const Picture without = draw(scene).picture;
  std::size_t opaque = 0, opaque_without = 0;
  for (const glm::vec4& pixel : with.pixel) opaque += pixel.w == 1.0f;
  for (const glm::vec4& pixel : without.pixel) opaque_without += pixel.w == 1.0f;
  EXPECT_GT(opaque, with.pixel.size() / 10);
  EXPECT_LT(opaque_without, opaque / 10);
  EXPECT_GT(changed(with, without), 0.1);
}

TEST(SkinPicture, HasEqualBitsInEveryRunAndDivision) {
  const Scene scene = scene_with(3000);
  const Picture first = draw(scene).picture;
  for (const int chunks : {1, 7, 64}) EXPECT_EQ(draw(scene, {.chunks = chunks}).picture.pixel, first.pixel);
}

// A frame after another camera must not keep blocks of the picture before it.
TEST(SkinPicture, FollowsTheCamera) {
  Scene scene = scene_with(400);
  const auto near = prepare_strands(scene, torus());
  scene.camera.framed = false;
  scene.camera.eye = {2.8f, 2.5f, 5.0f};
  const auto far = prepare_strands(scene, torus());
  DrawingScene shown = drawing_of(*far);
  shown.skin = near->skin;
  const auto far_picture = [&](bool near_first) {
    Drawer drawer(test::queue(), near_first ? drawing_of(*near) : shown, near->fur.strands,
                  near->fur.keys.size());
    if (near_first) {
      drawn_with(drawer, near->fur.keys);
      drawer.set_view(shown);
    }
    return drawn_with(drawer, near->fur.keys);
  };
  EXPECT_EQ(far_picture(true).pixel, far_picture(false).pixel);
}

}  // namespace
}  // namespace pelage::strands
