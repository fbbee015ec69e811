// Tests which pixels a triangle covers, in exact integer arithmetic (docs/shells.md, section 4).
#include "harness/shells/reference/coverage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace pelage {
namespace {

using namespace reference;

constexpr int width = 33, height = 20;  // odd width: the pixel centres of the middle column have x = 0

std::vector<int> counts(const std::vector<std::array<Snapped, 3>>& triangles) {
  std::vector<int> hits(std::size_t(width) * height, 0);
  for (const auto& t : triangles) {
    const Raster raster(t, width, height);
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i)
        hits[std::size_t(j) * width + std::size_t(i)] += raster.edges(i, j).covered;
  }
  return hits;
}

TEST(ReferenceCoverage, TheTopLeftRuleOnASquareOfPixelCentres) {
  // The corners of the square are the centres of the pixels in columns 3 and 6 and rows 2 and 5. The square
  // covers the pixels of columns 3 to 5 and rows 2 to 4. Pixel centres on its top and left edges count as
  // inside, those on its bottom and right edges as outside.
  const auto centre = [](int i, int size) { return 256 * std::int64_t(i) + 128 - 128 * std::int64_t(size); };
  const std::int64_t l = centre(3, width), r = centre(6, width), t = centre(2, height), b = centre(5, height);
  const std::vector<int> hits = counts({{Snapped{l, t}, {r, t}, {r, b}}, {Snapped{l, t}, {r, b}, {l, b}}});
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      EXPECT_EQ(hits[std::size_t(j * width + i)], i >= 3 && i < 6 && j >= 2 && j < 5) << i << ' ' << j;
}

TEST(ReferenceCoverage, AgreesWithASampleMovedAnInfinitesimalRightAndDown) {
  // The top-left rule is equivalent to a small shift of every pixel centre, by e to the right and e^2 down,
  // in the limit e -> 0. This test uses e = 2^-20 in units of 1/256 pixel. It multiplies all coordinates by
  // 2^40, so that e and e^2 become integers and nothing is rounded.
  std::mt19937 random(3);
  std::uniform_int_distribution<int> coarse(-6 * 2, 6 * 2), fine(-6 * 256, 6 * 256);
  using Wide = __int128;
  const Wide scale = Wide(1) << 40, right = Wide(1) << 20, down = 1;
  int edge_hits = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::array<Snapped, 3> c;
    for (Snapped& s : c)
      s = trial % 2 ? Snapped{std::int64_t(coarse(random)) * 128, std::int64_t(coarse(random)) * 128}
                    : Snapped{fine(random), fine(random)};
    const Raster raster(c, 16, 14);
    for (int j = 0; j < 14; ++j)
      for (int i = 0; i < 16; ++i) {
        const Wide px = scale * (256 * i + 128 - 128 * 16) + right,
                   py = scale * (256 * j + 128 - 128 * 14) + down;
        int positive = 0, negative = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const Snapped &a = c[k], &b = c[(k + 1) % 3];
          const Wide e = (b.x - a.x) * (py - scale * a.y) - (b.y - a.y) * (px - scale * a.x);
          positive += e > 0;
          negative += e < 0;
        }
        const Edges edges = raster.edges(i, j);
        ASSERT_EQ(edges.covered, positive == 3 || negative == 3)
            << "trial " << trial << " pixel " << i << ' ' << j;
        edge_hits += std::count(edges.value.begin(), edges.value.end(), 0) > 0;
      }
  }
  EXPECT_GT(edge_hits, 10000);  // many pixel centres must lie on edges
}

TEST(ReferenceCoverage, AMeshCoversEveryPixelOnce) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    // The grid extends beyond the picture, and its inner vertices are moved at random. Odd trials put
    // vertices on pixel centres. Every third trial has thin triangles. Every fourth trial moves the border of
    // the grid far outside the picture.
    constexpr int n = 6;
    std::array<std::array<Snapped, n + 1>, n + 1> v;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const auto jitter = [&](int k) { return k > 0 && k < n ? int(random() % 1200) - 600 : 0; };
        Snapped s{(i - n / 2) * 2000 + jitter(i), (j - n / 2) * 1400 + jitter(j) / 2};
        if (trial % 2) s = {s.x / 128 * 128, s.y / 128 * 128};
        if (trial % 3 == 0 && i == 3) s.x = (i - n / 2) * 2000 - 1000 + 3 * j;
        if (trial % 4 == 0 && (i == 0 || i == n)) s.x *= 500;
        if (trial % 4 == 0 && (j == 0 || j == n)) s.y *= 700;
        v[std::size_t(j)][std::size_t(i)] = s;
      }
    std::vector<std::array<Snapped, 3>> triangles;
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        const Snapped a = v[j][i], b = v[j][i + 1], c = v[j + 1][i + 1], d = v[j + 1][i];
        const auto add = [&](Snapped p, Snapped q, Snapped r) {
          if (random() % 2) std::swap(q, r);  // either winding
          triangles.push_back({p, q, r});
        };
        // A cell need not be convex. It is split along a diagonal that gives two triangles with a signed area
        // of at least 0.
        const auto turn = [](Snapped p, Snapped q, Snapped r) {
          return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        };
        if (turn(a, b, c) >= 0 && turn(a, c, d) >= 0) {
          add(a, b, c), add(a, c, d);
        } else {
          ASSERT_GE(turn(a, b, d), 0);
          ASSERT_GE(turn(b, c, d), 0);
          add(a, b, d), add(b, c, d);
        }
      }
    for (const int hits : counts(triangles)) ASSERT_EQ(hits, 1) << "trial " << trial;
  }
}

