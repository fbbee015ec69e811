#include "harness/mesh/quality.hpp"

#include <limits>

#include "harness/mesh/mesh.hpp"
#include "harness/mesh/unfold.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

// Returns a mesh of triangles in the plane z = 0. The UV of a vertex at (x, y, 0) is (x, y). Every corner of
// a triangle has its own vertex. Vertices at the same position share a surface point.
Mesh flat(const std::vector<std::array<glm::vec2, 3>>& triangles) {
  Mesh mesh;
  std::vector<glm::vec2> points;
  for (const auto& triangle : triangles) {
    const auto first = std::uint32_t(mesh.position.size());
    for (const glm::vec2& p : triangle) {
      std::uint32_t point = 0;
      while (point < points.size() && points[point] != p) ++point;
      if (point == points.size()) points.push_back(p);
      mesh.position.emplace_back(p, 0);
      mesh.uv.push_back(p);
      mesh.weld.push_back(point);
    }
    mesh.triangle.emplace_back(first, first + 1, first + 2);
  }
  mesh.welded = std::uint32_t(points.size());
  return mesh;
}

const glm::vec2 o(0, 0), x(1, 0), y(0, 1), xy(1, 1);

TEST(Quality, of_two_triangles_that_make_the_square) {
  const Mesh mesh = flat({{o, x, xy}, {o, xy, y}});
  const Topology t = topology(mesh);
  EXPECT_EQ(t.points, 4u);
  EXPECT_EQ(t.edges, 5u);
  EXPECT_EQ(t.boundary_edges, 4u);
  EXPECT_EQ(t.borders, 1u);
  EXPECT_EQ(t.components, 1u);
  EXPECT_EQ(t.genus, 0);
  EXPECT_TRUE(t.manifold());
  const UvQuality q = uv_quality(mesh, 100);
  EXPECT_EQ(q.charts, 2u);  // the two triangles share surface points, but no vertices
  EXPECT_EQ(q.flipped_faces, 0u);
  EXPECT_EQ(q.overlapping, 0.0);  // the centres of texels on the common edge count only once
  EXPECT_NEAR(q.covered, 1.0, 1e-9);
  EXPECT_NEAR(q.area_low, 1.0, 1e-6);
  EXPECT_NEAR(q.area_high, 1.0, 1e-6);

  // A texel whose centre is the common corner of four triangles belongs to one of them.
  const glm::vec2 centre(0.5f);
  const UvQuality fan =
      uv_quality(flat({{o, x, centre}, {x, xy, centre}, {xy, y, centre}, {y, o, centre}}), 1);
  EXPECT_EQ(fan.covered, 1.0);
  EXPECT_EQ(fan.overlapping, 0.0);
}

TEST(Quality, of_a_mesh_without_faces_is_a_number) {
  const UvQuality q = uv_quality(Mesh{}, 8);
  EXPECT_EQ(q.charts, 0u);
  EXPECT_EQ(q.flipped, 0.0);
  EXPECT_EQ(q.overlapping, 0.0);
  EXPECT_TRUE(uv_warnings(Mesh{}).empty());
}

TEST(Quality, knows_overlaps_and_faces_turned_over) {
  // The second triangle is the first one with reversed orientation.
  const Mesh mesh = flat({{o, x, xy}, {o, xy, x}});
  const UvQuality q = uv_quality(mesh, 100);
  EXPECT_EQ(q.flipped_faces, 1u);
  EXPECT_NEAR(q.flipped, 0.5, 1e-6);
  EXPECT_NEAR(q.overlapping, 1.0, 1e-9);
  EXPECT_NEAR(q.covered, 0.5, 0.01);
  EXPECT_EQ(uv_quality(flat(std::vector<std::array<glm::vec2, 3>>(256, {o, x, xy})), 1).overlapping, 1.0);
  EXPECT_EQ(uv_quality(flat({{o, y, glm::vec2(0.5f)}}), 9).flipped, 1.0);
}

TEST(Quality, warns_of_overlaps_and_faces_turned_over_and_of_nothing_else) {
  // The third triangle covers 52 of the 2048 x 2048 texels, and the fourth has no area.
  const glm::vec2 near(0.005f, 0), corner(0.005f);
  EXPECT_TRUE(uv_warnings(flat({{o, x, xy}, {o, xy, y}, {o, near, corner}, {o, x, x}})).empty());
  const std::vector<std::string> overlap = uv_warnings(flat({{o, x, xy}, {o, x, xy}, {o, xy, y}}));
  ASSERT_EQ(overlap.size(), 1u);
  // The faces overlap in half of the covered square.
  EXPECT_TRUE(overlap[0].starts_with("UV map: 50.0")) << overlap[0];
  const std::vector<std::string> turned = uv_warnings(flat({{o, x, xy}, {o, y, xy}}));
  ASSERT_EQ(turned.size(), 1u);
  EXPECT_TRUE(
      turned[0].starts_with("UV map: 1 face is flipped (clockwise in UV; 50.0000% of the area of the map)"))
      << turned[0];
}

