// Tests mesh files with several components: which components are kept, and how their charts are packed.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "harness/mesh/quality.hpp"
#include "harness/mesh/steps.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

/// Builds the text of an OBJ file that consists of octahedra and triangles.
class Shapes {
 public:
  Shapes& octahedron(glm::vec3 centre, float radius, bool inside_out = false) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const float side : {1.0f, -1.0f}) {
        glm::vec3 p = centre;
        p[axis] += side * radius;
        text_ += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
      }
    }
    const int faces[8][3] = {{1, 3, 5}, {3, 2, 5}, {2, 4, 5}, {4, 1, 5},
                             {3, 1, 6}, {2, 3, 6}, {4, 2, 6}, {1, 4, 6}};
    for (const auto& f : faces)
      text_ += fmt::format("f {} {} {}\n", f[0] + first_, f[inside_out ? 2 : 1] + first_,
                           f[inside_out ? 1 : 2] + first_);
    first_ += 6;
    return *this;
  }
  Shapes& triangle(glm::vec3 at, float size) {
    text_ += fmt::format("v {} {} {}\nv {} {} {}\nv {} {} {}\nf {} {} {}\n", at.x, at.y, at.z, at.x + size,
                         at.y, at.z, at.x, at.y + size, at.z, first_ + 1, first_ + 2, first_ + 3);
    first_ += 3;
    return *this;
  }
  std::shared_ptr<const Mesh> mesh(const MeshOptions& options = fresh()) const {
    return load_model(test::Folder().write("shapes.obj", text_), options);
  }

 private:
  std::string text_;
  int first_ = 0;
};

TEST(Components, OfAFileEachGetsAChart) {
  MeshOptions options = fresh();
  std::string said;
  options.silent_s = 0;
  options.progress = [&](const std::string& line) { said += line; };
  const auto mesh = Shapes()
                        .octahedron({0, 0, 0}, 1)
                        .octahedron({4, 0, 0}, 0.1f)
                        .octahedron({0, 4, 0}, 0.5f)
                        .triangle({0, 0, 4}, 1)
                        .mesh(options);
  EXPECT_TRUE(!bits_of_cgal || mesh->hash == "d8e70d630cb74a8a") << mesh->hash;
  test::expect_has(said, ": making a coarse version, component 4 of 4, ");
  const Topology t = topology(*mesh);
  EXPECT_EQ(t.components, 4u);
  EXPECT_EQ(t.genus, 0);
  EXPECT_EQ(mesh->triangle.size(), 25u);
  EXPECT_TRUE(t.manifold());
  const UvQuality q = uv_quality(*mesh);
  EXPECT_EQ(q.charts, 4u);
  EXPECT_EQ(q.overlapping, 0.0);
  EXPECT_EQ(q.flipped_faces, 0u);
  EXPECT_GT(q.covered, 0.2);
  // All charts have the same scale, so a texel covers the same area on small and on large components.
  EXPECT_GT(q.area_low, 0.5);
  EXPECT_LT(q.area_high, 2.0);
}

// Two texels of a mask of 256 x 256 texels lie around each chart. Many charts have narrower margins. Equal
// charts fill the square in as many columns as rows; of two charts, the second lies above the first.
TEST(Components, HaveMarginsAroundTheirCharts) {
  for (const auto& [count, rows, margin] : {std::tuple(2u, 2, 2.0 / 256), {400u, 20, 0.1 / 20}}) {
    Surface square, all;
    square.point = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}};
    square.triangle = {{0, 1, 2}, {0, 2, 3}};
    const glm::dvec2 o(0, 0), x(1, 0), xy(1, 1), y(0, 1);
    square.uv = {{o, x, xy}, {o, xy, y}};
    for (std::uint32_t p = 0; p < 4 * count; p += 4) {
      all.point.insert(all.point.end(), square.point.begin(), square.point.end());
      for (const auto& [a, b, c] : square.triangle) all.triangle.push_back({p + a, p + b, p + c});
    }
    const std::vector<Surface::Corners> uv = packed(all, std::vector<Surface>(count, square)).uv;
    double least = 1;
    for (std::size_t f = 0; f < uv.size(); ++f)
      for (std::size_t g = (f / 2 + 1) * 2; g < uv.size(); ++g)
        for (int k = 0; k < 9; ++k)
          least = std::min(least, glm::distance(uv[f][std::size_t(k % 3)], uv[g][std::size_t(k / 3)]));
    EXPECT_NEAR(least, 2 * margin, 2e-5);
    EXPECT_NEAR(glm::distance(uv[0][0], uv[0][1]), 1.0 / rows - 2 * margin, 2e-5);
    EXPECT_EQ(uv[0][0].x == uv[2][0].x, count == 2);
  }
}

