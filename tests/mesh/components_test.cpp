// Tests mesh files with several components: which components are kept, and how their charts are packed.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "harness/mesh/quality.hpp"
#include "harness/mesh/steps.hpp"
#include "tests/mesh/mesh_files.hpp"

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
  const auto mesh = Shapes()
                        .octahedron({0, 0, 0}, 1)
                        .octahedron({4, 0, 0}, 0.1f)
                        .octahedron({0, 4, 0}, 0.5f)
                        .triangle({0, 0, 4}, 1)
                        .mesh();
  const Topology t = topology(*mesh);
  EXPECT_EQ(t.components, 4u);
  EXPECT_EQ(mesh->triangle.size(), 25u);
  EXPECT_TRUE(t.manifold());
  const UvQuality q = uv_quality(*mesh);
  EXPECT_EQ(q.charts, 4u);
  EXPECT_EQ(q.overlapping, 0.0);
  EXPECT_EQ(q.flipped_faces, 0u);
  EXPECT_GT(q.covered, 0.2);
  for (const glm::vec2& uv : mesh->uv) {
    EXPECT_GE(std::min(uv.x, uv.y), 0.0f);
    EXPECT_LE(std::max(uv.x, uv.y), 1.0f);
  }
  // All charts have the same scale, so a texel covers the same area on small and on large components.
  EXPECT_GT(q.area_low, 0.5);
  EXPECT_LT(q.area_high, 2.0);
}

TEST(Components, LieApartByAtLeastTwoTexelsOfAMask) {
  const auto mesh = Shapes().octahedron({0, 0, 0}, 1).octahedron({4, 0, 0}, 1).mesh();
  const std::vector<std::uint32_t> chart = charts(*mesh);
  ASSERT_EQ(*std::max_element(chart.begin(), chart.end()), 1u);
  const int side = 256;
  std::vector<int> owner(std::size_t(side * side), -1);
  for (std::size_t f = 0; f < chart.size(); ++f) {  // the loops sample many points of every triangle
    const glm::uvec3 t = mesh->triangle[f];
    for (int i = 0; i <= 200; ++i) {
      for (int j = 0; i + j <= 200; ++j) {
        const glm::vec2 p = mesh->uv[t.x] + (mesh->uv[t.y] - mesh->uv[t.x]) * (float(i) / 200) +
                            (mesh->uv[t.z] - mesh->uv[t.x]) * (float(j) / 200);
        const int x = std::min(side - 1, int(p.x * side)), y = std::min(side - 1, int(p.y * side));
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            if (x + dx < 0 || y + dy < 0 || x + dx >= side || y + dy >= side) continue;
            int& o = owner[std::size_t(y + dy) * std::size_t(side) + std::size_t(x + dx)];
            ASSERT_TRUE(o == -1 || o == int(chart[f])) << x << " " << y;
            o = int(chart[f]);
          }
        }
      }
    }
  }
}

TEST(Components, ThatAreOpenAndSmallAreDropped) {
  const auto mesh =
      Shapes().octahedron({0, 0, 0}, 1).triangle({0, 0, 4}, 0.1f).octahedron({3, 0, 0}, 0.01f).mesh();
  EXPECT_EQ(topology(*mesh).components, 2u);  // closed components are kept even if they are small
  EXPECT_EQ(std::count(mesh->notes.begin(), mesh->notes.end(),
                       "kept 2 of 3 components; the others are open and small"),
            1);
}

TEST(Components, AreTurnedOutwardsEachForItself) {
  const auto mesh = Shapes().octahedron({0, 0, 0}, 1).octahedron({4, 0, 0}, 1, true).mesh();
  glm::vec3 low(1e9f), high(-1e9f);
  for (const glm::vec3& p : mesh->position) low = glm::min(low, p), high = glm::max(high, p);
  const float middle = (low.x + high.x) / 2;
  double volume[2] = {0, 0};
  for (const glm::uvec3& t : mesh->triangle) {
    const glm::vec3 a = mesh->position[t.x], b = mesh->position[t.y], c = mesh->position[t.z];
    const bool right = a.x > middle;
    const glm::vec3 centre(right ? (middle + high.x) / 2 : (middle + low.x) / 2, 0, 0);
    volume[right] += double(glm::dot(a - centre, glm::cross(b - centre, c - centre)));
  }
  EXPECT_GT(volume[0], 0);
  EXPECT_GT(volume[1], 0);
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
}

}  // namespace
}  // namespace pelage
