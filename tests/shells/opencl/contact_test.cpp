// Tests colliders that push the fur (docs/shells.md, section 9) on the device.
#include "harness/shells/reference/contact.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "harness/compare/checks.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/shells/reference/layers.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/files.hpp"
#include "tests/support/style_scenes.hpp"

namespace pelage {
namespace {

using namespace pictures;
using namespace style_scenes;

// The axis of the torus is y. The circle in its tube has the radius 0.71, and the radius of the tube is 0.29.
ContactSphereScene ball() {
  ContactSphereScene ball;
  ball.centre = {0.72f, 0.7f, 0.1f};
  ball.radius = 0.36f;
  return ball;
}

ContactCapsuleScene bar() {
  ContactCapsuleScene bar;
  bar.from = {-0.4f, 0.57f, 0.5f};
  bar.to = {0.5f, 0.57f, 0.75f};
  bar.radius = 0.22f;
  bar.motion.velocity = {0.1f, 0, 0};
  return bar;
}

ContactMeshScene body(const std::filesystem::path& file) {
  ContactMeshScene body;
  body.file = file;
  body.position = {-0.5f, 0.5f, 0.5f};
  body.scale = 0.4f;
  body.cells = 32;
  return body;
}

/// A torus with long fur, without colliders unless `change` adds some.
std::shared_ptr<const FrameInput> long_fur(const std::function<void(Scene&)>& change = {}) {
  return small_torus([&](Scene& s) {
    s.model = "torus-60x36";
    s.mesh.rotate = {-25, 0, 0};  // the torus of load_model() is tilted by 25 degrees
    s.fur.length = 0.26f;
    s.fur.comb = 0.2f;
    if (change) change(s);
  });
}

struct Contact : testing::Test {
  test::Folder folder;
  std::filesystem::path torus = folder.path / "torus.ply";

  Contact() { write_ply(torus, *load_model("torus-24x16")); }

  std::shared_ptr<const FrameInput> pressed(const std::function<void(Scene&)>& change = {}) const {
    return long_fur([&](Scene& s) {
      s.contact.spheres = {ball()};
      s.contact.capsules = {bar()};
      s.contact.mesh = body(torus);
      if (change) change(s);
    });
  }
};

TEST_F(Contact, LooksLikeTheReferenceInAllMappings) {
  for (const int substeps : {1, 4}) {
    const auto input = pressed([&](Scene& s) { s.fur.substeps = substeps; });
    const Picture expected = drawn_by_reference(*input);
    for (const std::string& mapping : mappings())
      EXPECT_TRUE(same(expected, drawn_by_device(input, mapping))) << mapping << ", " << substeps;
    const auto free = long_fur([&](Scene& s) { s.fur.substeps = substeps; });
    EXPECT_LT(compare(expected, drawn_by_reference(*free)).psnr, 45) << "the colliders change too little";
  }
}

TEST_F(Contact, MovesTheTipsOfTheReference) {
  const auto input = pressed();
  Shells shells(device(), input);
  shells.advance(frames);
  std::vector<glm::vec3> expected;
  std::size_t moved = 0;
  const auto free = long_fur();
  for (std::size_t f = 0; f < input->strands.root.size(); ++f) {
    expected.emplace_back(reference::simulate(*input, f, frames).tip);
    if (glm::distance(glm::dvec3(expected.back()), reference::simulate(*free, f, frames).tip) > 1e-3) ++moved;
  }
  const TipErrors errors = tip_errors(double(input->scene.fur.length), shells.tips(), expected);
  EXPECT_TRUE(check_usual_tip(errors).holds());
  EXPECT_GT(moved, 100u);
}

// The measure of the depth is the true distance for spheres and capsules, and the field for the mesh.
TEST_F(Contact, LeavesNoLayerDeeperInsideThanOneSpacing) {
  const auto input = pressed();
  const double time = reference::time_after(input->scene.dynamics, frames);
  const reference::Colliders colliders(*input, time);
  const reference::Geometry geometry(*input, reference::wetness_mask(*input), frames);
  const auto free_input = long_fur();
  const reference::Geometry free(*free_input, reference::wetness_mask(*free_input), frames);
  const double spacing = double(input->scene.fur.length) / input->scene.fur.layers;
  double deepest = 0, deepest_before = 0;
  std::size_t pushed = 0;
  for (std::size_t slot = 0; slot < geometry.slots(); ++slot) {
    ASSERT_GT(colliders.distance(geometry.position(slot, -1)), 0) << "the base must be outside";
    for (int n = 0; n < input->scene.fur.layers; ++n) {
      deepest = std::max(deepest, -colliders.distance(geometry.position(slot, n)));
      deepest_before = std::max(deepest_before, -colliders.distance(free.position(slot, n)));
      if (glm::distance(geometry.position(slot, n), free.position(slot, n)) > spacing) ++pushed;
    }
  }
  RecordProperty("deepest", fmt::format("{:.3g} R, without contact {:.3g} R, spacing {:.3g} R, {} moved",
                                        deepest, deepest_before, spacing, pushed));
  EXPECT_GT(deepest_before, 3 * spacing);
  EXPECT_GT(pushed, 500u);
  EXPECT_LT(deepest, 1e-3 * spacing);
}

// The colliders arrive, push the fur, and disappear; the fur must return to rest.
TEST_F(Contact, EndsWithFurAtRest) {
  const auto input = pressed([](Scene& s) {
    s.dynamics.wind.strength = 0;
    s.contact.spheres[0].motion.end = s.contact.capsules[0].motion.end = s.contact.mesh.motion.end = 0.2f;
  });
  const auto at_rest = long_fur([](Scene& s) { s.dynamics.wind.strength = 0; });
  Shells shells(device(), input), free(device(), at_rest);
  shells.advance(11);
  free.advance(11);
  const double length = double(input->scene.fur.length);
  EXPECT_GT(tip_errors(length, shells.tips(), free.tips()).worst, 0.2);
  shells.advance(240);
  free.advance(240);
  EXPECT_LT(tip_errors(length, shells.tips(), free.tips()).worst, tolerance::usual_tip);
  for (const glm::vec3& v : shells.velocities()) EXPECT_LT(glm::length(v), tolerance::velocity);
  shells.frame();
  free.frame();
  EXPECT_GT(compare(shells.read(), free.read()).psnr, tolerance::picture_psnr);
}

TEST_F(Contact, WithCollidersElsewhereChangesNothing) {
  const auto far = long_fur([](Scene& s) {
    ContactSphereScene sphere;
    sphere.centre = {0, 50, 0};
    s.contact.spheres = {sphere};
  });
  EXPECT_EQ(compare(drawn_by_device(far, "tile"), drawn_by_device(long_fur(), "tile")).worst, 0);
}

TEST_F(Contact, WithClippedTrianglesLooksLikeTheReference) {
  const auto input = pressed([](Scene& s) {
    s.fur.layers = 8;
    s.camera.framed = false;
    s.camera.eye = {0.74f, .2f, -0.3f};
    s.camera.target = {0.72f, 0.2f, 0.3f};
  });
  EXPECT_TRUE(drawn_alike(input, "tile"));
}

TEST_F(Contact, InSeveralPassesDrawsTheSamePicture) {
  const auto input = pressed();
  EXPECT_EQ(compare(drawn_by_device(input, "tile"), drawn_with(input, {"tile", {}, 4})).worst, 0);
}

}  // namespace
}  // namespace pelage
