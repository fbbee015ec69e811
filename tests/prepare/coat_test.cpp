#include "harness/prepare/coat.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/picture/image_io.hpp"
#include "tests/prepare/meshes.hpp"
#include "tests/support/files.hpp"

namespace pelage {
namespace {

std::size_t texel(int size, glm::vec2 uv) {
  const auto index = [&](float x) { return std::size_t(x * float(size)); };
  return index(uv.y) * std::size_t(size) + index(uv.x);
}

TEST(SurfaceMap, KnowsThePointUnderEachTexel) {
  using namespace test;
  const int size = 256;
  const auto map = surface_map(*two_charts(), size);
  int inside = 0;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const glm::vec2 uv((float(i) + 0.5f) / size, (float(j) + 0.5f) / size);
      // `p` is the surface point at `uv` if `uv` is in the chart of the left half of the square.
      const glm::vec3 p(uv.x / chart_scale - 0.05f / chart_scale - half_side, 0,
                        half_side - (uv.y - 0.05f) / chart_scale);
      if (p.x < -half_side || p.x > 0 || p.z < -half_side || p.z > half_side) continue;
      EXPECT_LT(glm::distance(map[texel(size, uv)], p), 1e-5f);
      ++inside;
    }
  EXPECT_GT(inside, 7000);
}

TEST(SurfaceMap, GuttersTakeTheNearestChart) {
  using namespace test;
  const auto map = surface_map(*two_charts(), 256);
  const glm::vec3 left_of_left = map[texel(256, {0.02f, 0.3f})];
  EXPECT_NEAR(left_of_left.x, -half_side, 0.02f);
  EXPECT_NEAR(left_of_left.z, half_side - 0.25f / chart_scale, 0.02f);
  const glm::vec3 above_right = map[texel(256, {0.7f, 0.97f})];
  EXPECT_NEAR(above_right.x, half_side, 0.02f);
  EXPECT_NEAR(above_right.z, 0.25f / chart_scale - half_side, 0.02f);
}

TEST(Coat, HasNoSeams) {
  using namespace test;
  const auto mesh = two_charts();
  for (const char* pattern : {"plain", "patches", "stripes", "spots", "grass"}) {
    CoatScene coat;
    coat.pattern = pattern;
    const CoatTexture t = make_coat(*mesh, coat);
    ASSERT_EQ(t.texel.size(), std::size_t(t.size) * std::size_t(t.size));
    int different = 0, along = 0;
    for (float z = -0.69f; z < 0.69f; z += 0.01f) {  // compares both sides of the UV seam at x = 0
      const glm::vec2 left(0.05f + chart_scale * half_side - 0.001f, 0.05f + chart_scale * (half_side - z));
      const glm::vec2 right(0.45f + chart_scale * (z + half_side), 0.65f + 0.001f);
      const auto a = t.texel[texel(t.size, left)], b = t.texel[texel(t.size, right)];
      for (std::size_t c = 0; c < 3; ++c) different = std::max(different, std::abs(int(a[c]) - int(b[c])));
      const auto next = t.texel[texel(t.size, left + glm::vec2(0, 0.003f))];
      for (std::size_t c = 0; c < 3; ++c) along = std::max(along, std::abs(int(a[c]) - int(next[c])));
    }
    EXPECT_LE(different, along + 8) << pattern;
  }
}

TEST(Coat, PatternsUseBothColours) {
  const auto mesh = test::two_charts();
  for (const char* pattern : {"patches", "stripes", "spots", "grass"}) {
    CoatScene coat;
    coat.pattern = pattern;
    coat.colour = {1, 0, 0};
    coat.second = {0, 1, 0};
    coat.scale = 0.3f;
    int first = 0, second = 0;
    const CoatTexture t = make_coat(*mesh, coat);
    for (const auto& c : t.texel) {
      first += c[0] > 200;
      second += c[1] > 200;
      EXPECT_NEAR(c[0] + c[1], 255, 1);
    }
    EXPECT_GT(first, int(t.texel.size()) / 50) << pattern;
    EXPECT_GT(second, int(t.texel.size()) / 50) << pattern;
  }
}

TEST(Coat, RefusesAnUnknownPattern) {
  CoatScene coat;
  coat.pattern = "tartan";
  EXPECT_THROW(make_coat(*test::two_charts(), coat), InputError);
}

TEST(Coat, TakesAPictureWithItsTopAtVOne) {
  const test::Folder folder;
  CoatScene coat;
  coat.image = folder.path / "coat.png";
  Picture picture{4, 4, std::vector<glm::vec4>(16, glm::vec4(0, 0, 1, 1))};
  picture.at(0, 0) = glm::vec4(1, 0, 0, 1);  // top left
  write_picture(coat.image, picture);
  const CoatTexture t = make_coat(*test::two_charts(), coat);
  ASSERT_EQ(t.size, 4);
  EXPECT_EQ(t.texel[12][0], 255);  // u = 0, v = 1
  EXPECT_EQ(t.texel[12][2], 0);
  EXPECT_EQ(t.texel[0][2], 255);
  coat.image = folder.path / "coat.exr";
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e30f}) {
    picture.pixel.front().y = bad;
    write_picture(coat.image, picture);
    EXPECT_THROW(make_coat(*test::two_charts(), coat), InputError) << bad;
  }
}

