// This file tests, for each mapping, which pixels the device covers after transform, binning, clipping and
// rasterization. These pixels must be the pixels that the reference covers. The reference computes its
// coverage by exact integer edge functions. Triangles that share edges must leave no gap and no overlap
// (docs/shells.md, section 4).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "harness/shells/reference/coverage.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"

namespace pelage {
namespace {

using pictures::covered_counts;
using pictures::Flat;
using reference::Raster;
using reference::Snapped;

constexpr int size = 1024;
constexpr int edge = size / 2 * 256;  // distance of the picture's edges from its centre, in 1/256 pixel

struct Mapping {
  const char* name;
  ShellOptions options;
  int pictures;    ///< number of pictures of random triangles
  int triangles;   ///< number of random triangles per picture
  int repeats;     ///< number of random meshes of each kind in the test of shared edges
  int coarser;     ///< the grids' numbers of columns and rows are divided by this number
  int spokes;      ///< number of triangles around the common corner in each mesh made by star()
  double samples;  ///< least number of pixel centres next to shared edges, summed over all meshes of a test
};
void PrintTo(const Mapping& mapping, std::ostream* out) {
  *out << mapping.name;
}

const Mapping tested_mappings[] = {
    {"tile", {"tile", {}}, 5, 50000, 1, 1, 1500, 3e6},
    {"tile8x8", {"tile", {{"TILE_W", 8}, {"TILE_H", 8}}}, 2, 50000, 1, 1, 300, 3e6},
    {"group", {"group", {}}, 1, 5000, 1, 16, 24, 1e5},
    {"pixel", {"pixel", {}}, 1, 5000, 1, 16, 24, 1e5}};  // this mapping is slow for tiles with many triangles

struct Coverage : testing::TestWithParam<Mapping> {};
INSTANTIATE_TEST_SUITE_P(Device, Coverage, testing::ValuesIn(tested_mappings), test::by_parameter);

/// Returns a random triangle of a random kind: small, thin, aligned with pixel centres, and so on. The
/// coordinates are in units of 1/256 pixel.
std::array<Snapped, 3> awkward(std::mt19937& random) {
  const auto within = [&](int range) { return int(random() % std::uint32_t(2 * range + 1)) - range; };
  const Snapped c{within(edge + 2000), within(edge + 2000)};
  const auto near = [&](int range) { return Snapped{c.x + within(range), c.y + within(range)}; };
  const auto aligned = [](Snapped s) { return Snapped{s.x / 128 * 128, s.y / 128 * 128}; };
  switch (random() % 8) {
    case 0:
    case 1:
      return {near(3000), near(3000), near(3000)};
    case 2:  // coordinates are multiples of 1/2 pixel; corners and edges may be on pixel centres
      return {aligned(near(2500)), aligned(near(2500)), aligned(near(2500))};
    case 3:  // smaller than a pixel
      return {near(200), near(200), near(200)};
    case 4: {  // a sliver whose width is a few times 1/256 pixel
      const Snapped a = near(20000), b = near(20000);
      return {a, b, Snapped{(a.x + b.x) / 2 + within(3), (a.y + b.y) / 2 + within(3)}};
    }
    case 5: {  // vertical and horizontal edges, which may pass through pixel centres
      const Snapped a = aligned(near(2500)), b = aligned(near(2500));
      return {a, Snapped{b.x, a.y}, Snapped{a.x, b.y}};
    }
    case 6:  // triangles of area zero
      return random() % 2
                 ? std::array<Snapped, 3>{c, c, near(2000)}
                 : std::array<Snapped, 3>{c, Snapped{c.x + 512, c.y + 256}, Snapped{c.x + 1024, c.y + 512}};
    default:  // a small triangle, or in 1 of 64 cases a thin triangle with two corners outside the picture
      if (random() % 64) return {near(1500), near(1500), near(1500)};
      const Snapped far{within(1 << 21), within(1 << 21)};
      return {c, far, Snapped{far.x + within(2000), far.y + within(2000)}};
  }
}

/// A mesh of separate triangles, and the number of triangles that cover each pixel of a square picture.
struct Expected {
  Flat flat;
  std::vector<int> counts;

