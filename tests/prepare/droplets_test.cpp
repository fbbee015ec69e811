#include "harness/prepare/droplets.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/prepare/water.hpp"
#include "tests/prepare/meshes.hpp"
#include "tests/support/files.hpp"

namespace pelage {
namespace {

/// Returns the UV that the mesh test::two_charts() has at its surface point p.
glm::vec2 uv_of(glm::vec3 p) {
  using namespace test;
  if (p.x < 0) return {0.05f + chart_scale * (p.x + half_side), 0.05f + chart_scale * (half_side - p.z)};
  return {0.45f + chart_scale * (p.z + half_side), 0.65f + chart_scale * p.x};
}

WetnessScene rain() {
  WetnessScene wetness;
  wetness.random = 2000;
  wetness.seams = "ignored";  // tests/shells/reference/seams_test.cpp tests the repetitions at seams
  return wetness;
}

std::vector<Droplet> droplets_of(const WetnessScene& wetness) {
  const auto mesh = test::two_charts();
  return make_droplets(mesh, weld(*mesh), wetness);
}

TEST(Droplets, NoneByDefault) {
  EXPECT_TRUE(droplets_of({}).empty());
}

TEST(Droplets, LieOnTheSurfaceWithinTheirRanges) {
  const WetnessScene wetness = rain();
  const auto drops = droplets_of(wetness);
  EXPECT_GT(drops.size(), 500u);
  for (const Droplet& d : drops) {
    EXPECT_LT(glm::distance(d.centre, uv_of(d.point)), 1e-5f);
    EXPECT_GE(d.radius, wetness.radius * (1 - wetness.radius_spread) * 0.9999f);
    EXPECT_LE(d.radius, wetness.radius * (1 + wetness.radius_spread) * 1.0001f);
    EXPECT_GE(d.wetness, wetness.wetness - wetness.wetness_spread - 1e-6f);
    EXPECT_LE(d.wetness, 1.0f);
    EXPECT_GE(d.reach, d.radius / test::chart_scale);
  }
}

TEST(Droplets, KeepTheirDistanceInTheAtlasAndOnTheSurface) {
  for (const float spacing : {0.5f, 1.0f, 2.0f}) {
    WetnessScene wetness = rain();
    wetness.spacing = spacing;
    const auto drops = droplets_of(wetness);
    ASSERT_GT(drops.size(), 100u);
    for (std::size_t i = 0; i < drops.size(); ++i)
      // The distance of droplet i from the centres of all earlier droplets j must be at least `spacing` times
      // the radius of droplet i.
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GE(glm::distance(drops[i].centre, drops[j].centre), 0.9999f * spacing * drops[i].radius);
        EXPECT_GE(glm::distance(drops[i].point, drops[j].point),
                  0.999f * spacing * drops[i].radius / test::chart_scale);
      }
  }
}

TEST(Droplets, FollowTheSeed) {
  WetnessScene wetness = rain();
  const auto a = droplets_of(wetness), b = droplets_of(wetness);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].centre, b[i].centre);
  wetness.seed = 2;
  EXPECT_NE(droplets_of(wetness).front().centre, a.front().centre);
}

TEST(Droplets, EvenlyOverTheSurface) {
  const auto drops = droplets_of(rain());
  const auto left = std::count_if(drops.begin(), drops.end(), [](const Droplet& d) { return d.point.x < 0; });
  EXPECT_NEAR(double(left) / double(drops.size()), 0.5, 0.05);
}

std::shared_ptr<Mesh> mesh_of(std::vector<glm::vec3> position, std::vector<glm::vec2> uv,
                              std::vector<glm::uvec3> triangle) {
  auto mesh = std::make_shared<Mesh>();
  mesh->position = std::move(position);
  mesh->uv = std::move(uv);
  mesh->triangle = std::move(triangle);
  for (std::size_t i = 0; i < mesh->position.size(); ++i) mesh->weld.push_back(mesh->welded++);
  return mesh;
}

TEST(Droplets, EvenlyOverOneTriangle) {
  const auto mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}});
  WetnessScene wetness = rain();
  wetness.spacing = 0;
  wetness.patch_cover = 1;
  const auto drops = make_droplets(mesh, weld(*mesh), wetness);
  ASSERT_EQ(drops.size(), 2000u);
  glm::dvec2 mean(0);
  for (const Droplet& d : drops) mean += glm::dvec2(d.centre) / 2000.0;
  // The expected mean is the centroid of the triangle. The tolerance is four standard errors of the mean of
  // 2000 droplets. Each coordinate of a random point in the triangle has the standard deviation sqrt(1 / 18)
  // = 0.24.
  EXPECT_NEAR(mean.x, 1.0 / 3, 0.021);
  EXPECT_NEAR(mean.y, 1.0 / 3, 0.021);
}

