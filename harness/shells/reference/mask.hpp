// The wetness mask (S and W, Algorithm 1) and what a fragment does with it (S Eq. 5, Algorithm 2).
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/reference/reference.hpp"

namespace pelage::reference {

/// What a texel holds: the clump's centre and radius in UV units and its wetness, 0 where dry.
struct Clump {
  glm::dvec2 centre{0.0};
  double radius = 0.0;
  double wetness = 0.0;
  bool operator==(const Clump&) const = default;
};

/// Algorithm 1 for a texel that lies in the droplet's disc.
Clump blend(const Clump& texel, const Droplet& droplet);

struct Mask {
  int size = 0;
  std::vector<Clump> texel;  ///< size x size, row j at v = (j + .5) / size
  /// The texel under uv, repeating.
  const Clump& nearest(const glm::dvec2& uv) const;
  /// Interpolated, repeating: only Mutant::mask_bilinear looks this way.
  Clump bilinear(const glm::dvec2& uv) const;
};

Mask wetness_mask(const FrameInput& input, Mutant mutant = Mutant::none);

/// S Eq. 5's factor (1 - w) h + w (1 + ln h / ln N), in [0, 1] for h in [1/N, 1].
double clump_shape(double h, double w, int layers, Mutant mutant = Mutant::none);

/// What Algorithm 2 makes of a fragment of layer n at `uv`.
struct Displacement {
  bool discarded = false;
  glm::dvec2 d{0.0};        ///< added to the texture coordinates, UV
  glm::dvec2 delta_d{0.0};  ///< W Eq. 4: d(h_n) - d(h_(n-1)), with d = 0 below the first layer
  double wetness = 0.0;     ///< rho at uv
};
Displacement clump_displacement(const FrameInput& input, const Mask& mask, const glm::dvec2& uv, int n,
                                Mutant mutant = Mutant::none);

}  // namespace pelage::reference
