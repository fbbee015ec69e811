// Fragments that sample the slab below their layer several times (docs/frame.md, section 6, "Sub-steps").
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/shells/reference/textures.hpp"

namespace pelage::reference {

/// Returns the offset, in R, from the root of the fragment's strand to the root of the strand that the ray
/// meets at the bottom of the slab. It is D - (D.nu)/e E, where e is E.nu moved to at least .25 away from 0.
/// `step` is D, the strand's step over the slab, in R. `normal` is nu and `eye` is E, both unit. If |E.nu| >=
/// .25, the offset is in the tangent plane.
glm::dvec3 root_shift(const glm::dvec3& step, const glm::dvec3& normal, const glm::dvec3& eye);

/// Returns the coordinates (u, v) of `delta` in the basis t = dX/du, b = dX/dv, by least squares if delta is
/// not in their plane. delta is in R, and t and b are in R per UV unit. Returns 0 if t or b is 0, or if they
/// are nearly parallel.
glm::dvec2 uv_shares(const glm::dvec3& delta, const glm::dvec3& t, const glm::dvec3& b);

/// Combines k >= 1 samples of a slab into one sample for its layer. The coverage is 1 - (prod (1 -
/// a_i))^(1/k). The shade is the mean weighted by coverage, or 0 if all coverages are 0.
FurSample combined(const std::vector<FurSample>& samples);

}  // namespace pelage::reference