TEST(Droplets, LieInTheLettersOfAText) {
  const auto mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                            {{0, 1, 2}, {0, 2, 3}});
  WetnessScene wetness = rain();
  wetness.spacing = 0.5f;
  wetness.text = "H";
  wetness.text_u = 0.4f;
  wetness.text_v = 0.6f;
  wetness.text_height = 0.5f;
  const auto drops = make_droplets(mesh, weld(*mesh), wetness);
  ASSERT_GT(drops.size(), 300u);
  int bar = 0, left = 0, right = 0;
  for (const Droplet& d : drops) {
    const glm::vec2 from_centre = d.centre - glm::vec2(0.4f, 0.6f);
    EXPECT_LE(std::abs(from_centre.y), 0.255f);  // half of the letter's height and a pixel
    EXPECT_LE(std::abs(from_centre.x), 0.255f);  // the letter H is less wide than high
    // Between its stems, the letter has only its bar.
    if (std::abs(from_centre.x) < 0.06f) {
      ++bar;
      EXPECT_LT(std::abs(from_centre.y), 0.08f);
    }
    left += from_centre.x < -0.1f;
    right += from_centre.x > 0.1f;
  }
  EXPECT_GT(bar, 10);
  EXPECT_GT(left, 100);
  EXPECT_GT(right, 100);
}

TEST(Droplets, ExplicitOnesComeFirstAndLandOnTheSurface) {
  WetnessScene wetness = rain();
  DropletScene by_point, by_uv, in_gutter;
  by_point.point = glm::vec3(-0.3f, 0.4f, 0.2f);
  by_point.radius = 0.02f;
  by_uv.uv = uv_of({0.31f, 0, -0.17f});
  in_gutter.uv = glm::vec2(0.0f, 0.2f);  // a UV outside all charts, to the left of the left chart
  wetness.droplets = {by_point, by_uv, in_gutter};
  const auto drops = droplets_of(wetness);
  EXPECT_LT(glm::distance(drops[0].point, glm::vec3(-0.3f, 0, 0.2f)), 1e-5f);
  EXPECT_LT(glm::distance(drops[0].centre, uv_of({-0.3f, 0, 0.2f})), 1e-5f);
  EXPECT_EQ(drops[0].radius, 0.02f);
  EXPECT_LT(glm::distance(drops[1].point, glm::vec3(0.31f, 0, -0.17f)), 1e-5f);
  EXPECT_NEAR(drops[2].point.x, -test::half_side, 1e-5f);
  EXPECT_NEAR(drops[2].centre.y, 0.2f, 1e-5f);
}

TEST(Droplets, PlacedByUvNeedAUvMap) {
  auto mesh = std::make_shared<Mesh>(*test::two_charts());
  std::fill(mesh->uv.begin(), mesh->uv.end(), glm::vec2(0.5f));
  WetnessScene wetness;
  wetness.droplets.push_back({.uv = glm::vec2(0.5f), .point = {}, .radius = 0.01f, .wetness = 1.0f});
  EXPECT_THROW(make_droplets(mesh, weld(*mesh), wetness), InputError);
}

TEST(Droplets, ManyExplicitOnesAreQuick) {
  WetnessScene wetness;
  for (int i = 0; i < 50000; ++i)
    wetness.droplets.push_back(
        {.uv = glm::vec2(0.1f + 1e-6f * float(i), 0.3f), .point = {}, .radius = 0.01f, .wetness = 1.0f});
  const auto drops = droplets_of(wetness);
  ASSERT_EQ(drops.size(), 50000u);
  EXPECT_NEAR(drops[49999].centre.x, 0.15f, 1e-5f);
}

TEST(Droplets, PatchesCoverTheirShareAndFadeAtTheirBorders) {
  WetnessScene wetness = rain();
  wetness.random = 20000;
  wetness.spacing = 0;
  wetness.patch_size = 0.3f;
  wetness.wetness_spread = 0;
  const auto everywhere = droplets_of(wetness);
  EXPECT_EQ(everywhere.size(), 20000u);
  wetness.patch_cover = 0.4f;
  const auto drops = droplets_of(wetness);
  // The test divides the surface into 14 x 14 cells and marks the cells that contain a droplet.
  std::vector<char> wet(196, 0);
  const auto cell = [](float x) { return std::size_t(std::clamp(int((x + 0.7f) * 10), 0, 13)); };
  for (const Droplet& d : drops) wet[cell(d.point.z) * 14 + cell(d.point.x)] = 1;
  const double share = double(std::count(wet.begin(), wet.end(), 1)) / 196;
  EXPECT_GT(share, 0.3);
  EXPECT_LT(share, 0.62);  // the bound exceeds patch_cover = 0.4, because partly wet cells count as wet
  const auto faint =
      std::count_if(drops.begin(), drops.end(), [](const Droplet& d) { return d.wetness < 0.45f; });
  const auto full =
      std::count_if(drops.begin(), drops.end(), [](const Droplet& d) { return d.wetness > 0.89f; });
  EXPECT_GT(faint, 200);
  EXPECT_GT(full, 200);
}

