// Tests the limits of docs/strands.md (Level of detail): strands that appear and vanish must not flicker, and
// a part of the strands has the mean coverage of all strands. The camera moves away from a model in 120
// frames, from the distance at which the mean width of all strands is `least` pixels to ten times this
// distance, so that the drawn part of the strands falls from 100% to 10%.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/strands/drawing/detail.hpp"
#include "harness/strands/groom/fur.hpp"
#include "tests/strands/support/device_picture.hpp"
#include "tests/support/texts.hpp"

namespace pelage::strands {
namespace {

constexpr int frames = 120, finer = 4;
constexpr double least = 0.125;  // pixels

/// Averages `finer` x `finer` pixels.
Picture averaged(const Picture& fine) {
  Picture picture{fine.width / finer, fine.height / finer, {}};
  picture.pixel.resize(std::size_t(picture.width) * std::size_t(picture.height));
  const auto at = [](const Picture& p, int x, int y) {
    return std::size_t(y) * std::size_t(p.width) + std::size_t(x);
  };
  for (int y = 0; y < fine.height; ++y)
    for (int x = 0; x < fine.width; ++x)
      picture.pixel[at(picture, x / finer, y / finer)] += fine.pixel[at(fine, x, y)] / float(finer * finer);
  return picture;
}

/// Pictures of a model with 100,000 strands at several distances. The distance 1 is that from which the
/// object fills the picture.
class Views {
 public:
  Views(const Mesh& mesh, const Fur& fur, float reach, int scale)
      : keys_(fur.keys), reach_(reach), spread_(spread_of(fur.strands, mesh)) {
    scene_.image.width = 320 * scale;
    scene_.image.height = 240 * scale;
    framed_ = make_camera(scene_.camera, scene_.image, mesh.position, reach_ - 1);
    drawer_.emplace(test::queue(), at(1, 1), fur.strands, fur.keys.size());
  }

  Picture draw(double distance, float fraction) {
    drawer_->set_view(at(distance, fraction));
    return drawn_with(*drawer_, keys_);
  }

  double distance_of_width(double pixels) const {
    return double(spread_.width) / (double(framed_.pixel) * double(framed_.row_w.w) * pixels);
  }

  /// Returns the part of the strands that the scene key strands.least_width leaves at a distance.
  float fraction(double distance) const {
    return fraction_on_screen(at(distance, 1).camera, spread_, float(least));
  }

 private:
  DrawingScene at(double distance, float fraction) const {
    CameraScene camera = scene_.camera;
    camera.framed = false;
    const double depth = double(framed_.row_w.w);
    const glm::dvec3 target = glm::dvec3(framed_.eye) + depth * glm::dvec3(framed_.ray);
    camera.target = glm::vec3(target);
    camera.eye = glm::vec3(target - distance * depth * glm::dvec3(framed_.ray));
    DrawingScene view;
    view.camera = make_camera(camera, scene_.image, {}, 0);
    view.range = depth_range(view.camera, reach_);
    view.look.fraction = fraction;
    view.look.width_factor = overlap_factor(view.camera, view.look, spread_);
    return view;
  }

  std::vector<KeyStrand> keys_;
  float reach_;
  Spread spread_;
  Scene scene_;
  Camera framed_;
  std::optional<Drawer> drawer_;
};

/// The change of a picture's error from one frame to the next, as a sum of squares over the clip.
class Popping {
 public:
  void add(const Picture& picture, const Picture& reference) {
    std::vector<glm::vec4> error;
    for (std::size_t i = 0; i < picture.pixel.size(); ++i)
      error.push_back(picture.pixel[i] - reference.pixel[i]);
    for (std::size_t i = 0; i < before_.size(); ++i) {
      const glm::dvec3 change(error[i] - before_[i]);
      sum_ += glm::dot(change, change);
    }
    before_ = std::move(error);
  }
  double sum() const { return sum_; }

 private:
  std::vector<glm::vec4> before_;
  double sum_ = 0;
};

class Dolly : public testing::TestWithParam<const char*> {};

TEST_P(Dolly, HardlyPopsAndKeepsItsCoverage) {
  Scene scene;
  scene.model = GetParam();
  StrandLayerScene& layer = scene.strands.layers.front();
  layer.count = 100000;
  const auto mesh = load_scene_mesh(scene, {});
  const Fur fur = grow(*mesh, scene.strands, prepare(scene, mesh)->coat);
  const float reach = 1 + layer.length * (1 + layer.length_spread);
  Views views(*mesh, fur, reach, 1), fine(*mesh, fur, reach, finer);
  const double nearest = views.distance_of_width(least);
  for (const float fraction : {0.5f, 0.25f, 0.1f})
    for (const double distance : {1.0, nearest / double(fraction)}) {
      const double all = covered(views.draw(distance, 1));
      EXPECT_NEAR(covered(views.draw(distance, fraction)), all, 0.01 * all) << fraction;
    }
  Popping part, all;
  for (int t = 0; t < frames; ++t) {
    const double distance = nearest * std::pow(10, double(t) / (frames - 1));
    const Picture reference = averaged(fine.draw(distance, 1));
    part.add(views.draw(distance, views.fraction(distance)), reference);
    all.add(views.draw(distance, 1), reference);
  }
  EXPECT_GT(part.sum(), 0);
  EXPECT_LE(std::sqrt(part.sum() / all.sum()), 1.5);
}

INSTANTIATE_TEST_SUITE_P(LevelOfDetail, Dolly, testing::Values("bunny", "torus"), pelage::test::by_parameter);

}  // namespace
}  // namespace pelage::strands
