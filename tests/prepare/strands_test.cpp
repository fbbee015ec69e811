// Tests the strands of the triangles, the tangents of the surface, and the tangent frames of the curls.
#include "harness/prepare/strands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/mesh/mesh.hpp"
#include "tests/prepare/meshes.hpp"

namespace pelage {
namespace {

const Skin& torus() {
  static const Skin skin = weld(*load_model("torus"));
  return skin;
}

TEST(Strands, UprightUnlessCombed) {
  FurScene fur;
  fur.comb = 0;
  fur.comb_noise = 0;
  const FaceSprings set = make_strands(torus(), fur, {});
  ASSERT_EQ(set.anchor.size(), torus().triangle.size());
  for (std::size_t f = 0; f < set.anchor.size(); ++f) {
    EXPECT_EQ(set.anchor[f], fur.length * set.normal[f]);
    EXPECT_NEAR(glm::length(set.normal[f]), 1.0, 1e-6);
  }
}

TEST(Strands, CombedAnchorsHaveTheFursLengthAndStayOutside) {
  FurScene fur;
  fur.comb_noise = 0.3f;
  const FaceSprings set = make_strands(torus(), fur, {});
  int leaning = 0;
  for (std::size_t f = 0; f < set.anchor.size(); ++f) {
    EXPECT_NEAR(glm::length(set.anchor[f]), fur.length, 1e-6 * fur.length);
    const float upright = glm::dot(set.anchor[f], set.normal[f]) / fur.length;
    EXPECT_GT(upright, 0.5f);
    leaning += upright < 0.95f;
  }
  EXPECT_GT(leaning, int(set.anchor.size()) / 3);
}

TEST(Strands, CombRunsAlongItsDirection) {
  FurScene fur;
  fur.comb_direction = {1, 0, 0};
  const Skin skin = weld(*test::two_charts());
  const FaceSprings set = make_strands(skin, fur, {});
  for (const glm::vec3& a : set.anchor) {
    EXPECT_GT(a.x, 0.3f * fur.length);
    EXPECT_NEAR(a.z, 0.0f, 1e-6f);
  }
}

TEST(Strands, CombDoesNotJumpBetweenNeighbours) {
  FurScene fur;
  const Skin& skin = torus();
  const FaceSprings set = make_strands(skin, fur, {});
  double worst = 0;
  for (std::size_t w = 0; w < skin.position.size(); ++w)
    for (std::uint32_t k = set.row[w] + 1; k < set.row[w + 1]; ++k) {
      const double bend = std::acos(std::clamp(
          double(glm::dot(set.anchor[set.face[k]], set.anchor[set.face[k - 1]])) / fur.length / fur.length,
          -1.0, 1.0));
      const double crease = std::acos(
          std::clamp(double(glm::dot(set.normal[set.face[k]], set.normal[set.face[k - 1]])), -1.0, 1.0));
      worst = std::max(worst, bend - crease);
    }
  // The tilt of the strands changes fastest at points where the comb direction is normal to the surface. If
  // the surface normal turns there by a small angle, the tangent of the tilt angle changes by 2.4 times this
  // angle. The factor is fur.comb / least_grip = 0.6 / 0.25 (least_grip is defined in
  // harness/prepare/strands.cpp). Between adjacent faces the normal turns by 5.5 degrees. If the tilt were
  // discontinuous at such a point, adjacent strands would differ by 90 degrees.
  EXPECT_LT(worst * 180 / std::numbers::pi, 2.4 * 5.5);
}

TEST(Strands, WeightsAreAMeanByArea) {
  const FaceSprings set = make_strands(torus(), {}, {});
  ASSERT_EQ(set.row.size(), torus().position.size() + 1);
  ASSERT_EQ(set.row.back(), set.face.size());
  ASSERT_EQ(set.face.size(), 3 * torus().triangle.size());
  for (std::size_t w = 0; w + 1 < set.row.size(); ++w) {
    double sum = 0;
    for (std::uint32_t k = set.row[w]; k < set.row[w + 1]; ++k) {
      sum += double(set.weight[k]);
      const glm::uvec3 t = torus().triangle[set.face[k]];
      EXPECT_TRUE(t.x == w || t.y == w || t.z == w);
      EXPECT_NEAR(set.weight[k] / set.weight[set.row[w]],
                  torus().area[set.face[k]] / torus().area[set.face[set.row[w]]], 1e-5);
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
  }
}

TEST(Strands, GustsTravelAlongTheWind) {
  WindScene wind;
  wind.direction = {0, 0, 3};
  wind.wavelength = 0.5f;
  const FaceSprings set = make_strands(torus(), {}, wind);
  for (std::size_t f = 0; f < set.root.size(); f += 97) {
    const double phase = 2 * std::numbers::pi * double(set.root[f].z) / 0.5;
    EXPECT_NEAR(set.phase[f].x, std::cos(phase), 1e-5);
    EXPECT_NEAR(set.phase[f].y, std::sin(phase), 1e-5);
  }
}

TEST(Strands, RestTipsAreTheWeightedMean) {
  FurScene fur;
  fur.comb = 0;
  const Skin skin = weld(*test::two_charts());
  const auto tips = rest_tips(skin, make_strands(skin, fur, {}));
  for (std::size_t w = 0; w < tips.size(); ++w)
    EXPECT_LT(glm::distance(tips[w], glm::vec3(skin.position[w]) + glm::vec3(0, fur.length, 0)), 1e-6f);
}

double degrees(glm::vec3 a, glm::vec3 b) {
  return std::acos(std::clamp(double(glm::dot(a, b)), -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// Compares the vectors frame.u at the two ends of every edge of the mesh, and returns the largest angle
/// between them in degrees. frame.u is the first axis of the curl's tangent frame.
double worst_edge(const Skin& skin, const CurlFrame& frame) {
  double worst = 0;
  for (const glm::uvec3& t : skin.triangle)
    for (int c = 0; c < 3; ++c) worst = std::max(worst, degrees(frame.u[t[c]], frame.u[t[(c + 1) % 3]]));
  return worst;
}

void expect_orthonormal(const Skin& skin, const CurlFrame& frame) {
  ASSERT_EQ(frame.u.size(), skin.position.size());
  for (std::size_t w = 0; w < frame.u.size(); ++w) {
    EXPECT_NEAR(glm::length(frame.u[w]), 1.0, 1e-5);
    EXPECT_NEAR(glm::length(frame.v[w]), 1.0, 1e-5);
    EXPECT_NEAR(glm::dot(frame.u[w], frame.v[w]), 0.0, 1e-5);
    EXPECT_NEAR(glm::dot(frame.u[w], glm::vec3(skin.normal[w])), 0.0, 1e-5);
    EXPECT_NEAR(glm::dot(frame.v[w], glm::vec3(skin.normal[w])), 0.0, 1e-5);
  }
}

/// Returns two_charts() with every u replaced by 1 - u. X is the surface point at (u, v). The cross product
/// of dX/du and dX/dv then points against the surface normal.
std::shared_ptr<const Mesh> mirrored_charts() {
  auto mesh = std::make_shared<Mesh>(*test::two_charts());
  for (glm::vec2& uv : mesh->uv) uv.x = 1 - uv.x;
  return mesh;
}

TEST(SurfaceTangents, AreTheAtlasGradientAlsoOfAMirroredChart) {
  for (const auto& mesh : {test::two_charts(), mirrored_charts()}) {
    const SurfaceTangents s = surface_tangents(*mesh, weld(*mesh));
    for (const glm::uvec3& f : mesh->triangle)
      for (int c = 0; c < 3; ++c) {
        const glm::vec2 d = mesh->uv[f[(c + 1) % 3]] - mesh->uv[f[c]];
        const glm::vec3 step = s.t[f[c]] * d.x + s.b[f[c]] * d.y;
        EXPECT_LT(glm::distance(step, mesh->position[f[(c + 1) % 3]] - mesh->position[f[c]]), 1e-5f);
      }
  }
}

TEST(CurlFrame, OfUvPointsAlongUAndVInAMirroredChart) {
  for (const auto& mesh : {test::two_charts(), mirrored_charts()}) {
    const Skin skin = weld(*mesh);
    const SurfaceTangents s = surface_tangents(*mesh, skin);
    CurlScene curl;
    curl.frame = "uv";
    const CurlFrame frame = curl_frame(*mesh, skin, s, curl);
    expect_orthonormal(skin, frame);
    for (std::size_t w = 0; w < frame.u.size(); ++w) {
      const std::size_t copy = skin.first_copy[w];
      EXPECT_GT(glm::dot(frame.u[w], glm::normalize(s.t[copy])), 0.99f);
      EXPECT_GT(glm::dot(frame.v[w], glm::normalize(s.b[copy])), 0.99f);
    }
  }
}

TEST(SurfaceTangents, FollowTheTorus) {
  const auto mesh = load_model("torus");
  const SurfaceTangents s = surface_tangents(*mesh, weld(*mesh));
  double u = 0, v = 0;
  for (const glm::vec3& t : s.t) u += double(glm::length(t));
  for (const glm::vec3& b : s.b) v += double(glm::length(b));
  EXPECT_NEAR(u / double(s.t.size()), mesh->length_per_uv.x, 0.02 * u / double(s.t.size()));
  EXPECT_NEAR(v / double(s.b.size()), mesh->length_per_uv.y, 0.02 * v / double(s.b.size()));
}

TEST(SurfaceTangents, SurviveTrianglesWithoutUvArea) {
  auto mesh = std::make_shared<Mesh>(*test::two_charts());
  std::fill(mesh->uv.begin(), mesh->uv.end(), glm::vec2(0.5f));
  const Skin skin = weld(*mesh);
  const SurfaceTangents s = surface_tangents(*mesh, skin);
  for (std::size_t i = 0; i < s.t.size(); ++i) EXPECT_TRUE(std::isfinite(glm::length(s.t[i] + s.b[i])));
  for (const char* kind : {"smooth", "uv"}) {
    CurlScene curl;
    curl.frame = kind;
    expect_orthonormal(skin, curl_frame(*mesh, skin, s, curl));
  }
}

TEST(CurlFrame, IsOrthonormalAndSmoothAcrossSeams) {
  const auto mesh = test::two_charts();
  const Skin skin = weld(*mesh);
  const SurfaceTangents s = surface_tangents(*mesh, skin);
  CurlScene curl;
  const CurlFrame smooth = curl_frame(*mesh, skin, s, curl);
  expect_orthonormal(skin, smooth);
  EXPECT_LT(worst_edge(skin, smooth), 12.0);
  curl.frame = "uv";
  const CurlFrame raw = curl_frame(*mesh, skin, s, curl);
  expect_orthonormal(skin, raw);
  EXPECT_GT(worst_edge(skin, raw), 80.0);  // the two charts are rotated by 90 degrees relative to each other
}

TEST(CurlFrame, TorusHasNoJump) {
  const auto mesh = load_model("torus");
  const Skin skin = weld(*mesh);
  const CurlFrame frame = curl_frame(*mesh, skin, surface_tangents(*mesh, skin), {});
  expect_orthonormal(skin, frame);
  // The tube of the torus has 65 edges per turn, so an edge spans 360 / 65 = 5.5 degrees of this turn.
  EXPECT_LT(worst_edge(skin, frame), 8.0);
}

TEST(CurlFrame, PhaseVariesSmoothlyOverTheBody) {
  const auto mesh = load_model("torus");
  const Skin skin = weld(*mesh);
  const SurfaceTangents s = surface_tangents(*mesh, skin);
  CurlScene curl;
  const CurlFrame still = curl_frame(*mesh, skin, s, curl);
  curl.variation = 0.25f;
  const CurlFrame varied = curl_frame(*mesh, skin, s, curl);
  expect_orthonormal(skin, varied);
  double most = 0;
  for (std::size_t w = 0; w < still.u.size(); ++w) {
    most = std::max(most, degrees(still.u[w], varied.u[w]));
    EXPECT_GT(glm::dot(glm::cross(varied.u[w], varied.v[w]), glm::vec3(skin.normal[w])), 0.99f);
  }
  EXPECT_GT(most, 45.0);
  // In units of the model's radius R, edges are at most 0.1 long, and the noise of the curl's phase varies
  // over distances of 0.4. At the edge with the greatest change of the noise, the vectors u at the two ends
  // differ by 84 degrees.
  EXPECT_LT(worst_edge(skin, varied), 90.0);
}

TEST(CurlFrame, SamplesTheMaskAtTheFirstCopy) {
  const auto mesh = test::two_charts();
  const Skin skin = weld(*mesh);
  const CurlFrame frame = curl_frame(*mesh, skin, surface_tangents(*mesh, skin), {});
  for (std::size_t w = 0; w < frame.mask_uv.size(); ++w) {
    std::size_t first = 0;
    while (mesh->weld[first] != w) ++first;
    EXPECT_EQ(frame.mask_uv[w], mesh->uv[first]);
  }
}

}  // namespace
}  // namespace pelage
