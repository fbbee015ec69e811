#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/prepare/random.hpp"
#include "harness/prepare/strands.hpp"

namespace pelage {
namespace {

constexpr int smooth_iterations = 60;
constexpr double phase_size = 0.4;  // wavelength of the noise in the curl's phase, in R (the mesh radius)

glm::dvec3 unit_tangent(glm::dvec3 v, glm::dvec3 n) {
  const glm::dvec3 flat = tangential(v, n);
  const double length = glm::length(flat);
  return length > 1e-9 ? flat / length : any_tangent(n);
}

}  // namespace

SurfaceTangents surface_tangents(const Mesh& mesh, const Skin& skin) {
  const std::size_t copies = mesh.position.size();
  std::vector<glm::dvec3> t(copies, glm::dvec3(0)), b(copies, glm::dvec3(0));
  std::vector<double> weight(copies, 0);
  for (const glm::uvec3& f : mesh.triangle) {
    const glm::dvec3 e1 = glm::dvec3(mesh.position[f.y]) - glm::dvec3(mesh.position[f.x]);
    const glm::dvec3 e2 = glm::dvec3(mesh.position[f.z]) - glm::dvec3(mesh.position[f.x]);
    const glm::dvec2 d1 = glm::dvec2(mesh.uv[f.y]) - glm::dvec2(mesh.uv[f.x]);
    const glm::dvec2 d2 = glm::dvec2(mesh.uv[f.z]) - glm::dvec2(mesh.uv[f.x]);
    const double det = d1.x * d2.y - d2.x * d1.y;  // twice the UV area, negative for a flipped triangle
    const double sign = det < 0 ? -1.0 : 1.0;
    for (int c = 0; c < 3; ++c) {
      t[f[c]] += sign * (d2.y * e1 - d1.y * e2);
      b[f[c]] += sign * (d1.x * e2 - d2.x * e1);
      weight[f[c]] += std::abs(det);
    }
  }
  SurfaceTangents out;
  out.t.reserve(copies);
  out.b.reserve(copies);
  for (std::size_t v = 0; v < copies; ++v) {
    if (weight[v] > 1e-20) {
      out.t.push_back(glm::vec3(t[v] / weight[v]));
      out.b.push_back(glm::vec3(b[v] / weight[v]));
    } else {
      const glm::dvec3 n = skin.normal[mesh.weld[v]], u = any_tangent(n);
      out.t.push_back(mesh.length_per_uv.x * glm::vec3(u));
      out.b.push_back(mesh.length_per_uv.y * glm::vec3(glm::cross(n, u)));
    }
  }
  return out;
}

CurlFrame curl_frame(const Mesh& mesh, const Skin& skin, const SurfaceTangents& tangents,
                     const CurlScene& curl) {
  const std::size_t points = skin.position.size();
  const bool smooth = curl.frame == "smooth";
  std::vector<glm::dvec3> u(points, glm::dvec3(0));
  if (smooth) {
    for (std::size_t v = 0; v < mesh.position.size(); ++v)
      u[mesh.weld[v]] += unit_tangent(glm::dvec3(tangents.t[v]), skin.normal[mesh.weld[v]]);
  } else {
    for (std::size_t w = 0; w < points; ++w) u[w] = glm::dvec3(tangents.t[skin.first_copy[w]]);
  }
  for (std::size_t w = 0; w < points; ++w) u[w] = unit_tangent(u[w], skin.normal[w]);
  if (smooth) u = smooth_tangents(skin, std::move(u), smooth_iterations, true);

  CurlFrame frame;
  for (std::size_t w = 0; w < points; ++w) {
    const std::uint32_t copy = skin.first_copy[w];
    glm::dvec3 v = glm::cross(skin.normal[w], u[w]);
    if (smooth && curl.variation != 0.0f) {
      const double turn = double(curl.variation) * noise(skin.position[w] / phase_size, 0xc021u);
      const double c = std::cos(2.0 * std::numbers::pi * turn), s = std::sin(2.0 * std::numbers::pi * turn);
      const glm::dvec3 turned = c * u[w] + s * v;
      v = c * v - s * u[w];
      u[w] = turned;
    }
    // Where the UV map is mirrored, n x u points against dX/dv.
    if (!smooth && glm::dot(v, glm::dvec3(tangents.b[copy])) < 0) v = -v;
    frame.u.push_back(glm::vec3(u[w]));
    frame.v.push_back(glm::vec3(v));
    frame.mask_uv.push_back(mesh.uv[copy]);
  }
  return frame;
}

}  // namespace pelage
