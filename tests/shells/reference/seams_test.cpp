// Tests droplets at the seams of the UV map (wetness.seams, docs/shells.md, section 2).
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
#include "tests/support/texts.hpp"

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
  const auto [cut_seams, cut_inside] = cuts("ignored");
  const auto [seams, inside] = cuts("joined");
  RecordProperty("ignored", fmt::format("seams {:.3f} inside {:.3f}", cut_seams.share(), cut_inside.share()));
  RecordProperty("joined", fmt::format("seams {:.3f} inside {:.3f}", seams.share(), inside.share()));
  EXPECT_GT(seams.wet, 0.1);
  EXPECT_GT(cut_seams.share(), 2 * cut_inside.share());
  EXPECT_LE(seams.share(), 1.5 * inside.share());
}

INSTANTIATE_TEST_SUITE_P(Models, SeamsOf, testing::Values("torus", "bunny"), test::by_parameter);
INSTANTIATE_TEST_SUITE_P(Full, SeamsOf, testing::Values("horse", "elephant"), test::by_parameter);

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

/// Returns the wet texels of a torus whose seam lies at the column `column` of its grid. The droplets are at
/// the same points of the surface for all columns.
std::vector<bool> wet_texels(int size, int column) {
  constexpr int columns = 64;
  const double shift = double(column) / columns;
  Scene scene = wet_scene("torus", "joined");
  scene.wetness.size = size;
  const synthetic::Surface torus = synthetic::torus();
  synthetic::Surface turned = torus;
  turned.point = [torus, shift](double u, double v) { return torus.point(u + shift, v); };
  FrameInput input = synthetic::frame(scene, turned, columns, 36, 0);
  std::vector<Droplet> droplets;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const double u = std::fmod(0.618 * double(i), 1.0), v = std::fmod(0.414 * double(i), 1.0);
    const double own = u - shift - std::floor(u - shift);
    droplets.push_back({{float(own), float(v)}, .04f, .8f, glm::vec3(torus.point(u, v)), .5f, i});
  }
  input.droplets = across_seams(*input.mesh, droplets);
  const Mask mask = wetness_mask(input);
  std::vector<bool> wet;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const int from = (i - column * size / columns + size) % size;
      wet.push_back(mask.texel[std::size_t(j) * std::size_t(size) + std::size_t(from)].wetness > 0);
    }
  return wet;
}

// The seam of a torus moves by whole texels under fixed droplets. The wet area must stay.
TEST(Seams, TheWetAreaDoesNotDependOnTheSeam) {
  for (const int size : {256, 2048}) {
    const std::vector<bool> here = wet_texels(size, 0), moved = wet_texels(size, 11);
    double both = 0, any = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      both += here[i] && moved[i];
      any += here[i] || moved[i];
    }
    RecordProperty(fmt::format("overlap_{}", size), fmt::format("{:.4f}", both / any));
    EXPECT_GT(any, 0.1 * double(here.size()));
    if (size == 2048) {
      EXPECT_GE(both / any, 0.97);
    }
  }
}

}  // namespace
}  // namespace pelage::reference
