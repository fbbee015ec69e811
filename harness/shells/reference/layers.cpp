#include "harness/shells/reference/layers.hpp"

#include <cmath>
#include <numbers>

#include "harness/parallel.hpp"
#include "harness/prepare/strands.hpp"
#include "harness/shells/reference/vector.hpp"

namespace pelage::reference {
namespace {

/// Returns the displacement of a vertex from the base surface to layer n due to the bend alone (without the
/// curl). It is 0 for the base surface, n = -1.
glm::dvec3 bent(const FrameInput& input, const Bend& bend, int n, Mutant mutant) {
  const FurScene& fur = input.scene.fur;
  const double h = n < 0 ? 0.0 : layer_height(n, fur.layers, mutant);
  if (has_springs(input.scene.dynamics)) return stick_displacement(input.scene.dynamics, bend, h, mutant);
  return bezier(bend.a, bend.b, bezier_parameter(h, fur.layer_spacing));
}

}  // namespace

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

Bend stick_bend(const DynamicsScene& dynamics, double length, const glm::dvec3& normal,
                const glm::dvec3& top) {
  const glm::dvec3 s = unit(top);
  glm::dvec3 off = s - normal;
  if (dynamics.bend == "tangent") off -= glm::dot(off, normal) * normal;
  return {length * normal, length * (normal + off)};
}

glm::dvec3 stick_displacement(const DynamicsScene& dynamics, const Bend& bend, double h, Mutant mutant) {
  if (dynamics.bend == "trigonometric") {
    const double length = glm::length(bend.a);
    const glm::dvec3 n = unit(bend.a), s = unit(bend.b), across = s - glm::dot(s, n) * n;
    const double lean = h * std::atan2(glm::length(across), glm::dot(s, n));
    return h * length * (std::cos(lean) * n + std::sin(lean) * unit(across));
  }
  const bool straight = dynamics.bend == "linear" || mutant == Mutant::sticks_straight;
  return h * bend.a + std::pow(h, straight ? 1.0 : double(dynamics.bend_power)) * (bend.b - bend.a);
}

Geometry::Geometry(const FrameInput& input, const Mask& mask, int frames, const std::vector<char>& wanted,
                   Mutant mutant, const std::vector<glm::dvec3>& sticks)
    : input_(&input),
      mutant_(mutant),
      separate_(parts(input.scene)),
      colliders_(input.scene, input.contact_fields, time_after(input.scene.dynamics, frames)) {
  const bool on_sticks = has_springs(input.scene.dynamics);
  const Mesh& mesh = *input.mesh;
  const FaceSprings& strands = input.strands;
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
  if (!separate_ && !on_sticks)  // a point's bend is a mean over the strands of the triangles around it
    for (std::size_t p = 0; p < point_wanted.size(); ++p)
      if (point_wanted[p])
        for (std::uint32_t i = strands.row[p]; i < strands.row[p + 1]; ++i)
          strand_wanted[strands.face[i]] = 1;

  std::vector<Bend> of_strand(faces);
  for_each_index(faces, 256, [&](std::size_t f) {
    if (!strand_wanted[f] || on_sticks) return;
    of_strand[f] = {double(strand_length(input.scene.fur, input.style, f)) * glm::dvec3(strands.normal[f]),
                    simulate(input, f, frames).tip};
  });
  for_each_index(count, 1024, [&](std::size_t s) {
    if (!wanted_[s]) return;
    const std::uint32_t point = mesh.weld[vertex(s)];
    rho_[s] = mask.wetness_at(glm::dvec2(input.curl.mask_uv[point]), input.scene.clump.cells);
    if (on_sticks) {
      const glm::dvec3 normal(input.stick_normal[point]);
      const std::size_t turned = mutant == Mutant::corners_turned ? s / 3 * 3 + (s + 1) % 3 : s;
      const bool copies = input.scene.dynamics.springs.vertices == "copies";
      bend_[s] = stick_bend(input.scene.dynamics, double(input.scene.fur.length), normal,
                            sticks.empty() ? normal
                                           : sticks[separate_ ? turned
                                                    : copies  ? s
                                                              : point]);
      return;
    }
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

Geometry::CurlAxes Geometry::curl_axes(std::size_t slot) const {
  const std::uint32_t point = input_->mesh->weld[vertex(slot)];
  const double radius = double(share_of(input_->style.curl_radius, point)) *
                        double(input_->scene.curl.radius) * (1.0 - rho_[slot]);
  return {radius * glm::dvec3(input_->curl.u[point]), radius * glm::dvec3(input_->curl.v[point])};
}

double Geometry::turns_share(std::size_t slot) const {
  return double(share_of(input_->style.curl_turns, input_->mesh->weld[vertex(slot)]));
}

glm::dvec3 Geometry::curl_offset(std::size_t slot, int n) const {
  if (n < 0) return glm::dvec3(0.0);
  const CurlAxes axes = curl_axes(slot);
  return curl(layer_height(n, input_->scene.fur.layers, mutant_), 0.0, 1.0,
              turns_share(slot) * double(input_->scene.curl.turns), axes.u, axes.v);
}

glm::dvec3 Geometry::position(std::size_t slot, int n) const {
  const glm::dvec3 surface(input_->mesh->position[vertex(slot)]);
  if (n < 0) return surface;
  const glm::dvec3 along = bent(*input_, bend_[slot], n, mutant_) + curl_offset(slot, n);
  return surface + (colliders_.none() ? along : colliders_.kept(surface, along));
}

glm::dvec3 rise(const FrameInput& input, const Bend& bend, int from, int to, Mutant mutant) {
  return bent(input, bend, to, mutant) - bent(input, bend, from, mutant);
}

glm::dvec3 chord(const FrameInput& input, const Bend& bend, int n, Mutant mutant) {
  return rise(input, bend, n - 1, n, mutant);
}

glm::dvec3 curl_change(const Scene& scene, double share, const Geometry::CurlAxes& axes, int from, int to) {
  const double turns = std::round(share * turn_steps) / turn_steps * double(scene.curl.turns);
  const auto at = [&](int layer) {
    const double h = layer < 0 ? 0.0 : layer_height(layer, scene.fur.layers);
    return curl(h, 0.0, 1.0, turns, axes.u, axes.v);
  };
  return at(to) - at(from);
}

}  // namespace pelage::reference
