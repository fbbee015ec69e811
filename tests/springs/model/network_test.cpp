// Tests the numbers of masses and springs in the networks that build() returns. The expected numbers follow
// from the numbers of vertices, edges and faces. For the models of paper B (Banisch and Wuethrich 2006), they
// must also equal the numbers in this paper. Stick springs connect fixed base masses to free top masses. Edge
// springs connect top masses.
#include "harness/springs/model/network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs {
namespace {

using namespace test;

constexpr float length = 0.05f;

void expect_counts(const SpringNetwork& network, std::size_t masses, std::size_t springs) {
  EXPECT_EQ(network.mass.size(), masses) << network.kind.name;
  EXPECT_EQ(network.spring.size(), springs) << network.kind.name;
  EXPECT_EQ(network.copy.size(), network.sticks()) << network.kind.name;
}

void expect_formulas(const Mesh& mesh) {
  const std::size_t f = mesh.triangle.size();
  for (const Vertices vertices : {Vertices::points, Vertices::copies}) {
    const bool points = vertices == Vertices::points;
    const std::size_t v = points ? mesh.welded : mesh.position.size(), e = edge_count(mesh, points);
    expect_counts(build(Kind::sticks, mesh, length, vertices), 2 * v, v);
    expect_counts(build(Kind::prisms, mesh, length, vertices), 2 * v, v + e);
    expect_counts(build(Kind::separable_sticks, mesh, length, vertices), 6 * f, 3 * f);
    expect_counts(build(Kind::separable_prisms, mesh, length, vertices), 6 * f, 6 * f);
  }
}

TEST(Topology, CountsFollowFromVerticesEdgesAndFaces) {
  expect_formulas(square(1));
  expect_formulas(square(5));
  expect_formulas(sphere(2));
  expect_formulas(cut_in_two(sphere(2)));
  expect_formulas(*load_model("banisch-elephant"));
  EXPECT_GT(cut_in_two(sphere(2)).position.size(), sphere(2).position.size());
}

TEST(Topology, SticksStandOnTheSkinAndReachTheLayer) {
  const Mesh mesh = cut_in_two(sphere(1));
  for (const Kind kind : kinds) {
    const SpringNetwork network = build(kind, mesh, length);
    for (std::size_t i = 0; i < network.sticks(); ++i) {
      EXPECT_EQ(network.mass[i], mesh.position[network.copy[i]]);
      EXPECT_NEAR(glm::length(network.mass[network.top(i)] - network.mass[i]), length, 1e-6);
      EXPECT_NEAR(glm::length(network.normal[i]), 1, 1e-6);
      EXPECT_GT(glm::dot(network.normal[i], network.mass[i]), 0.99f) << "outwards on a sphere";
      EXPECT_EQ(network.spring[i], glm::uvec2(i, network.top(i)));
    }
    for (const glm::uvec2 edge : network.edges()) {
      EXPECT_GE(edge.x, network.sticks());
      EXPECT_GE(edge.y, network.sticks());
      EXPECT_NE(edge.x, edge.y);
    }
  }
}

TEST(Topology, SeparableOnesAreClosedAtRestAndOneIslandPerTriangle) {
  const Mesh mesh = sphere(1);
  const SpringNetwork apart = build(Kind::separable_prisms, mesh, length),
                      whole = build(Kind::prisms, mesh, length);
  for (std::size_t f = 0; f < mesh.triangle.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(apart.mass[apart.top(3 * f + c)], whole.mass[whole.top(mesh.triangle[f][int(c)])]);
  ASSERT_EQ(apart.edges().size(), 3 * mesh.triangle.size());
  for (std::size_t e = 0; e < apart.edges().size(); ++e) {
    const std::size_t f = e / 3, c = e % 3;
    EXPECT_EQ(apart.edges()[e], glm::uvec2(apart.top(3 * f + c), apart.top(3 * f + (c + 1) % 3)));
  }
}

TEST(Topology, OnCopiesASeamIsOpenAndOnPointsItIsNot) {
  const Mesh mesh = cut_in_two(sphere(1));
  const SpringNetwork points = build(Kind::prisms, mesh, length, Vertices::points),
                      copies = build(Kind::prisms, mesh, length, Vertices::copies);
  // Returns the number of top masses that a path of edge springs connects to the first edge spring.
  const auto reached = [](const SpringNetwork& network) {
    std::set<std::uint32_t> seen{network.edges()[0].x};
    for (std::size_t before = 0; before != seen.size();) {
      before = seen.size();
      for (const glm::uvec2 edge : network.edges())
        if (seen.contains(edge.x) || seen.contains(edge.y)) seen.insert({edge.x, edge.y});
    }
    return seen.size();
  };
  EXPECT_EQ(reached(points), points.sticks());
  EXPECT_LT(reached(copies), copies.sticks());
}

TEST(Topology, DegreesCountTheSpringsOfATop) {
  const Mesh mesh = square(2);
  EXPECT_EQ(degrees(build(Kind::sticks, mesh, length)).most, 1);
  const Degrees apart = degrees(build(Kind::separable_prisms, mesh, length));
  EXPECT_EQ(apart.least, 3);
  EXPECT_EQ(apart.most, 3);
  const Degrees whole = degrees(build(Kind::prisms, mesh, length));
  EXPECT_EQ(whole.least, 1 + 3);  // a top mass at a corner has 1 stick spring and 3 edge springs
  EXPECT_EQ(whole.most, 1 + 8);   // the top mass at the centre has 1 stick spring and 8 edge springs
  EXPECT_DOUBLE_EQ(whole.mean, (13 + 2 * 28) / 13.0);
}

TEST(Hit, TakesTheTriangleThatTheRayMeetsAndNoneBesideIt) {
  // The near triangle covers half of the unit square. The far triangle has four times the area of the near
  // triangle.
  const Mesh mesh = test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 1}, {0, 2, 1}},
                                  {{3, 4, 5}, {0, 1, 2}});
  const auto from = [&](double x, double y) { return hit(mesh, {x, y, -1}, {0, 0, 1}); };
  EXPECT_EQ(from(0.3, 0.3), 1u);
  EXPECT_EQ(from(0.49, 0.49), 1u);
  EXPECT_EQ(from(0.52, 0.52), 0u) << "beyond the near triangle's third side";
  EXPECT_EQ(from(0.9, 0.9), 0u);
  EXPECT_FALSE(from(1.1, 1.1));
  EXPECT_FALSE(from(-0.01, 0.5));
  EXPECT_FALSE(from(0.5, -0.01));
  EXPECT_FALSE(hit(mesh, {0.3, 0.3, 2}, {0, 0, 1})) << "behind the origin";
  EXPECT_EQ(hit(mesh, {0.3, 0.3, 2}, {0, 0, -1}), 0u);
}

TEST(Topology, RefusesWhatHasNoMeaning) {
  Mesh empty = square(1);
  empty.triangle.clear();
  EXPECT_THROW(build(Kind::sticks, empty, length), InputError);
  for (const float bad : {0.0f, -1.0f, NAN, INFINITY})
    EXPECT_THROW(build(Kind::sticks, square(1), bad), InputError) << bad;
  EXPECT_THROW(kind_of("prism"), InputError);
  for (const Kind kind : kinds) EXPECT_EQ(kind_of(std::string(kind.name)), kind);
}

}  // namespace
}  // namespace pelage::springs
