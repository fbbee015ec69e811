#include "harness/prepare/strands.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/prepare/random.hpp"

namespace pelage {
namespace {

constexpr double noise_size = 0.1;  // wavelength of the random part of the tilt, in R (the mesh radius)
// This constant limits the tilt (comb_field()) where the comb direction is nearly normal to the surface. The
// comb direction is a unit vector. Let g be the length of the projection of this vector onto the tangent
// plane. Before noise and smoothing, the length of the tilt is g * fur.comb / sqrt(g^2 + least_grip^2). This
// length is fur.comb / sqrt(2) where g is equal to least_grip, and 0 where g is 0.
constexpr double least_grip = 0.25;
constexpr int comb_iterations = 20;  // number of iterations of smooth_tangents()

/// Returns the tilt of the strands at each surface point. The tilt is a tangential vector, and its length is
/// the tangent of the angle between strand and normal. Where the comb direction is nearly normal to the
/// surface, its tangential part changes direction rapidly. The tilt therefore decreases to 0 there.
std::vector<glm::dvec3> comb_field(const Skin& skin, const FurScene& fur, const Style& style) {
  const glm::dvec3 given(fur.comb_direction);
  const glm::dvec3 direction = glm::length(given) > 0 ? glm::normalize(given) : glm::dvec3(0);
  std::vector<glm::dvec3> lean;
  lean.reserve(skin.position.size());
  for (std::size_t w = 0; w < skin.position.size(); ++w) {
    const glm::dvec3 t = tangential(direction, skin.normal[w]);
    const double grip = glm::length(t);
    const glm::dvec3 p = skin.position[w] / noise_size;
    const glm::dvec3 ruffle(noise(p, fur.seed + 11u), noise(p, fur.seed + 23u), noise(p, fur.seed + 37u));
    const float comb = style.comb.empty() ? fur.comb : fur.comb * style.comb[w];
    lean.push_back(double(comb) * t / std::hypot(grip, least_grip) +
                   double(fur.comb_noise) * 2.0 * tangential(ruffle, skin.normal[w]));
  }
  return smooth_tangents(skin, std::move(lean), comb_iterations, false);
}

}  // namespace

glm::vec2 gust_phase(const glm::dvec3& root, const WindScene& wind) {
  const glm::dvec3 blow(wind.direction);
  const glm::dvec3 along = glm::length(blow) > 0 ? glm::normalize(blow) : glm::dvec3(0);
  const double phase = 2.0 * std::numbers::pi * glm::dot(root, along) / double(wind.wavelength);
  return {float(std::cos(phase)), float(std::sin(phase))};
}

FaceSprings make_strands(const Skin& skin, const FurScene& fur, const WindScene& wind, const Style& style) {
  const std::size_t faces = skin.triangle.size();
  const bool combed = fur.comb != 0.0f || fur.comb_noise != 0.0f;
  const auto lean = combed ? comb_field(skin, fur, style) : std::vector<glm::dvec3>();

  FaceSprings set;
  for (std::size_t f = 0; f < faces; ++f) {
    const glm::uvec3 t = skin.triangle[f];
    const glm::dvec3 root = (skin.position[t.x] + skin.position[t.y] + skin.position[t.z]) / 3.0;
    const glm::vec3 normal(skin.face_normal[f]);
    set.root.push_back(glm::vec3(root));
    set.normal.push_back(normal);
    const float length = strand_length(fur, style, f);
    if (combed) {
      const glm::dvec3 mean = (lean[t.x] + lean[t.y] + lean[t.z]) / 3.0;
      const glm::dvec3 n = skin.face_normal[f];
      set.anchor.push_back(glm::vec3(double(length) * glm::normalize(n + tangential(mean, n))));
    } else {
      set.anchor.push_back(length * normal);
    }
    set.phase.push_back(gust_phase(root, wind));
  }

  set.row = skin.row;
  set.face = skin.face;
  set.weight.resize(set.face.size());
  for (std::size_t w = 0; w + 1 < set.row.size(); ++w) {
    double total = 0;
    for (std::uint32_t k = set.row[w]; k < set.row[w + 1]; ++k) total += skin.area[set.face[k]];
    for (std::uint32_t k = set.row[w]; k < set.row[w + 1]; ++k)
      set.weight[k] = float(total > 0 ? skin.area[set.face[k]] / total : 1.0 / (set.row[w + 1] - set.row[w]));
  }
  return set;
}

std::vector<glm::vec3> rest_tips(const Skin& skin, const FaceSprings& set) {
  std::vector<glm::vec3> tips;
  tips.reserve(skin.position.size());
  for (std::size_t w = 0; w < skin.position.size(); ++w) {
    glm::vec3 lift(0);
    for (std::uint32_t k = set.row[w]; k < set.row[w + 1]; ++k)
      lift += set.weight[k] * set.anchor[set.face[k]];
    tips.push_back(glm::vec3(skin.position[w]) + lift);
  }
  return tips;
}

std::vector<glm::vec3> rest_tips(const Skin& skin, const std::vector<glm::vec3>& normal, float length) {
  std::vector<glm::vec3> tips;
  tips.reserve(normal.size());
  for (std::size_t w = 0; w < normal.size(); ++w)
    tips.push_back(glm::vec3(skin.position[w]) + length * normal[w]);
  return tips;
}

}  // namespace pelage
