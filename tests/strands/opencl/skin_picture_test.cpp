// Compares the device's pictures of strands above a skin with the double-precision reference.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/compare/metrics.hpp"
#include "harness/strands/opencl/drawer.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "harness/strands/scene/strand_input.hpp"
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

struct OnSkin {
  Picture picture, expected;
};

OnSkin draw(const Scene& scene, const DrawerOptions& options = {}) {
  static const cl::Queue queue(cl::choose_device(""));
  const auto input = prepare_strands(scene, torus());
  const DrawingScene drawing{input->camera, input->look, input->range, input->dynamics.first_segment,
                             input->skin};
  Drawer drawer(queue, drawing, input->fur.strands, input->fur.keys.size(), options);
  const std::vector<float> records = key_records(input->fur.keys);
  drawer.keys().write(queue, records);
  const std::vector<DrawnStrand> curves = drawer.curves(queue);
  drawer.enqueue(queue, nullptr);
  return {drawer.read(queue),
          reference::draw(input->camera, input->look, curves,
                          reference::drawing_order(input->camera, input->range, curves), input->skin.get())};
}

void expect_agreement(const OnSkin& result) {
  const Agreement found = compare(result.picture, result.expected);
  EXPECT_TRUE(within(found)) << found.psnr << " dB, 99.9th percentile " << found.p999;
}

double changed(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixel.size(); ++i) count += a.pixel[i] != b.pixel[i];
  return double(count) / double(a.pixel.size());
}

TEST(SkinPicture, IsThatOfTheReference) {
  for (const Drawing mapping : {Drawing::item, Drawing::group}) {
    DrawerOptions options;
    options.mapping = mapping;
    expect_agreement(draw(scene_with(3000), options));
  }
}

TEST(SkinPicture, WithFewLightsIsThatOfTheReference) {
  Scene scene = scene_with(500);
  scene.strands.rim = glm::vec3(0);
  scene.strands.skin_shadow = 0;
  scene.strands.shadow = "none";
  scene.shading.lights.resize(1);
  expect_agreement(draw(scene));
}

TEST(SkinPicture, InsideTheObjectIsThatOfTheReference) {
  Scene scene = scene_with(2000);
  scene.camera.framed = false;
  scene.camera.eye = {0.62f, 0.1f, 0.1f};  // triangles cross the near plane
  scene.camera.target = {0, 0, 0.7f};
  expect_agreement(draw(scene));
}

TEST(SkinPicture, HidesStrandsAndIsOpaque) {
  Scene scene = scene_with(300);
  const OnSkin with = draw(scene);
  scene.strands.skin = false;
  const OnSkin without = draw(scene);
  std::size_t opaque = 0, opaque_without = 0;
  for (const glm::vec4& pixel : with.picture.pixel) opaque += pixel.w == 1.0f;
  for (const glm::vec4& pixel : without.picture.pixel) opaque_without += pixel.w == 1.0f;
  EXPECT_GT(opaque, with.picture.pixel.size() / 10);
  EXPECT_LT(opaque_without, opaque / 10);
  EXPECT_GT(changed(with.picture, without.picture), 0.1);
}

TEST(SkinPicture, HasEqualBitsInEveryRunAndDivision) {
  const Scene scene = scene_with(3000);
  const Picture first = draw(scene).picture;
  for (const int chunks : {1, 7, 64}) {
    DrawerOptions options;
    options.chunks = chunks;
    EXPECT_EQ(draw(scene, options).picture.pixel, first.pixel);
  }
}

// A frame after another camera must not keep blocks of the picture before it.
TEST(SkinPicture, FollowsTheCamera) {
  const cl::Queue queue(cl::choose_device(""));
  Scene scene = scene_with(400);
  const auto near = prepare_strands(scene, torus());
  scene.camera.framed = false;
  scene.camera.eye = {2.8f, 2.5f, 5.0f};
  const auto far = prepare_strands(scene, torus());
  const auto drawing_of = [&](const StrandInput& input) {
    return DrawingScene{input.camera, input.look, input.range, input.dynamics.first_segment, near->skin};
  };
  const std::vector<float> records = key_records(near->fur.keys);
  const auto far_picture = [&](bool near_first) {
    Drawer drawer(queue, drawing_of(near_first ? *near : *far), near->fur.strands, near->fur.keys.size());
    drawer.keys().write(queue, records);
    drawer.enqueue(queue, nullptr);
    if (near_first) {
      drawer.set_view(drawing_of(*far));
      drawer.enqueue(queue, nullptr);
    }
    return drawer.read(queue);
  };
  EXPECT_EQ(far_picture(true).pixel, far_picture(false).pixel);
}

}  // namespace
}  // namespace pelage::strands
