// Compares the OpenGL baseline's pictures of fur with maps (docs/shells.md, section 8) and with colliders
// (docs/shells.md, section 9) with the reference. Also tests water that changes over time (section 10).
#include <gtest/gtest.h>

#include <stdexcept>

#include "harness/compare/checks.hpp"
#include "harness/mesh/mesh.hpp"
#include "tests/shells/opengl/scenes.hpp"
#include "tests/support/files.hpp"
#include "tests/support/style_scenes.hpp"

namespace pelage {
namespace {

using namespace rival_tests;
using namespace style_scenes;

void set_maps(Scene& s, const std::filesystem::path& map) {
  s.fur.length_map = s.fur.density_map = s.fur.comb_map = s.curl.radius_map = s.curl.turns_map = map;
}

TEST(OpenGlStyle, LooksLikeTheReference) {
  const test::Folder folder;
  const auto map = write_map(folder.path / "wavy.exr", 32, 16, wavy);
  const auto input = small_torus([&](Scene& s) { set_maps(s, map); });
  EXPECT_TRUE(same(drawn_by_reference(*input), drawn_by_opengl(input)));
}

TEST(OpenGlStyle, MapsOfOneHalfAreHalfTheKeysBitForBit) {
  const test::Folder folder;
  const auto half = write_map(folder.path / "half.exr", 2, 3, [](glm::vec2) { return 0.5f; });
  const Picture mapped = drawn_by_opengl(small_torus([&](Scene& s) { set_maps(s, half); }));
  const Picture halved = drawn_by_opengl(small_torus([](Scene& s) {
    for (float* key : {&s.fur.length, &s.fur.density, &s.fur.comb, &s.curl.radius, &s.curl.turns})
      *key *= 0.5f;
  }));
  EXPECT_TRUE(same_bits(mapped, halved));
}

TEST(OpenGlContact, LooksLikeTheReference) {
  const test::Folder folder;
  const auto torus = folder.path / "torus.ply";
  write_ply(torus, *load_model("torus-24x16"));
  const auto input = small_torus([&](Scene& s) {
    s.fur.length = 0.26f;
    s.fur.comb = 0.2f;
    ContactSphereScene sphere;
    sphere.centre = {0.72f, 0.67f, 0.1f};
    sphere.radius = 0.36f;
    ContactCapsuleScene capsule;
    capsule.from = {-0.4f, 0.54f, 0.5f};
    capsule.to = {0.5f, 0.54f, 0.75f};
    capsule.radius = 0.22f;
    capsule.motion.velocity = {0.1f, 0, 0};
    s.contact.spheres = {sphere};
    s.contact.capsules = {capsule};
    s.contact.mesh.file = torus;
    s.contact.mesh.position = {-0.5f, 0.43f, 0.5f};
    s.contact.mesh.scale = 0.4f;
    s.contact.mesh.cells = 32;
  });
  EXPECT_TRUE(same(drawn_by_reference(*input), drawn_by_opengl(input)));
}

TEST(OpenGlWater, ANewMaskGivesThePictureOfAFreshScene) {
  FrameInput input = *small_frame("wet");
  input.scene.wetness.soak = .3f;
  ASSERT_GT(input.droplets.size(), 0u);
  const auto shared = std::make_shared<FrameInput>(input);
  const std::vector<glm::vec4> mask = mask_of(input), none(mask.size());
  OpenGl changed(shared, none);
  changed.bend(tips_of(input));
  changed.frame();
  const Picture dry = changed.read();
  changed.set_mask(mask);
  changed.frame();
  const Picture wet = changed.read(), fresh = drawn_by_opengl(shared);
  EXPECT_FALSE(same_bits(wet, dry));
  EXPECT_TRUE(same_bits(wet, fresh));
  for (const Check& check : other_filter_checks(against_reference, compare(wet, drawn_by_reference(input))))
    EXPECT_TRUE(check.holds()) << check.metric << " " << check.value;
  EXPECT_THROW(changed.set_mask({}), std::exception);
}

TEST(OpenGlWater, OfAStillSceneKeepsItsMask) {
  const auto still = small_frame("wet");
  OpenGl opengl(still, mask_of(*still));
  EXPECT_THROW(opengl.set_mask(mask_of(*still)), std::logic_error);
}

}  // namespace
}  // namespace pelage