TEST(Components, ThatAreOpenAndSmallAreDropped) {
  const auto mesh =
      Shapes().octahedron({0, 0, 0}, 1).triangle({0, 0, 4}, 0.1f).octahedron({3, 0, 0}, 0.01f).mesh();
  EXPECT_EQ(topology(*mesh).components, 2u);  // closed components are kept even if they are small
  EXPECT_EQ(std::ranges::count(mesh->notes, "kept 2 of 3 components; the others are open and small"), 1);
}

TEST(Components, MayShareAPoint) {
  const auto mesh = Shapes().triangle({0, 0, 0}, 1).triangle({1, 0, 0}, 1).mesh();
  EXPECT_EQ(std::ranges::count(mesh->notes, "split 1 point shared by faces of inconsistent orientation"), 1);
}

TEST(Components, AreTurnedOutwardsEachForItself) {
  const auto mesh = Shapes().octahedron({0, 0, 0}, 1).octahedron({4, 0, 0}, 1, true).mesh();
  double volume = 0;
  for (const glm::uvec3& t : mesh->triangle)
    volume += double(glm::dot(mesh->position[t.x], glm::cross(mesh->position[t.y], mesh->position[t.z]))) / 6;
  EXPECT_NEAR(volume, 2 * (4.0 / 3) / 27, 1e-5);  // the mesh's radius is three times that of an octahedron
}

TEST(Components, ThatAreOpenAreNotTurned) {
  Surface surface;
  for (const double size : {0.5, 1.0})
    for (const glm::dvec3 p : {glm::dvec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
      surface.point.push_back(size * p);
  // A closed tetrahedron, and one without its last face. Both are inside out.
  surface.triangle = {{1, 3, 2}, {0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {4, 5, 6}, {4, 7, 5}, {5, 7, 6}};
  turn_outwards(surface);
  EXPECT_EQ(surface.triangle,
            (std::vector<Surface::Triangle>{
                {1, 2, 3}, {0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {4, 5, 6}, {4, 7, 5}, {5, 7, 6}}));
  EXPECT_EQ(surface.notes, std::vector<std::string>{"turned the faces of 1 components outwards"});
  surface.triangle = {{1, 3, 2}, {0, 1, 2}, {0, 3, 1}, {0, 2, 3}};
  turn_outwards(surface);
  EXPECT_EQ(surface.notes.back(), "turned all faces outwards");
  surface.triangle = {{0, 1, 2}, {0, 2, 1}};  // closed, but without a volume
  turn_outwards(surface);
  EXPECT_EQ(surface.notes.size(), 2u);
}

TEST(Components, AreNumberedInTheOrderOfTheTriangles) {
  Surface surface;
  for (int i = 0; i < 7; ++i) surface.point.emplace_back(i, i * i, 0);
  surface.triangle = {{4, 5, 6}, {0, 1, 2}, {1, 2, 3}};
  EXPECT_EQ(components(surface), (std::vector<std::uint32_t>{0, 1, 1}));
  const std::vector<Surface> parts = split(surface);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[1].triangle.size(), 2u);
  EXPECT_EQ(parts[1].point.size(), 4u);
  EXPECT_EQ(parts[0].point[0], surface.point[4]);
  EXPECT_TRUE(split(Surface()).empty());
}

}  // namespace
}  // namespace pelage
