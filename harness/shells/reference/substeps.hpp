// A fragment that looks several times into the slab below its layer (docs/frame.md, 6, "Sub-steps").
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/shells/reference/textures.hpp"

namespace pelage::reference {

/// How far off the root of the strand lies that the ray meets at the slab's bottom, R: D - (D.nu)/e E with e
/// = E.nu, kept at least .25 away from 0. `step` is D, the strand's step over the slab (R); `normal` nu and
/// `eye` E are unit. It lies in the tangent plane wherever |E.nu| >= .25, and is proportional to depth.
glm::dvec3 root_shift(const glm::dvec3& step, const glm::dvec3& normal, const glm::dvec3& eye);

/// The shares (u, v) of `delta` (R) in t = dX/du and b = dX/dv (R per UV unit), by least squares when it
/// sticks out of their plane; 0 where t and b are (nearly) parallel or 0.
glm::dvec2 uv_shares(const glm::dvec3& delta, const glm::dvec3& t, const glm::dvec3& b);

/// What k >= 1 looks into a slab amount to: k samples stand for one layer, so coverage is 1 - (prod (1 -
/// a_i))^(1/k); shade is the mean by coverage, 0 where nothing covers.
FurSample combined(const std::vector<FurSample>& samples);

}  // namespace pelage::reference
