// Tests droplets at the seams of the UV map (wetness.seams, docs/frame.md, section 2).
#include "harness/prepare/seams.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "harness/prepare/droplets.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/shells/reference/mask.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::reference {
namespace {

/// The lengths of the edges that have a wet side, and of those whose other side is dry.
struct Cuts {
  double wet = 0, cut = 0;
  double share() const { return wet > 0 ? cut / wet : 0; }
};

/// Returns the cuts at the seams of the UV map and inside its charts. An edge has two
/// sides, which are its two triangles. A side is wet if the centroid of its triangle is wet.
std::pair<Cuts, Cuts> cuts_of(const FrameInput& input) {
  const Mesh& mesh = *input.mesh;
  const Mask mask = wetness_mask(input);
  struct Side {
    std::uint32_t a, b, opposite;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> edges;
  for (const glm::uvec3& t : mesh.triangle)
    for (int c = 0; c < 3; ++c) {
      Side side{t[c], t[(c + 1) % 3], t[(c + 2) % 3]};
      if (mesh.weld[side.a] > mesh.weld[side.b]) std::swap(side.a, side.b);
      edges[{mesh.weld[side.a], mesh.weld[side.b]}].push_back(side);
    }
  Cuts seams, inside;
  for (const auto& [ends, sides] : edges) {
    if (sides.size() != 2) continue;
    const auto wet = [&](const Side& s) {
      const glm::dvec2 at =
          (glm::dvec2(mesh.uv[s.a]) + glm::dvec2(mesh.uv[s.b]) + glm::dvec2(mesh.uv[s.opposite])) / 3.0;
      return mask.wet_at(at, input.scene.clump.cells).wetness > 0;
    };
    const bool first = wet(sides[0]), second = wet(sides[1]);
    const bool seam =
        mesh.uv[sides[0].a] != mesh.uv[sides[1].a] || mesh.uv[sides[0].b] != mesh.uv[sides[1].b];
    const double length =
        glm::distance(glm::dvec3(mesh.position[sides[0].a]), glm::dvec3(mesh.position[sides[0].b]));
    Cuts& kind = seam ? seams : inside;
    if (first || second) kind.wet += length;
    if (first != second) kind.cut += length;
  }
  return {seams, inside};
}

Scene wet_scene(const char* model, const char* seams) {
  Scene scene;
  scene.model = model;
  scene.fur.layers = 2;
  scene.fur.texture = 16;
  scene.wetness.size = 512;
  scene.wetness.random = 500;
  scene.wetness.radius = .02f;
  scene.wetness.blend = "overlap";
  scene.wetness.seams = seams;
  scene.clump.cells = "consistent";
  return scene;
}

struct SeamsOf : testing::TestWithParam<const char*> {};

TEST_P(SeamsOf, WetSpotsGoOnAcrossSeams) {
  const auto cuts = [&](const char* seams) {
    const Scene scene = wet_scene(GetParam(), seams);
    return cuts_of(*prepare(scene, load_scene_mesh(scene, {})));
  };
  const auto [cut_seams, cut_inside] = cuts("cut");
  const auto [seams, inside] = cuts("joined");
  RecordProperty("cut", fmt::format("seams {:.3f} inside {:.3f}", cut_seams.share(), cut_inside.share()));
  RecordProperty("joined", fmt::format("seams {:.3f} inside {:.3f}", seams.share(), inside.share()));
  EXPECT_GT(seams.wet, 0.1);
  EXPECT_GT(cut_seams.share(), 2 * cut_inside.share());
  if (std::string_view(GetParam()) == "torus")
    EXPECT_LE(seams.share(), 1.2 * inside.share());
  else
    EXPECT_LE(seams.share(), 0.2 * cut_seams.share());
}

INSTANTIATE_TEST_SUITE_P(Models, SeamsOf, testing::Values("torus", "bunny", "horse", "elephant"),
                         [](const auto& given) { return std::string(given.param); });

TEST(Seams, ADropletAtTheBorderOfAPeriodicMapIsRepeatedOnTheOppositeSide) {
  const Mesh mesh = synthetic::grid(synthetic::torus(), 40, 24);
  const synthetic::Surface surface = synthetic::torus();
  const auto at = [&](double u, double v) {
    return Droplet{{float(u), float(v)}, .05f, .8f, glm::vec3(surface.point(u, v)), 1.f, 7};
  };
  EXPECT_EQ(across_seams(mesh, {at(.5, .5)}).size(), 1u);
  const std::vector<Droplet> beside = across_seams(mesh, {at(.02, .5)});
  ASSERT_EQ(beside.size(), 2u);
  EXPECT_NEAR(beside[1].centre.x, 1.02, 1e-5);
  EXPECT_NEAR(beside[1].centre.y, .5, 1e-5);
  EXPECT_NEAR(beside[1].radius, .05, 1e-6);
  EXPECT_EQ(beside[1].number, 7u);
  EXPECT_EQ(beside[1].point, beside[0].point);
  // At a corner of the map, the droplet is repeated at the three other corners.
  EXPECT_EQ(across_seams(mesh, {at(.02, .97)}).size(), 4u);
}

// A droplet and its repetition cover a texel once: with a radius of more than half of the map, both cover
// most texels.
TEST(Seams, NoTexelTakesADropletTwice) {
  Scene scene = synthetic::lively_scene();
  scene.wetness.size = 64;
  scene.wetness.blend = "overlap";
  FrameInput input = synthetic::frame(scene, synthetic::torus(), 40, 24, 0);
  const synthetic::Surface surface = synthetic::torus();
  input.droplets =
      across_seams(*input.mesh, {Droplet{{.1f, .5f}, .7f, .3f, glm::vec3(surface.point(.1, .5)), 9.f, 0}});
  ASSERT_GT(input.droplets.size(), 1u);
  for (const Clump& clump : wetness_mask(input).texel)
    EXPECT_TRUE(clump.wetness == 0 || clump.wetness == double(.3f));
  EXPECT_EQ(blended_share(input), 0);
}

}  // namespace
}  // namespace pelage::reference
