// Strands of a file: their curves against the B-spline of their points, and their pictures on the device
// against the double-precision reference.
#include "tests/strands/support/file_strands.hpp"

#include <gtest/gtest.h>

#include <map>

#include "harness/compare/strands.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "tests/strands/support/strands.hpp"

namespace pelage::strands {
namespace {

using Vec = glm::dvec3;
using pelage::test::curly;

struct FileStrands : pelage::test::FileStrands {};

/// Draws a frame on the device and compares it with the reference.
void expect_frame(const std::shared_ptr<const StrandInput>& input, int frames,
                  const DrawerOptions& options = {}) {
  Strands strands(test::queue().device(), input, options);
  if (frames > 0) {
    strands.advance(frames - 1);
    strands.frame();
  } else {
    strands.still();
  }
  StrandFrame frame{strands.keys(), {}, strands.order(), strands.read()};
  frame.curves = strands.curves();
  frame.skin = strands.surface();
  EXPECT_GT(frame.order.size(), 200u);
  for (const Check& check : check_strand_frame(*input, frame, 1).checks)
    EXPECT_TRUE(check.holds()) << check.metric << " is " << check.value << ", the limit is " << check.limit;
}

// The place of a quadratic B-spline by its recursion (Cox and de Boor), over knots that repeat at both ends.
Vec de_boor(const std::vector<Vec>& p, double x) {
  const std::size_t n = p.size();
  const auto knot = [&](std::size_t i) { return i < 3 ? 0.0 : i < n ? double(i - 2) : double(n - 2); };
  std::size_t k = 2;
  while (k + 1 < n && x >= knot(k + 1)) ++k;
  std::array<Vec, 3> d{p[k - 2], p[k - 1], p[k]};
  for (std::size_t r = 1; r <= 2; ++r)
    for (std::size_t j = 2; j >= r; --j) {
      const std::size_t i = j + k - 2;
      const double a = (x - knot(i)) / (knot(i + 1 + 2 - r) - knot(i));
      d[j] = (1 - a) * d[j - 1] + a * d[j];
    }
  return d[2];
}

TEST_F(FileStrands, AtRestAreTheSplinesOfTheirPoints) {
  const auto in = input();
  const std::vector<DrawnStrand> curves = reference_curves(*in, in->fur.keys);
  const Polylines& lines = in->mesh->strands->lines;
  std::map<std::array<float, 3>, std::size_t> first;  // by root
  const std::vector<std::size_t> start = first_points(lines);
  for (std::size_t i = 0; i < start.size(); ++i) {
    const glm::vec3 at = lines.point[start[i]];
    first[{at.x, at.y, at.z}] = i;
  }
  std::size_t compared = 0, piece = 0;
  for (const DrawnStrand& curve : curves) {
    ASSERT_TRUE(curve.part);
    piece = curve.part->from == 0 ? 0 : piece + 1;
    const glm::vec3 root = curve.part->root;
    const auto found = first.find({root.x, root.y, root.z});
    ASSERT_NE(found, first.end());
    const std::size_t number = found->second, count = lines.count[number];
    if (count < 3) continue;
    std::vector<Vec> p;
    for (std::size_t k = 0; k < count; ++k) p.emplace_back(lines.point[start[number] + k]);
    for (const double t : {0.0, 0.3, 0.5, 0.9, 1.0}) {
      const Vec here = (1 - t) * (1 - t) * Vec(curve.point[0]) + 2 * t * (1 - t) * Vec(curve.point[1]) +
                       t * t * Vec(curve.point[2]);
      const double x = std::min(double(piece) + t, double(count - 2) - 1e-12);
      EXPECT_LT(glm::distance(here, de_boor(p, x)), 2e-6);
      ++compared;
    }
  }
  EXPECT_GT(compared, 5000u);
}

// If both segments of the chain turn alike, the whole strand turns like a rigid body.
TEST_F(FileStrands, TurnWithTheirChains) {
  const auto in = input();
  std::vector<KeyStrand> keys = in->fur.keys;
  for (KeyStrand& key : keys) {
    const Vec n(key.normal), rest(key.rest), axis = glm::cross(rest, n);
    if (glm::length(axis) < 0.2) continue;
    const Vec turned = glm::normalize(rest + 0.8 * (n - rest));  // away from the skin
    key.first = key.second = glm::vec3(turned);
  }
  const std::vector<DrawnStrand> before = reference_curves(*in, in->fur.keys),
                                 after = reference_curves(*in, keys);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Vec root(before[i].part->root);
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_NEAR(glm::distance(Vec(before[i].point[a]), root), glm::distance(Vec(after[i].point[a]), root),
                  3e-6);
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_NEAR(glm::distance(before[i].point[a], before[i].point[b]),
                    glm::distance(after[i].point[a], after[i].point[b]), 3e-6f);
    }
    moved += glm::distance(before[i].point[2], after[i].point[2]) > 0.01f;
  }
  EXPECT_GT(moved, before.size() / 4);
}

