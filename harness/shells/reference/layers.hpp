// Positions of the layers: S Eq. 1 and 4 and the strand's Bezier curve, or B Eq. 3 and 4 for sticks.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/strands.hpp"

namespace pelage::reference {

/// Returns the height h_n = (1 + n) / N of layer n, and 0 for the base surface (n = -1).
double layer_height(int n, int layers, Mutant mutant = Mutant::none);

/// Returns the Bezier parameter t of height h: h for spacing "paper", 1 - sqrt(1 - h) for "uniform".
double bezier_parameter(double h, const std::string& spacing);

/// Returns the point at t of the quadratic Bezier curve with the control points root, p0 and p, relative to
/// the root. a = p0 - root, b = p - root.
glm::dvec3 bezier(const glm::dvec3& a, const glm::dvec3& b, double t);

/// Returns the curl offset of S Eq. 4, in R, with alpha(h) = (1 - rho) K_alpha h. `radius` is K_alpha in R,
/// `turns` is omega / 2 pi, and u and v are the axes of the curl.
glm::dvec3 curl(double h, double rho, double radius, double turns, const glm::dvec3& u, const glm::dvec3& v);

/// The bend of a vertex: two control points of its Bezier curve, or two vectors of its stick.
struct Bend {
  glm::dvec3 a{0.0};  ///< p0 - root, or L0 n for a stick; R
  glm::dvec3 b{0.0};  ///< p - root, or L0 s for a stick; R
};

/// Returns the bend of a stick by B Eq. 3. `top` is the stick's top minus its base; only its direction s is
/// used. `length` is L0 in R. `normal` n is unit. For the bend "tangent", the part of s - n along n is
/// removed.
Bend stick_bend(const DynamicsScene& dynamics, double length, const glm::dvec3& normal,
                const glm::dvec3& top);

/// Returns the displacement of a layer at height h by B Eq. 4, in R: h L0 n + h^k L0 (s - n). k is 1 for the
/// bend "linear".
glm::dvec3 stick_displacement(const DynamicsScene& dynamics, const Bend& bend, double h,
                              Mutant mutant = Mutant::none);

/// The positions of all layers at one time. A slot is a point of the mesh with a displacement of its own. It
/// is a vertex copy, or a corner of a triangle if triangles do not share vertices (parts()).
class Geometry {
 public:
  /// Computes the bend and the wetness of the slots after `frames` frames. `wanted` has one entry per face: 0
  /// for faces to skip. If it is empty, all faces are computed. With a mass-spring topology, `sticks` (as in
  /// Options) is used instead of simulated strands.
  Geometry(const FrameInput& input, const Mask& mask, int frames, const std::vector<char>& wanted = {},
           Mutant mutant = Mutant::none, const std::vector<glm::dvec3>& sticks = {});

  std::size_t slots() const { return bend_.size(); }
  bool wanted(std::size_t slot) const { return wanted_[slot] != 0; }
  std::size_t slot(std::size_t face, std::size_t corner) const;
  std::uint32_t vertex(std::size_t slot) const;  ///< index of the slot's vertex copy
  const Bend& bend(std::size_t slot) const { return bend_[slot]; }
  glm::dvec3 position(std::size_t slot, int n) const;  ///< in R; n = -1 is the base surface
  /// Returns the curl offset of S Eq. 4 for the slot on layer n, in R. It is 0 for the base surface.
  glm::dvec3 curl_offset(std::size_t slot, int n) const;

 private:
  const FrameInput* input_;
  Mutant mutant_;
  bool separate_;
  std::vector<char> wanted_;
  std::vector<Bend> bend_;
  std::vector<double> rho_;  ///< the mask's wetness at the slot's surface point
};

/// Returns the strand's step from layer n - 1 to layer n, B(t_n) - B(t_(n-1)), not normalized. It is used as
/// the strand's direction at layer n.
glm::dvec3 chord(const FrameInput& input, const Bend& bend, int n, Mutant mutant = Mutant::none);

/// Returns the three corner positions of every triangle on layer n, in R. n = -1 is the base surface.
std::vector<glm::dvec3> layer_positions(const FrameInput& input, const Geometry& geometry, int n);

}  // namespace pelage::reference
