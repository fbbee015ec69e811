// Tests that the parts of a UV map that overlap get charts of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/mesh/finish.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/mesh/uv_pieces.hpp"

namespace pelage {
namespace {

using Corners = Surface::Corners;

/// A strip that winds around an axis `turns` times, like a spiral staircase. In UV, the turns lie on each
/// other.
Surface spiral(double turns) {
  Surface surface;
  const int steps = int(60 * turns);
  std::vector<glm::dvec2> uv;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= 4; ++j) {
      const double angle = 2 * std::numbers::pi * i / 60, radius = 0.2 + 0.05 * j;
      const glm::dvec2 p(radius * std::cos(angle), radius * std::sin(angle));
      uv.push_back(0.5 + p);
      surface.point.emplace_back(p, 0.3 * i / 60);
    }
  for (std::uint32_t i = 0; i < std::uint32_t(steps); ++i)
    for (std::uint32_t j = 0; j < 4; ++j) {
      const std::uint32_t a = 5 * i + j, b = a + 1, c = a + 6, d = a + 5;
      surface.triangle.push_back({a, b, c});
      surface.triangle.push_back({a, c, d});
    }
  for (const auto& [a, b, c] : surface.triangle) surface.uv.push_back({uv[a], uv[b], uv[c]});
  return surface;
}

/// A flat square of side x side quads whose UV equals its shape.
Surface sheet(int side) {
  Surface surface;
  const auto n = std::uint32_t(side) + 1;
  for (std::uint32_t i = 0; i < n * n; ++i) surface.point.emplace_back(i % n, i / n, 0);
  for (std::uint32_t i = 0; i < n * n; ++i)
    if (i % n + 1 < n && i / n + 1 < n) {
      surface.triangle.push_back({i, i + 1, i + n + 1});
      surface.triangle.push_back({i, i + n + 1, i + n});
    }
  for (const auto& t : surface.triangle) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = 0.1 + 0.8 * glm::dvec2(surface.point[t[k]]) / double(side);
    surface.uv.push_back(corners);
  }
  return surface;
}