TEST(Image, DropletsFallWhereItIsBright) {
  const test::Folder folder;
  Picture mask{8, 8, std::vector<glm::vec4>(64, glm::vec4(0, 0, 0, 1))};
  for (int y = 0; y < 4; ++y)  // the upper half of the picture covers v > 0.5
    for (int x = 0; x < 8; ++x) mask.at(x, y) = glm::vec4(1);
  WetnessScene wetness = rain();
  wetness.image = folder.path / "mask.png";
  write_picture(wetness.image, mask);
  const auto drops = droplets_of(wetness);
  ASSERT_GT(drops.size(), 100u);
  for (const Droplet& d : drops) EXPECT_GE(d.centre.y, 0.5f);
}

/// Returns the area on the surface, in R^2, of the part whose UV lies in the disc of the droplet.
double disc_area(const Mesh& mesh, const Droplet& droplet) {
  constexpr int n = 24;
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangle) {
    const glm::vec2 a = mesh.uv[t.x], b = mesh.uv[t.y] - a, c = mesh.uv[t.z] - a;
    if (glm::distance(a, droplet.centre) > 2 * droplet.radius + 0.05f) continue;
    const double area = double(glm::length(glm::cross(mesh.position[t.y] - mesh.position[t.x],
                                                      mesh.position[t.z] - mesh.position[t.x]))) /
                        2;
    int inside = 0, all = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j, ++all)
        inside += glm::distance(a + b * ((float(i) + 1 / 3.0f) / n) + c * ((float(j) + 1 / 3.0f) / n),
                                droplet.centre) <= droplet.radius;
    sum += area * inside / all;
  }
  return sum;
}

/// Returns the least and the greatest disc area of droplets on a torus, divided by pi 0.08^2.
std::pair<double, double> disc_areas(const char* unit, float radius) {
  const auto torus = load_model("torus-72x65");
  WetnessScene wetness = rain();
  wetness.random = 60;
  wetness.radius = radius;
  wetness.radius_spread = 0;
  wetness.unit = unit;
  std::pair<double, double> range{1e9, 0};
  for (const Droplet& d : make_droplets(torus, weld(*torus), wetness)) {
    const glm::vec2 border = glm::min(d.centre, 1.0f - d.centre);
    if (std::min(border.x, border.y) < d.radius) continue;  // the disc ends at the border of the UV square
    const double area = disc_area(*torus, d) / (M_PI * 0.08 * 0.08);
    range = {std::min(range.first, area), std::max(range.second, area)};
  }
  return range;
}

TEST(Droplets, WithRadiiOnTheSurfaceHaveTheSameAreaEverywhere) {
  const auto [low, high] = disc_areas("surface", 0.08f);
  EXPECT_GT(low, 0.95);
  EXPECT_LT(high, 1.05);
  const auto [least, most] = disc_areas("uv", 0.03f);
  EXPECT_GT(most / least, 1.5) << "without the unit, the areas differ";
}

TEST(Droplets, WithRadiiOnTheSurfaceHaveTheirWaterAndReach) {
  const auto mesh = test::two_charts();
  WetnessScene wetness = rain();
  wetness.droplets.resize(1);
  wetness.droplets[0] = {glm::vec2(0.2f), {}, 0.1f, 0.5f, 0};
  wetness.random = 0;
  wetness.unit = "surface";
  wetness.seams = "joined";
  const auto drops = make_droplets(mesh, weld(*mesh), wetness);
  ASSERT_EQ(drops.size(), 1u);
  EXPECT_NEAR(drops[0].radius, 0.1f * test::chart_scale, 1e-6f);
  EXPECT_NEAR(drops[0].reach, 0.2f, 1e-6f);
  EXPECT_NEAR(water_at(wetness, drops, mesh->length_per_uv, 0).fell, 0.5 * M_PI * 0.01, 1e-7);
}

TEST(Droplets, WithRadiiOnTheSurfaceKeepTheirDistance) {
  const auto torus = load_model("torus-72x65");
  WetnessScene wetness = rain();
  wetness.radius = 0.05f;
  wetness.unit = "surface";
  const auto drops = make_droplets(torus, weld(*torus), wetness);
  ASSERT_GT(drops.size(), 100u);
  for (std::size_t i = 0; i < drops.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE(glm::distance(drops[i].centre, drops[j].centre), 0.9999f * drops[i].radius);
}

}  // namespace
}  // namespace pelage
