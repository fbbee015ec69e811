// Texture lookups in the fur and the coat, and the combination of several lookups of a fragment in the slab
// between its layer and the layer below (docs/shells.md, section 6). Texel (i, j) of a texture of side S
// has its centre at ((i + .5) / S, (j + .5) / S). Textures repeat.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

struct FurSample {
  double coverage;  ///< 0..1
  double shade;     ///< factor on the coat's colour, 0..2
};

/// Samples slice `layer` of the fur at `uv`. The texture has the period 1 in u and v. Filtering is bilinear
/// within a mip level, and linear between the two mip levels around `level`. `level` is clamped to the
/// existing mip levels. The coverage c becomes 1 - (1 - c)^power.
FurSample sample_fur(const FurTexture& fur, const glm::dvec2& uv, int layer, double level, double power);

/// Returns the value of a map at uv by bilinear filtering between pixel centres. Outside the unit square, the
/// value is that of the nearest point of the square. Returns 1 if there is no map.
double sample_density(const Style::Density& map, const glm::dvec2& uv);

/// Returns the coat's colour at uv by bilinear filtering. Channels are 0..1.
glm::dvec3 sample_coat(const CoatTexture& coat, const glm::dvec2& uv);

/// The view ray meets one strand at the top of the slab and another strand at the bottom. Returns the offset
/// from the root of the first strand to the root of the second strand, in R (the radius of the mesh's
/// bounding sphere). `step` is the vector along a strand from the bottom of the slab to its top, in R.
/// `normal` is the unit normal nu of the surface, and `eye` is the unit direction E of the ray. The offset is
/// step - ((step.nu) / e) * E. Here e is E.nu with a magnitude of at least .25: min(E.nu, -.25) if E.nu < 0,
/// else max(E.nu, .25). If |E.nu| >= .25, the offset is in the tangent plane.
glm::dvec3 root_shift(const glm::dvec3& step, const glm::dvec3& normal, const glm::dvec3& eye);

/// Returns the coordinates (u, v) of `delta` in the basis of the surface tangents t = dX/du and b = dX/dv. If
/// `delta` is not in the plane of t and b, the result is the least-squares solution. `delta` is in R, and t
/// and b are in R per UV unit. Returns 0 if t or b is 0, or if t and b are nearly parallel.
glm::dvec2 uv_shares(const glm::dvec3& delta, const glm::dvec3& t, const glm::dvec3& b);

/// Combines the k >= 1 samples of a fragment into one sample. Let a_i be the coverages of the samples. The
/// coverage of the result is 1 - (product of (1 - a_i))^(1/k). The shade of the result is the mean of the
/// samples' shades, weighted by a_i, or 0 if all a_i are 0.
FurSample combined(const std::vector<FurSample>& samples);

}  // namespace pelage::reference
