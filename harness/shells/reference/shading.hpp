// The colour of a fragment: S Eq. 6 and W Eq. 2-5, with the lights of docs/frame.md.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "harness/scene/scene.hpp"

namespace pelage::reference {

/// What a fragment shows the light. Directions are unit vectors.
struct Fragment {
  glm::dvec3 colour;   ///< K, the coat's colour times the strand's shade
  glm::dvec3 tangent;  ///< T (curling model) or T_ws (wet model), along the strand
  glm::dvec3 normal;   ///< nu, of the surface
  glm::dvec3 view;     ///< E, from the eye to the surface
  double height = 0;   ///< h, 0 on the skin
  double wetness = 0;  ///< rho
};

/// The normal that light reaches: with `shading.sides` "two" a normal that faces away from the eye is reversed.
/// `view` points from the eye to the surface.
glm::dvec3 lit_normal(const ShadingScene& shading, const glm::dvec3& normal, const glm::dvec3& view);

/// S Eq. 6 with gamma = (K_shadow - 1 + h) / K_shadow.
glm::dvec3 curling_colour(const ShadingScene& shading, const Fragment& fragment);

/// W Eq. 2, 3 and 5.
glm::dvec3 wet_colour(const ShadingScene& shading, const Fragment& fragment);

/// The light of B, section 3: Lambert's law per pixel, darkened towards the skin down to 1 - sigma_occ there.
glm::dvec3 plain_colour(const ShadingScene& shading, const Fragment& fragment);

/// The base surface under any model: the wet model's diffuse term, darkened as the model darkens h = 0.
glm::dvec3 skin_colour(const ShadingScene& shading, const Fragment& fragment);

/// W Eq. 4, the strand's direction in space: `bend` is the strand's own step over the layer in R, t and b are
/// dX/du and dX/dv, delta_d the clump's step in UV. Unit.
glm::dvec3 wet_tangent(const ShadingScene& shading, const glm::dvec3& bend, const glm::dvec3& t,
                       const glm::dvec3& b, const glm::dvec2& delta_d);

}  // namespace pelage::reference
