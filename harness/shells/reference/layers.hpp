// Where the shells are (S Eq. 1 and 4, the strand's Bezier curve; B Eq. 3 and 4).
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/strands.hpp"

namespace pelage::reference {

/// h_n = (1 + n) / N; 0 for the base surface (n = -1).
double layer_height(int n, int layers, Mutant mutant = Mutant::none);

/// The Bezier parameter t of height h: h itself ("paper") or 1 - sqrt(1 - h) ("uniform").
double bezier_parameter(double h, const std::string& spacing);

/// The quadratic Bezier curve through root, p0 and p at t, relative to the root; a = p0 - root, b = p - root.
glm::dvec3 bezier(const glm::dvec3& a, const glm::dvec3& b, double t);

/// S Eq. 4 with alpha(h) = (1 - rho) K_alpha h; `radius` is K_alpha in R, `turns` omega / 2 pi.
glm::dvec3 curl(double h, double rho, double radius, double turns, const glm::dvec3& u, const glm::dvec3& v);

/// What displaces a vertex: the control points of its Bezier curve, or its stick.
struct Bend {
  glm::dvec3 a{0.0};  ///< p0 - root, R; with a stick L0 n
  glm::dvec3 b{0.0};  ///< p - root, R; with a stick L0 s
};

/// B Eq. 3: the stick whose top lies at `top` from its base, as if it were straight and L0 = `length` long.
/// normal: unit. With the "tangent" form what sets it apart from L0 n is freed of its part along n.
Bend stick_bend(const DynamicsScene& dynamics, double length, const glm::dvec3& normal,
                const glm::dvec3& top);

/// B Eq. 4: a layer rises by h L0 along n and is moved by h^k L0 (s - n); with "linear" k = 1.
glm::dvec3 stick_displacement(const DynamicsScene& dynamics, const Bend& bend, double h,
                              Mutant mutant = Mutant::none);

/// The shells of a moment. A slot is what is displaced once: a vertex copy, or a corner of a triangle where
/// layers part.
class Geometry {
 public:
  /// Bends and curls every slot of the faces where `wanted` is not 0 (F; empty: all of them) after `frames`
  /// frames; with a topology by `sticks`, as Options has them.
  Geometry(const FrameInput& input, const Mask& mask, int frames, const std::vector<char>& wanted = {},
           Mutant mutant = Mutant::none, const std::vector<glm::dvec3>& sticks = {});

  std::size_t slots() const { return bend_.size(); }
  bool wanted(std::size_t slot) const { return wanted_[slot] != 0; }
  std::size_t slot(std::size_t face, std::size_t corner) const;
  std::uint32_t vertex(std::size_t slot) const;  ///< the vertex copy of the slot
  const Bend& bend(std::size_t slot) const { return bend_[slot]; }
  glm::dvec3 position(std::size_t slot, int n) const;  ///< R; n = -1: the base surface
  /// S Eq. 4 at the slot on layer n, R; 0 for the base surface.
  glm::dvec3 curl_offset(std::size_t slot, int n) const;

 private:
  const FrameInput* input_;
  Mutant mutant_;
  bool separate_;
  std::vector<char> wanted_;
  std::vector<Bend> bend_;
  std::vector<double> rho_;  ///< the mask's wetness at the slot's surface point
};

/// The strand's direction at layer n by the chord from the layer below: B(t_n) - B(t_(n-1)), not normalized.
glm::dvec3 chord(const FrameInput& input, const Bend& bend, int n, Mutant mutant = Mutant::none);

/// The corners of every triangle of layer n (-1: the base), 3 F.
std::vector<glm::dvec3> layer_positions(const FrameInput& input, const Geometry& geometry, int n);

}  // namespace pelage::reference