void move(Surface& surface, std::uint32_t p, glm::dvec2 by) {
  for (std::size_t f = 0; f < surface.triangle.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      if (surface.triangle[f][k] == p) surface.uv[f][k] += by;
}

void expect_clean(const Surface& surface) {
  EXPECT_TRUE(uv_overlaps(surface.uv).empty());
  for (const Corners& corners : surface.uv) {
    EXPECT_GT(twice_uv_area(corners), 0);
    for (const glm::dvec2& p : corners) EXPECT_TRUE(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1);
  }
}

TEST(UvOverlaps, AreSharedInnerPoints) {
  const glm::dvec2 o(0, 0), x(1, 0), y(0, 1), xy(1, 1);
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  EXPECT_EQ(uv_overlaps({{o, x, xy}, {o, xy, y}}), Pairs{});           // neighbours
  EXPECT_EQ(uv_overlaps({{o, x, y}, {xy, {2, 1}, {1, 2}}}), Pairs{});  // apart
  EXPECT_EQ(uv_overlaps({{o, x, y}, {x, {2, 0}, {2, 1}}}), Pairs{});   // a common corner
  EXPECT_EQ(uv_overlaps({{o, x, xy}, {o, x, y}}), (Pairs{{0, 1}}));    // a common edge, on one side of it
  EXPECT_EQ(uv_overlaps({{o, x, xy}, {o, x, xy}}), (Pairs{{0, 1}}));   // equal
  EXPECT_EQ(uv_overlaps({{glm::dvec2(.6, .2), {.7, .2}, {.7, .3}}, {o, x, xy}}),
            (Pairs{{0, 1}}));  // one in the other
  EXPECT_EQ(uv_overlaps({{o, {3, .1}, {3, .2}}, {xy, {1, -1}, {1.1, 0}}}), (Pairs{{0, 1}}));  // a cross
  EXPECT_EQ(uv_overlaps({{o, xy, y}, {xy, o, x}}), Pairs{});     // neighbours, apart by first edges only
  EXPECT_EQ(uv_overlaps({{o, x, {2, 0}}, {o, x, y}}), Pairs{});  // a triangle without area
  const glm::dvec2 in(.2, .2);
  EXPECT_EQ(uv_overlaps({{in, in, {.3, .3}}, {o, x, y}}), Pairs{});  // equal corners
  EXPECT_EQ(uv_overlaps({{in, in, in}, {in, in, in}}), Pairs{});
  // Triangles of the size 0.01 that overlap by 2e-9.
  EXPECT_EQ(uv_overlaps({{o, {.01, 0}, {0, .01}}, {glm::dvec2(.01, 2e-9), {0, 2e-9}, {.005, -.01}}}).size(),
            1u);
}

// Lengths are in sides of a quad. The move flips triangle 0, and lays triangle 1 on triangles 2 and 3, which
// have a larger area. Triangles 3 and 6 are neighbours of 0 and 1; their centroids are sqrt(5)/3 = 0.7454
// away. The rest has the area 7. A disc of twice the growth has the area 6.993, then 7.069.
TEST(ChoosePieces, GrowsAPieceAndJoinsARestThatIsSmall) {
  Surface surface = sheet(3);
  move(surface, 0, glm::dvec2(1.2, -0.5) * (0.8 / 3));
  EXPECT_EQ(choose_pieces(surface, {0.746, 0}).piece, (std::vector<Faces>{{0, 1, 3, 6}}));
  EXPECT_EQ(choose_pieces(surface, {0.75, 0}).piece.at(0).size(), 18u);
}

TEST(Recut, ASpiralGetsOneChartPerTurn) {
  Surface surface = spiral(2.5);
  ASSERT_FALSE(uv_overlaps(surface.uv).empty());
  EXPECT_TRUE(recut(surface, false, "spiral"));
  expect_clean(surface);
  EXPECT_TRUE(surface.packed_uv);
  const UvQuality q = uv_quality(finish(surface, "spiral", glm::dvec3(0)));
  EXPECT_EQ(q.overlapping, 0.0);
  EXPECT_GE(q.charts, 3u);
  EXPECT_LE(q.charts, 6u);
  EXPECT_GT(q.area_low, 0.7);  // all charts have nearly the same scale
  EXPECT_LT(q.area_high, 1.4);
}

TEST(Recut, AMapWithoutOverlapsKeepsItsBits) {
  for (Surface surface : {spiral(0.9), sheet(20)}) {
    const std::vector<Corners> before = surface.uv;
    EXPECT_FALSE(recut(surface, false, "a"));
    EXPECT_EQ(surface.uv, before);
    EXPECT_TRUE(surface.notes.empty());
    EXPECT_FALSE(surface.packed_uv);
  }
}

TEST(Recut, TheRestOfTheMapKeepsItsUv) {
  Surface surface = sheet(60);
  move(surface, 30 + 61 * 30, {0.03, 0.02});
  const std::vector<Corners> before = surface.uv;
  ASSERT_GT(std::ranges::count_if(before, [](const Corners& c) { return twice_uv_area(c) < 0; }), 0);
  EXPECT_TRUE(recut(surface, false, "sheet"));
  expect_clean(surface);
  std::size_t same = 0;
  for (std::size_t f = 0; f < before.size(); ++f) same += surface.uv[f] == before[f];
  EXPECT_GT(same, before.size() * 9 / 10);
  EXPECT_LT(same, before.size());
  EXPECT_EQ(uv_quality(finish(surface, "sheet", glm::dvec3(0))).charts, 2u);
  EXPECT_EQ(surface.notes,
            std::vector<std::string>{"UV map: 1 part was cut out, because the map overlapped itself"});
}

// The map of sheets that lie on each other becomes smaller by at most a half. Each sheet then has 0.39 of the
// square's side, so that two of them fit beside each other, but not three.
TEST(Recut, FitsFourSheetsIntoTheSquareButNotFive) {
  for (const auto& [count, note] :
       {std::pair(4u, "UV map: 3 parts were cut out, because the map overlapped itself"),
        {5u, "UV map: 4 parts would need charts of their own, but the UV square has no space for them"}}) {
    const Surface one = sheet(4);
    Surface stack = one;
    for (std::uint32_t p = 25; p < 25 * count; p += 25) {
      stack.point.insert(stack.point.end(), one.point.begin(), one.point.end());
      stack.uv.insert(stack.uv.end(), one.uv.begin(), one.uv.end());
      for (const auto& [a, b, c] : one.triangle) stack.triangle.push_back({p + a, p + b, p + c});
    }
    const std::vector<Corners> before = stack.uv;
    EXPECT_TRUE(recut(stack, false, "stack"));
    EXPECT_EQ(stack.notes, std::vector<std::string>{note});
    EXPECT_EQ(stack.uv == before, count == 5);
    if (count == 4) expect_clean(stack);
  }
}

TEST(Recut, EvenCutsOutWhatTheMapShrinks) {
  Surface surface = sheet(60);
  // The map shrinks the middle of the sheet. The displacement keeps the order of the points.
  for (Corners& corners : surface.uv)
    for (glm::dvec2& p : corners) {
      const glm::dvec2 d = p - 0.5;
      const double r = glm::length(d) / 0.2;
      if (r < 1) p = 0.5 + d * (0.3 + 0.7 * r * r);
    }
  ASSERT_TRUE(uv_overlaps(surface.uv).empty());
  const UvQuality before = uv_quality(finish(surface, "sheet", glm::dvec3(0)));
  EXPECT_TRUE(recut(surface, true, "sheet"));
  expect_clean(surface);
  const UvQuality after = uv_quality(finish(surface, "sheet", glm::dvec3(0)));
  EXPECT_GT(after.charts, before.charts);
  EXPECT_LT(before.area_low, 0.3);
  EXPECT_GT(after.area_low, 0.6);
}

// Charts keep a distance of 2/256 from the border and of 4/256 from each other.
TEST(FreeSpace, GivesTheLowestPlaceApartFromTheRest) {
  const glm::dvec2 o(0, 0), quarter(0.25);
  FreeSpace empty, corner, space;
  EXPECT_EQ(empty.place(quarter), glm::dvec2(2, 2) / 256.0);
  EXPECT_EQ(empty.place(quarter), glm::dvec2(2 + 64 + 4, 2) / 256.0);
  corner.take({o, o, o});  // takes a cell, which is a quarter of 1/256 wide
  EXPECT_EQ(corner.place(quarter), glm::dvec2(1 + 4, 2) / 256.0);
  space.take({o, {0.25, 0}, {0, 0.5}});  // takes its whole bounding box, because triangles are small
  EXPECT_EQ(space.place(quarter), glm::dvec2(64 + 1 + 4, 2) / 256.0);
  EXPECT_EQ(space.place({0.9, 0.25}), glm::dvec2(2, 128 + 1 + 4) / 256.0);
  EXPECT_FALSE(space.place({0.9, 0.25}));
  EXPECT_EQ(FreeSpace().place(glm::dvec2(252) / 256.0), glm::dvec2(2) / 256.0);
  EXPECT_FALSE(FreeSpace().place(glm::dvec2(1, 253) / 256.0) ||
               FreeSpace().place(glm::dvec2(253, 1) / 256.0));
}

}  // namespace
}  // namespace pelage