  explicit Expected(int side) : flat{{}, {}, side, side}, counts(std::size_t(side) * std::size_t(side), 0) {}
  void add(const std::array<Snapped, 3>& c) {
    const auto first = std::uint32_t(flat.vertex.size());
    for (const Snapped& s : c) flat.vertex.emplace_back(float(double(s.x) / 256), float(double(s.y) / 256));
    flat.triangle.emplace_back(first, first + 1, first + 2);
    const Raster raster(c, flat.width, flat.height);
    const Window box = raster.box({0, 0, flat.width, flat.height});
    for (int y = box.y; y < box.y + box.height; ++y)
      for (int x = box.x; x < box.x + box.width; ++x)
        counts[std::size_t(y) * std::size_t(flat.width) + std::size_t(x)] += raster.edges(x, y).covered;
  }
  int most() const { return *std::max_element(counts.begin(), counts.end()); }
};

TEST_P(Coverage, RandomTrianglesCoverWhatTheIntegersSay) {
  const auto& [name, options, pictures, triangles, repeats, coarser, spokes, least] = GetParam();
  std::size_t wrong = 0, hits = 0;
  for (int p = 0; p < pictures; ++p) {
    std::mt19937 random{std::uint32_t(p)};
    Expected expected(size);
    for (int t = 0; t < triangles; ++t) expected.add(awkward(random));
    ASSERT_LE(expected.most(), 50);
    const std::vector<int> counts = covered_counts(expected.flat, options);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      wrong += counts[i] != expected.counts[i];
      hits += std::size_t(expected.counts[i]);
    }
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(hits, std::size_t(pictures) * std::size_t(triangles) * 10);
}

// Draws large triangles that overlap around one point. The corners of the triangles are less than 128 pixels,
// in x and in y, from the tiles near this point. The edge functions of these triangles nevertheless need more
// than 32 bits.
TEST_P(Coverage, TrianglesOf220PixelsCoverWhatTheIntegersSay) {
  std::mt19937 random(5);
  const auto within = [&](int range) { return int(random() % std::uint32_t(2 * range + 1)) - range; };
  Expected expected(256);
  for (int t = 0; t < 40; ++t) {
    std::array<Snapped, 3> c;
    for (int k = 0; k < 3; ++k) {  // three corners of a square of 220 pixels, each moved by up to 6 pixels
      const int corner = (t + k) % 4;
      c[std::size_t(k)] = {(corner == 1 || corner == 2 ? 110 : -110) * 256 + within(6 * 256),
                           (corner >= 2 ? 110 : -110) * 256 + within(6 * 256)};
    }
    if (random() % 2) std::swap(c[1], c[2]);
    expected.add(c);
  }
  ASSERT_GT(expected.most(), 20);
  EXPECT_TRUE(covered_counts(expected.flat, GetParam().options) == expected.counts);
}

/// Returns a mesh with the vertices `v`, which form a grid. Each cell of the grid is split into two
/// triangles. The vertices of each triangle are in clockwise or in counter-clockwise order, at random. A cell
/// may be concave. The diagonal is chosen at random from the diagonals that split the cell into two triangles
/// with a signed area of at least 0.
Flat grid(const std::vector<std::vector<glm::dvec2>>& v, std::mt19937& random) {
  Flat flat{{}, {}, size, size};
  const std::uint32_t columns = std::uint32_t(v[0].size());
  for (const auto& row : v)
    for (const glm::dvec2& p : row) flat.vertex.emplace_back(p);
  const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::dvec2 p(flat.vertex[a]), q(flat.vertex[b]), r(flat.vertex[c]);
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  };
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (random() % 2) std::swap(b, c);
    flat.triangle.emplace_back(a, b, c);
  };
  for (std::uint32_t j = 0; j + 1 < v.size(); ++j)
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t a = j * columns + i, b = a + 1, d = a + columns, c = d + 1;
      const bool first = turn(a, b, c) >= 0 && turn(a, c, d) >= 0;
      const bool second = turn(a, b, d) >= 0 && turn(b, c, d) >= 0;
      EXPECT_TRUE(first || second);
      if (first && (!second || random() % 2)) {
        add(a, b, c), add(a, c, d);
      } else {
        add(a, b, d), add(b, c, d);
      }
    }
  return flat;
}

/// Returns how many pixel centres inside the picture are next to shared edges.
double samples(const Flat& flat) {
  double sum = 0;
  for (const glm::uvec3& t : flat.triangle)
    for (int c = 0; c < 3; ++c) {
      const auto inside = [](double x) { return std::clamp(x, -.5 * size, .5 * size); };
      const glm::vec2 a = flat.vertex[t[c]], b = flat.vertex[t[(c + 1) % 3]];
      // Each of the two triangles of a shared edge adds the number of rows or columns that the edge crosses,
      // whichever is larger. Together they count two pixel centres for each, one on each side of the edge.
      sum += std::max(std::abs(inside(a.x) - inside(b.x)), std::abs(inside(a.y) - inside(b.y)));
    }
  return sum;
}

