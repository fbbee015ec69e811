#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/mesh/mesh.hpp"
#include "harness/prepare/strands.hpp"
#include "tests/prepare/meshes.hpp"

namespace pelage {
namespace {

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
