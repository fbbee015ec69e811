#include "harness/reference/layers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/reference/parallel.hpp"

namespace pelage::reference {

double layer_height(int n, int layers, Mutant mutant) {
  return double(n + (mutant == Mutant::height_without_one ? 0 : 1)) / double(layers);
}

double bezier_parameter(double h, const std::string& spacing) {
  return spacing == "uniform" ? 1.0 - std::sqrt(1.0 - h) : h;
}

glm::dvec3 bezier(const glm::dvec3& a, const glm::dvec3& b, double t) {
  return 2.0 * t * (1.0 - t) * a + t * t * b;
}

glm::dvec3 curl(double h, double rho, double radius, double turns, const glm::dvec3& u, const glm::dvec3& v) {
  const double alpha = (1.0 - rho) * radius * h, omega = 2.0 * std::numbers::pi * turns;
  return alpha * (std::cos(omega * h) * u + std::sin(omega * h) * v);
}

Geometry::Geometry(const FrameInput& input, const Mask& mask, int frames, const std::vector<char>& wanted,
                   Mutant mutant)
    : input_(&input), mutant_(mutant), separate_(input.scene.fur.binding == "separate") {
  const Mesh& mesh = *input.mesh;
  const StrandSet& strands = input.strands;
  const std::size_t faces = mesh.triangle.size(), count = separate_ ? 3 * faces : mesh.position.size();
  wanted_.assign(count, 0);
  bend_.resize(count);
  rho_.resize(count);
  std::vector<char> point_wanted(mesh.welded, 0), strand_wanted(faces, 0);
  for (std::size_t f = 0; f < faces; ++f) {
    if (!wanted.empty() && !wanted[f]) continue;
    strand_wanted[f] = 1;
    for (std::size_t c = 0; c < 3; ++c) {
      wanted_[slot(f, c)] = 1;
      point_wanted[mesh.weld[mesh.triangle[f][int(c)]]] = 1;
    }
  }
  if (!separate_)  // a surface point follows the strands of all its triangles
    for (std::size_t p = 0; p < point_wanted.size(); ++p)
      if (point_wanted[p])
        for (std::uint32_t i = strands.row[p]; i < strands.row[p + 1]; ++i)
          strand_wanted[strands.face[i]] = 1;

  std::vector<Bend> of_strand(faces);
  for_each_index(faces, 256, [&](std::size_t f) {
    if (!strand_wanted[f]) return;
    of_strand[f] = {double(input.scene.fur.length) * glm::dvec3(strands.normal[f]),
                    simulate(input, f, frames).tip};
  });
  for_each_index(count, 1024, [&](std::size_t s) {
    if (!wanted_[s]) return;
    const std::uint32_t point = mesh.weld[vertex(s)];
    rho_[s] = mask.nearest(glm::dvec2(input.curl.mask_uv[point])).wetness;
    if (separate_) {
      bend_[s] = of_strand[s / 3];
      return;
    }
    for (std::uint32_t i = strands.row[point]; i < strands.row[point + 1]; ++i) {
      bend_[s].a += double(strands.weight[i]) * of_strand[strands.face[i]].a;
      bend_[s].b += double(strands.weight[i]) * of_strand[strands.face[i]].b;
    }
  });
}

std::size_t Geometry::slot(std::size_t face, std::size_t corner) const {
  return separate_ ? 3 * face + corner : std::size_t(input_->mesh->triangle[face][int(corner)]);
}

std::uint32_t Geometry::vertex(std::size_t slot) const {
  return separate_ ? input_->mesh->triangle[slot / 3][int(slot % 3)] : std::uint32_t(slot);
}

glm::dvec3 Geometry::curl_offset(std::size_t slot, int n) const {
  if (n < 0) return glm::dvec3(0.0);
  const Scene& scene = input_->scene;
  const std::uint32_t point = input_->mesh->weld[vertex(slot)];
  return curl(layer_height(n, scene.fur.layers, mutant_), rho_[slot], double(scene.curl.radius),
              double(scene.curl.turns), glm::dvec3(input_->curl.u[point]), glm::dvec3(input_->curl.v[point]));
}

glm::dvec3 Geometry::position(std::size_t slot, int n) const {
  const glm::dvec3 surface(input_->mesh->position[vertex(slot)]);
  if (n < 0) return surface;
  const FurScene& fur = input_->scene.fur;
  const double t = bezier_parameter(layer_height(n, fur.layers, mutant_), fur.layer_spacing);
  return surface + bezier(bend_[slot].a, bend_[slot].b, t) + curl_offset(slot, n);
}

glm::dvec3 chord(const FrameInput& input, const Bend& bend, int n, Mutant mutant) {
  const FurScene& fur = input.scene.fur;
  const auto at = [&](int layer) {
    const double h = layer < 0 ? 0.0 : layer_height(layer, fur.layers, mutant);
    return bezier(bend.a, bend.b, bezier_parameter(h, fur.layer_spacing));
  };
  return at(n) - at(n - 1);
}

std::vector<glm::dvec3> layer_positions(const FrameInput& input, const Geometry& geometry, int n) {
  std::vector<glm::dvec3> corners(3 * input.mesh->triangle.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = geometry.position(geometry.slot(i / 3, i % 3), n);
  return corners;
}

}  // namespace pelage::reference