TEST(ReferenceCoverage, ZeroAreaCoversNothing) {
  for (const auto& t : {std::array<Snapped, 3>{Snapped{0, 0}, {512, 512}, {1024, 1024}},
                        std::array<Snapped, 3>{Snapped{-256, 0}, {0, 0}, {256, 0}},
                        std::array<Snapped, 3>{Snapped{128, 128}, {128, 128}, {128, 128}}})
    for (const int hits : counts({t})) EXPECT_EQ(hits, 0);
}

TEST(ReferenceCoverage, EdgesAreTheBarycentricsOfTheirCorner) {
  const std::array<Snapped, 3> c{Snapped{-2000, -1500}, {2500, -900}, {300, 2100}};
  for (const bool flipped : {false, true}) {
    const Raster raster(flipped ? std::array<Snapped, 3>{c[1], c[0], c[2]} : c, width, height);
    const Edges edges = raster.edges(15, 9);
    ASSERT_TRUE(edges.covered);
    const double sum = double(edges.value[0] + edges.value[1] + edges.value[2]);
    double x = 0;
    for (std::size_t k = 0; k < 3; ++k)
      x += double(edges.value[k]) / sum * double((flipped && k < 2 ? c[1 - k] : c[k]).x);
    EXPECT_NEAR(x, (15 + .5 - width / 2.0) * 256, 1e-9);
    EXPECT_EQ(raster.faces_eye(), flipped);
  }
}

TEST(ReferenceCoverage, TheBoxHoldsEveryCoveredPixelOfTheWindow) {
  std::mt19937 random(9);
  std::uniform_int_distribution<int> any(-5000, 5000);
  const Window window{4, 3, 20, 12};
  for (int trial = 0; trial < 2000; ++trial) {
    const Raster raster(
        {Snapped{any(random), any(random)}, {any(random), any(random)}, {any(random), any(random)}}, width,
        height);
    const Window box = raster.box(window);
    EXPECT_TRUE(box.width == 0 || (box.x >= 4 && box.x + box.width <= 24));
    EXPECT_TRUE(box.height == 0 || (box.y >= 3 && box.y + box.height <= 15));
    for (int j = 3; j < 15; ++j)
      for (int i = 4; i < 24; ++i)
        if (raster.edges(i, j).covered) {
          ASSERT_TRUE(i >= box.x && i < box.x + box.width && j >= box.y && j < box.y + box.height);
        }
  }
}

TEST(ReferenceCoverage, SnappingRoundsToNearestTiesToEven) {
  EXPECT_EQ(snap({1.5 / 256, -1.5 / 256, 1}), (Snapped{2, -2}));
  EXPECT_EQ(snap({2.5 / 256, .49 / 256, 1}), (Snapped{2, 0}));
  EXPECT_EQ(snap({10, -10, 4}), (Snapped{640, -640}));
}

TEST(ReferenceClip, KeepsWhatLiesInFrontOfTheNearPlane) {
  const auto polygon = clip({ClipPoint{0, 0, 1}, {10, 0, 2}, {0, 10, -1}}, .5);
  ASSERT_EQ(polygon.size(), 4u);
  for (const ClippedVertex& v : polygon) {
    EXPECT_GE(v.point.w, .5 - 1e-12);
    EXPECT_NEAR(v.corners.x + v.corners.y + v.corners.z, 1, 1e-12);
    // The vertex must be the sum of the original triangle's corners, weighted by v.corners.
    EXPECT_NEAR(v.point.x, 10 * v.corners.y, 1e-12);
    EXPECT_NEAR(v.point.y, 10 * v.corners.z, 1e-12);
    EXPECT_NEAR(v.point.w, v.corners.x + 2 * v.corners.y - v.corners.z, 1e-12);
  }
  EXPECT_TRUE(clip({ClipPoint{0, 0, .1}, {10, 0, .2}, {0, 10, -1}}, .5).empty());
  EXPECT_EQ(clip({ClipPoint{0, 0, 1}, {10, 0, 1}, {0, 10, 1}}, .5).size(), 3u);
}

TEST(ReferenceClip, KeepsScreenPositionsWithinTheGuard) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    std::array<ClipPoint, 3> t;
    for (ClipPoint& p : t) p = {4e4 * any(random), 4e4 * any(random), .8 + any(random)};
    for (const ClippedVertex& v : clip(t, .01)) {
      EXPECT_LE(std::abs(v.point.x), guard * v.point.w * (1 + 1e-12));
      EXPECT_LE(std::abs(v.point.y), guard * v.point.w * (1 + 1e-12));
    }
  }
}

TEST(ReferenceClip, NeighboursMeetAtTheSamePoints) {
  const ClipPoint a{3, -2, .7}, b{-4, 5, -.9};
  const auto one = clip({a, b, ClipPoint{1, 1, 2}}, .1), other = clip({b, a, ClipPoint{-1, -1, 1}}, .1);
  const auto on_edge = [](const std::vector<ClippedVertex>& polygon, int third) {
    for (const ClippedVertex& v : polygon)
      if (v.corners[third] == 0 && v.corners[0] != 0 && v.corners[1] != 0) return v.point;
    return ClipPoint{0, 0, 0};
  };
  const ClipPoint p = on_edge(one, 2), q = on_edge(other, 2);
  EXPECT_GT(p.w, 0);
  EXPECT_EQ(p.x, q.x);
  EXPECT_EQ(p.y, q.y);
  EXPECT_EQ(p.w, q.w);
}

}  // namespace
}  // namespace pelage
