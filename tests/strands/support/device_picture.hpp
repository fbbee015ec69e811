// Pictures of strands that the tests draw on the device.
#pragma once
#include <gtest/gtest.h>

#include "harness/compare/metrics.hpp"
#include "harness/strands/opencl/drawer.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "tests/strands/support/ball.hpp"
#include "tests/strands/support/strands.hpp"

namespace pelage::strands {

/// Writes the key strands that a drawer draws. Returns its next picture.
inline Picture drawn_with(Drawer& drawer, const std::vector<KeyStrand>& keys) {
  const std::vector<float> records = key_records(keys);
  drawer.keys().write(test::queue(), records);
  drawer.enqueue(test::queue(), nullptr);
  return drawer.read(test::queue());
}

/// A picture, and what the device computed for it. The curves are those of all drawn strands, with their
/// widths.
struct DevicePicture {
  std::vector<DrawnStrand> curves;
  std::vector<Entry> order;
  std::vector<glm::vec4> map;
  Picture picture;
};

inline DevicePicture draw_on_device(const DrawingScene& scene, const std::vector<KeyedStrand>& strands,
                                    const std::vector<KeyStrand>& keys, const DrawerOptions& options = {}) {
  Drawer drawer(test::queue(), scene, strands, keys.size(), options);
  DevicePicture result;
  result.picture = drawn_with(drawer, keys);
  result.order = drawer.order(test::queue());
  result.map = drawer.opacity_map(test::queue());
  result.curves = reference::pruned(drawer.curves(test::queue()), scene.look);
  return result;
}
inline DevicePicture draw_on_device(const DrawingScene& scene, const Ball& ball,
                                    const DrawerOptions& options = {}) {
  return draw_on_device(scene, ball.strands, ball.keys, options);
}

/// Expects that the list of strands and the picture are those that the reference draws from the same curves.
inline void expect_reference_picture(const DrawingScene& scene, const DevicePicture& device) {
  const std::vector<Entry> order =
      reference::drawing_order(scene.camera, scene.range, device.curves, scene.look.back_facing);
  EXPECT_GT(order.size(), 50u);
  ASSERT_EQ(device.order, order);
  const Agreement found = compare(
      device.picture, reference::draw(scene.camera, scene.look, device.curves, order, scene.skin.get()));
  EXPECT_TRUE(within(found)) << found.psnr << " dB, 99.9th percentile " << found.p999;
}

}  // namespace pelage::strands
