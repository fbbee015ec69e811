// Positions of the layers: on the strands of S by S Eq. 1 and 4 and a Bezier curve, on the sticks of a
// mass-spring topology by B Eq. 3 and 4. Lengths are in R.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/strands.hpp"

namespace pelage::reference {

/// Returns the height h_n = (1 + n) / N of layer n, where N = `layers`. The base surface, n = -1, has the
/// height 0.
double layer_height(int n, int layers, Mutant mutant = Mutant::none);

/// Returns the Bezier parameter t at height h. If `spacing` is "paper", t is h. If `spacing` is "uniform", t
/// is 1 - sqrt(1 - h).
double bezier_parameter(double h, const std::string& spacing);

/// Returns the point at parameter t of a strand's quadratic Bezier curve, relative to the strand's root. The
/// control points of the curve are the root, p0 = root + a and p = root + b.
glm::dvec3 bezier(const glm::dvec3& a, const glm::dvec3& b, double t);

/// Returns the offset of a strand by its curl at height h (S Eq. 4). At this height, the radius of the curl
/// is (1 - rho) h times `radius`. `rho` is the wetness. `turns` is the number of turns from the root (h = 0)
/// to the tip (h = 1). u and v are the axes of the curl.
glm::dvec3 curl(double h, double rho, double radius, double turns, const glm::dvec3& u, const glm::dvec3& v);

/// The bend of a vertex, as two vectors. p0 and p are control points of a strand's Bezier curve. L0 is a
/// stick's length, n the surface normal and s the stick's direction.
struct Bend {
  /// For a strand, the vector from the root to p0. For a stick, the vector L0 n.
  glm::dvec3 a{0.0};
  /// For a strand, the vector from the root to the tip p. For a stick, the vector L0 s, or if
  /// dynamics.bend is "tangent", L0 times the sum of n and the tangential part of s.
  glm::dvec3 b{0.0};
};

/// Returns the bend of a stick (B Eq. 3). `top` is the vector from the stick's base to its top. The function
/// uses only the direction s of `top`. `length` is L0. `normal` is the unit surface normal n. If
/// dynamics.bend is "tangent", the component of s - n along n is removed.
Bend stick_bend(const DynamicsScene& dynamics, double length, const glm::dvec3& normal,
                const glm::dvec3& top);

/// Returns the displacement of a layer at height h, which is h a + h^k (b - a) (B Eq. 4). a and b are the
/// vectors of `bend`. The exponent k is dynamics.bend_power, or 1 if dynamics.bend is "linear".
glm::dvec3 stick_displacement(const DynamicsScene& dynamics, const Bend& bend, double h,
                              Mutant mutant = Mutant::none);

/// The positions of all layers at one time. The bend and the wetness are stored once per slot. If the
/// triangles of a layer share vertices, a slot is the index of a mesh vertex. If they do not share
/// vertices (parts() is true), a slot is the index 3 f + c of corner c of triangle f.
class Geometry {
 public:
  /// Computes the bend and the wetness of each slot after `frames` frames. `wanted` has one entry per face: 0
  /// if the caller does not need the face. If it is empty, the slots of all faces are computed. With a
  /// mass-spring topology, the bend comes from `sticks`, and no strands are simulated. Options::sticks
  /// describes the entries of `sticks`.
  Geometry(const FrameInput& input, const Mask& mask, int frames, const std::vector<char>& wanted = {},
           Mutant mutant = Mutant::none, const std::vector<glm::dvec3>& sticks = {});

  std::size_t slots() const { return bend_.size(); }
  bool wanted(std::size_t slot) const { return wanted_[slot] != 0; }
  std::size_t slot(std::size_t face, std::size_t corner) const;
  std::uint32_t vertex(std::size_t slot) const;  ///< index of the mesh vertex that belongs to a slot
  const Bend& bend(std::size_t slot) const { return bend_[slot]; }
  glm::dvec3 position(std::size_t slot, int n) const;  ///< position on layer n; n = -1: base surface
  /// Returns the offset by the curl on layer n. It is 0 for the base surface, n = -1.
  glm::dvec3 curl_offset(std::size_t slot, int n) const;
  /// The axes of the curl at a slot, times its radius and its dryness, in R.
  struct CurlAxes {
    glm::dvec3 u, v;
  };
  CurlAxes curl_axes(std::size_t slot) const;
  double turns_share(std::size_t slot) const;  ///< factor of curl.turns by its map; 1 without a map

 private:
  const FrameInput* input_;
  Mutant mutant_;
  bool separate_;
  std::vector<char> wanted_;
  std::vector<Bend> bend_;
  Colliders colliders_;      ///< at the time of the picture
  std::vector<double> rho_;  ///< for each slot, the wetness of the mask at its surface point
};

/// Returns the vector from the strand's point on layer `from` to its point on layer `to`, both without the
/// curl. -1 is the base surface.
glm::dvec3 rise(const FrameInput& input, const Bend& bend, int from, int to, Mutant mutant = Mutant::none);

/// Returns the vector from the strand's point on layer n - 1 to its point on layer n, both without the curl.
/// Shading uses the direction of this vector as the strand's tangent at layer n.
glm::dvec3 chord(const FrameInput& input, const Bend& bend, int n, Mutant mutant = Mutant::none);

/// Returns the displacement by the curl on layer `to` minus that on layer `from`, with curl.turns_map.
/// `share` is the factor of curl.turns before it is rounded to a multiple of 1 / turn_steps.
glm::dvec3 curl_change(const Scene& scene, double share, const Geometry::CurlAxes& axes, int from, int to);

}  // namespace pelage::reference