// gama1.png has the pixels of rgb.png, but says that they are proportional to the intensity.
TEST(Coat, AppliesTheGammaOfPng) {
  CoatScene coat;
  const fs::path folder = fs::path(PELAGE_SOURCE_DIR) / "tests/picture/strangers";
  coat.image = folder / "rgb.png";
  const CoatTexture stored = make_coat(*test::two_charts(), coat);
  coat.image = folder / "gama1.png";
  const CoatTexture linear = make_coat(*test::two_charts(), coat);
  ASSERT_EQ(linear.texel.size(), stored.texel.size());
  int changed = 0;
  for (std::size_t i = 0; i < stored.texel.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double wanted = 255 * std::pow(stored.texel[i][c] / 255.0, 1 / 2.2);
      EXPECT_NEAR(linear.texel[i][c], wanted, 0.5001);
      changed += linear.texel[i][c] > stored.texel[i][c] + 20;
    }
  EXPECT_GT(changed, 1000);
}

constexpr int size = 32;

/// Returns a mesh that maps every UV (u, v) in [low, 1] x [0, 1] to the point (u, v, 0).
Mesh strip(float low, bool periodic) {
  Mesh mesh;
  mesh.uv = {{low, 0}, {1, 0}, {1, 1}, {low, 1}};
  for (const glm::vec2& uv : mesh.uv) mesh.position.push_back({uv, 0});
  mesh.triangle = {{0, 1, 2}, {0, 2, 3}};
  mesh.weld = {0, 1, 2, 3};
  mesh.welded = 4;
  mesh.periodic_uv = periodic;
  return mesh;
}

glm::vec2 centre(int x, int y) {
  return {(float(x) + 0.5f) / size, (float(y) + 0.5f) / size};
}

// A texel has the point under its centre. With `low` = 1/4, texel columns 0 to 7 are outside the triangles.
// The nearest covered column is column 8. On a periodic map, however, columns 0 to 3 are nearer to column 31
// than to column 8.
TEST(SurfaceMap, HasThePointUnderEachTexelAndTheGutterOfAPeriodicMapWraps) {
  for (const float low : {0.0f, 0.25f})
    for (const bool periodic : {false, true}) {
      const auto map = surface_map(strip(low, periodic), size);
      ASSERT_EQ(map.size(), std::size_t(size * size));
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const glm::vec3 point = map[std::size_t(y) * std::size_t(size) + std::size_t(x)];
          const int nearest = low == 0 || x >= 8 ? x : periodic && x < 4 ? 31 : 8;
          EXPECT_NEAR(point.x, centre(nearest, y).x, 1e-6f) << x << ' ' << y << ' ' << periodic;
          EXPECT_NEAR(point.y, centre(x, y).y, 1e-6f) << x << ' ' << y << ' ' << periodic;
        }
    }
}

}  // namespace
}  // namespace pelage