TEST_F(FileStrands, LookAsTheReferenceDrawsThem) {
  for (const char* shadow : {"none", "linear", "exp"}) {
    scene.strands.shadow = shadow;
    expect_frame(input(), 0);
  }
  scene.strands.subdivision = "strand";
  scene.strands.layers.front().response = 1.5f;
  scene.strands.layers.front().gloss = 2;
  expect_frame(input(), 20);
  scene.strands.fraction = 0.4f;
  scene.strands.back_facing = "last";
  expect_frame(input(), 5, {.mapping = Drawing::group});
  scene.strands.skin_shadow = 0;
  scene.strands.skin = false;
  scene.strands.shadow = "none";
  scene.strands.layers.front() = {};
  expect_frame(input(), 20, {.mapping = Drawing::group, .lanes = 1});
  expect_frame(input(), 20, {.lanes = 1, .tile_lanes = 8, .tile = 128});
}

// Some strands go through the mesh, and some lie on it: their chains begin above the skin.
TEST_F(FileStrands, MayPointBelowTheSkin) {
  Polylines lines = curly(*torus, 1500);
  std::size_t first = 0;
  for (std::size_t i = 0; i < lines.count.size(); first += lines.count[i++]) {
    const Vec root(lines.point[first]);
    for (std::size_t k = 1; k < lines.count[i]; ++k) {
      const Vec along = Vec(lines.point[first + k]) - root;
      lines.point[first + k] = glm::vec3(i % 2 == 0 ? root - along : root + 1e-5 * along);
    }
  }
  write(lines);
  const auto in = input();
  for (const KeyStrand& key : in->fur.keys) {
    EXPECT_GE(glm::dot(key.rest, key.normal), 0);
    EXPECT_NEAR(glm::length(key.rest), 1, 1e-6f);
  }
  for (const Chain& chain : in->fur.chains) EXPECT_GE(chain.length, 1e-4f);
  expect_frame(in, 10);
}

TEST_F(FileStrands, WithoutAMesh) {
  scene.model = "none";
  scene.strands.back_facing = "drawn";
  scene.strands.fraction = 0.9f;
  const auto in = input();
  float radius = 0;
  for (const glm::vec3& p : in->mesh->strands->lines.point) radius = std::max(radius, glm::length(p));
  EXPECT_NEAR(radius, 1, 1e-5f);
  EXPECT_EQ(in->mesh->name, "none");
  EXPECT_FALSE(in->skin);
  expect_frame(in, 10);
}

// The file has the strands of a fur layer: the root, the joint and the tip of each are the control points of
// its curve, so both pictures show the same curves.
TEST_F(FileStrands, OfThreePointsAreTheGrownOnes) {
  Scene grown = scene;
  grown.strands.groom = "grown";
  grown.strands.file.clear();
  grown.strands.layers.front().count = 2000;
  grown.strands.layers.front().curvature = 60;
  grown.strands.shadow = "none";
  grown.strands.skin_shadow = 0;
  grown.strands.back_facing = "drawn";  // the normals of both are not quite the same
  const auto first = prepare_strands(grown, torus);
  Polylines lines;
  for (const DrawnStrand& s : reference_curves(*first, first->fur.keys)) {
    lines.count.push_back(3);
    for (std::size_t k = 0; k < 3; ++k) {
      lines.point.push_back(s.point[k]);
      lines.colour.push_back(s.colour);
      lines.width.push_back(float(2 * reference::half_width(first->look, s, 0.5 * double(k))));
    }
  }
  write(lines);
  scene.strands = grown.strands;
  scene.strands.groom = "file";
  scene.strands.file = folder.path / "fur.hair";
  const auto second = input();
  const Picture a = reference_strands(*first, first->fur.keys, first->skin).picture;
  Camera same = first->camera;
  auto seen = std::make_shared<StrandInput>(*second);
  seen->camera = same;
  seen->range = first->range;
  const Picture b = reference_strands(*seen, seen->fur.keys, seen->skin).picture;
  EXPECT_GE(compare(a, b).psnr, tolerance::same_groom_psnr);
}

TEST_F(FileStrands, OfAnotherMeshAreRefused) {
  Polylines lines = curly(*torus, 100);
  for (glm::vec3& p : lines.point) p = 3.0f * p + glm::vec3(1, 2, 3);
  write(lines);
  try {
    input();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("from the surface of torus; give strands.file_unit"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace pelage::strands