/// Returns the vertices of a grid of columns x rows cells that covers the picture and a margin of 4 pixels.
/// Inner vertices are moved at random by up to `move` times the cell size. Positions are multiples of `unit`
/// pixels.
std::vector<std::vector<glm::dvec2>> cells(int columns, int rows, double move, double unit,
                                           std::mt19937& random) {
  std::vector<std::vector<glm::dvec2>> v;
  const double w = (size + 8.0) / columns, h = (size + 8.0) / rows;
  for (int j = 0; j <= rows; ++j) {
    v.emplace_back();
    for (int i = 0; i <= columns; ++i) {
      const auto jitter = [&](int k, int last) {
        return k > 0 && k < last ? move * (2.0 * double(random()) / 4294967295.0 - 1) : 0;
      };
      const double x = (i + jitter(i, columns)) * w - .5 * size - 4,
                   y = (j + jitter(j, rows)) * h - .5 * size - 4;
      v.back().emplace_back(std::round(x / unit) * unit, std::round(y / unit) * unit);
    }
  }
  return v;
}

/// Returns a star of triangles. One corner, which all triangles share, is in the picture. The other corners
/// are on a circle of `radius` pixels.
Flat star(int spokes, double radius, std::mt19937& random) {
  Flat flat{{{float(random() % 600) - 300, float(random() % 600) - 300}}, {}, size, size};
  for (int i = 0; i < spokes; ++i) {
    const double angle = 2 * 3.141592653589793 * (i + .4 * double(random()) / 4294967295.0) / spokes;
    flat.vertex.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  for (std::uint32_t i = 0; i < std::uint32_t(spokes); ++i) {
    const std::uint32_t a = 1 + i, b = 1 + (i + 1) % std::uint32_t(spokes);
    flat.triangle.push_back(random() % 2 ? glm::uvec3(0, a, b) : glm::uvec3(b, a, 0));
  }
  return flat;
}

TEST_P(Coverage, SharedEdgesLeaveNoGapAndHitNothingTwice) {
  std::mt19937 random(11);
  std::vector<Flat> meshes;
  const int coarser = GetParam().coarser;
  for (int repeat = 0; repeat < GetParam().repeats; ++repeat) {
    meshes.push_back(
        grid(cells(342 / coarser, 342 / coarser, .45, 1.0 / 256, random), random));  // cells of 3 pixels
    meshes.push_back(
        grid(cells(342 / coarser, 342 / coarser, .3, .5, random), random));  // through pixel centres
    meshes.push_back(
        grid(cells(3000 / coarser, 20, .3, 1.0 / 256, random), random));  // triangles a third of a pixel wide
    meshes.push_back(grid(cells(12, 3000 / coarser, .3, 1.0 / 256, random), random));
    meshes.push_back(star(GetParam().spokes, 12000, random));   // corners far outside the picture
    meshes.push_back(star(GetParam().spokes, 900000, random));  // corners beyond the guard band
  }
  double edge_samples = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    edge_samples += samples(meshes[m]);
    const std::vector<int> counts = covered_counts(meshes[m], GetParam().options);
    EXPECT_EQ(std::count(counts.begin(), counts.end(), 1), std::ptrdiff_t(counts.size()))
        << "mesh " << m << ": " << std::count(counts.begin(), counts.end(), 0) << " gaps";
  }
  EXPECT_GE(edge_samples, GetParam().samples);
}

TEST_P(Coverage, APlaneThatRunsBehindTheEyeHasNoCracks) {
  // A vertex (x, y) of `flat` has the view depth w = 1/2 + y / 2000 on the counted layer (the layer with
  // fur). The part of the layer with y < -1000 has w < 0, so it is behind the eye. On the screen, y points
  // down, and the layer covers all pixels above its horizon. The horizon is 1000 pixels below the image
  // centre, outside the picture. The layer therefore fills the picture.
  std::mt19937 random(4);
  std::vector<std::vector<glm::dvec2>> v;
  const int n = 80 / GetParam().coarser;
  for (int j = 0; j <= n; ++j) {
    v.emplace_back();
    for (int i = 0; i <= n; ++i) {
      const auto jitter = [&] { return .4 * (2.0 * double(random()) / 4294967295.0 - 1); };
      v.back().emplace_back(((i + jitter()) / n - .5) * 18000, ((j + jitter()) / n - .25) * 16000);
    }
  }
  Flat flat = grid(v, random);
  flat.row_w = {0, .001f, -.5f, 1};
  const std::vector<int> counts = covered_counts(flat, GetParam().options);
  EXPECT_EQ(std::count(counts.begin(), counts.end(), 1), std::ptrdiff_t(counts.size()))
      << std::count(counts.begin(), counts.end(), 0) << " gaps";
}

}  // namespace
}  // namespace pelage