TEST(Quality, knows_what_is_no_manifold) {
  const glm::vec2 far(2, 0.5f);
  EXPECT_FALSE(topology(flat({{o, x, y}, {o, x, xy}})).manifold());
  EXPECT_EQ(topology(flat({{o, x, y}, {o, x, xy}})).bad_edges, 1u);                  // same direction o to x
  EXPECT_EQ(topology(flat({{o, x, y}, {x, o, xy}, {x, o, far}})).bad_edges, 1u);     // three faces
  EXPECT_EQ(topology(flat({{o, x, y}, {x, far, glm::vec2(2, 0)}})).bad_points, 1u);  // only x is common
}

TEST(Quality, area_ratio_of_a_map_that_squeezes_one_half) {
  Mesh mesh = flat({{o, x, xy}, {o, xy, y}});
  for (int k = 3; k < 6; ++k)
    // The ratio of UV area to surface area is 1 in the first triangle and 0.25 in the second. The mean ratio
    // is 0.625.
    mesh.uv[std::size_t(k)] *= 0.5f;
  const UvQuality q = uv_quality(mesh, 100);
  EXPECT_NEAR(q.area_low, 0.25 / 0.625, 1e-6);
  EXPECT_NEAR(q.area_high, 1 / 0.625, 1e-6);
  EXPECT_EQ(q.area_median, q.area_low);  // that of exactly half the area
  EXPECT_EQ(q.area_5, q.area_low);
  EXPECT_EQ(q.area_95, q.area_high);
}

/// Returns the triangles, each with its smallest index first. A reader may begin a face at another corner.
std::vector<glm::uvec3> from_the_smallest(std::vector<glm::uvec3> triangles) {
  for (glm::uvec3& t : triangles)
    while (t.x > t.y || t.x > t.z) t = {t.y, t.z, t.x};
  return triangles;
}

TEST(WritePly, what_is_written_is_a_mesh_with_its_map) {
  const test::Folder folder;
  const auto mesh = load_model("square", fresh());
  const std::string file = (folder.path / "square.ply").string();
  write_ply(file, *mesh);
  const auto back = load_model(file, fresh({}, true));
  EXPECT_EQ(from_the_smallest(back->triangle), from_the_smallest(mesh->triangle));
  EXPECT_EQ(back->uv, mesh->uv);
  for (std::size_t i = 0; i < mesh->position.size(); ++i)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(back->position[i][k], mesh->position[i][k], 1e-6f);
}

TEST(WritePly, a_place_that_cannot_be_written_is_named) {
  const test::Folder folder;
  const std::string file = (folder.path / "none" / "a.ply").string();
  test::expect_has(test::refusal([&] { write_ply(file, Mesh{}); }), file + ": cannot be written");
}

/// Returns the quality of a UV map of `faces` triangles side by side. The first `flipped` triangles are
/// flipped.
MapQuality quality_of(std::size_t faces, std::size_t flipped) {
  std::vector<glm::dvec2> uv;
  std::vector<Surface::Triangle> triangles;
  for (std::size_t f = 0; f < faces; ++f) {
    const auto first = std::uint32_t(uv.size());
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)})
      uv.push_back(corner + glm::dvec2(f, 0));
    triangles.push_back({first, first + (f < flipped ? 2u : 1u), first + (f < flipped ? 1u : 2u)});
  }
  return map_quality(uv, triangles);
}

TEST(MapQuality, allows_one_flipped_face_in_fifty) {
  EXPECT_TRUE(quality_of(100, 0).usable);
  EXPECT_TRUE(quality_of(100, 2).usable);
  EXPECT_EQ(quality_of(100, 2).flipped, 2u);
  EXPECT_FALSE(quality_of(100, 3).usable);
  EXPECT_EQ(quality_of(100, 3).flipped, 3u);
}

TEST(MapQuality, asks_for_a_finite_map_of_some_area) {
  const std::vector<Surface::Triangle> one{{0, 1, 2}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(map_quality({{0, 0}, {1, 0}, {0, nan}}, one).usable);
  EXPECT_FALSE(map_quality({{0, 0}, {1, 0}, {2, 0}}, one).usable);
  EXPECT_EQ(map_quality({{0, 0}, {1, 0}, {2, 0}}, one).flipped, 1u);
  EXPECT_TRUE(map_quality({{0, 0}, {1, 0}, {0, 1}}, one).usable);
  // One face in fifty is flipped. Its area is that of the other faces together, so the map has the area 0.
  std::vector<Surface::Triangle> balanced(49, {0, 1, 2});
  balanced.push_back({0, 3, 1});
  EXPECT_FALSE(map_quality({{0, 0}, {1, 0}, {0, 1}, {0, 49}}, balanced).usable);
}

}  // namespace
}  // namespace pelage
