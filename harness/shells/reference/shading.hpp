// The colour of a fragment (docs/shells.md, section 6). Lengths are in R.
#pragma once
#include <glm/vec3.hpp>

#include "harness/scene/scene.hpp"
#include "harness/shells/reference/mask.hpp"

namespace pelage::reference {

/// The inputs of the shading models. Directions are unit vectors.
struct Fragment {
  glm::dvec3 colour;   ///< K, the coat's colour times the strand's shade
  glm::dvec3 tangent;  ///< direction of the strand: T in S (model "curling"), T_ws in W (model "wet")
  glm::dvec3 normal;   ///< nu, the surface normal
  glm::dvec3 view;     ///< E, the direction from the eye to the surface
  double height = 0;   ///< h, the layer's height; for the base surface 0, or 1 if shows_back() is true
  double wetness = 0;  ///< rho
  double film = 0;     ///< F, the part that shows the film of soaked fur
  double film_wetness = 0;
  double gloss = 0;    ///< soaked.gloss
  double through = 1;  ///< the part of the first light that reaches the fragment (light_through())
};

/// Returns true if the fragment shows the back of the surface and the back is lit like the front. This is the
/// case if shading.sides is "two" and `normal` faces away from the eye. `view` points from the eye to the
/// surface.
bool shows_back(const ShadingScene& shading, const glm::dvec3& normal, const glm::dvec3& view);

/// Returns the normal to use in the lighting formulas. If shading.sides is "two" and `normal` faces away from
/// the eye, it returns -normal, else `normal`. `view` points from the eye to the surface.
glm::dvec3 lit_normal(const ShadingScene& shading, const glm::dvec3& normal, const glm::dvec3& view);

/// Returns the fragment's colour, computed by S Eq. 6. The shadow factor of Eq. 6 is gamma = (K_shadow - 1 +
/// h) / K_shadow, where K_shadow is shading.shadow and h is fragment.height.
glm::dvec3 curling_colour(const ShadingScene& shading, const Fragment& fragment);

/// Returns the fragment's colour, computed by W Eq. 2, 3 and 5.
glm::dvec3 wet_colour(const ShadingScene& shading, const Fragment& fragment);

/// Returns the fragment's colour by the model of B, section 3. The colour is the result of Lambert's law,
/// multiplied by a factor. The factor increases linearly from 1 - shading.occlusion at the base surface to 1
/// at the tips.
glm::dvec3 plain_colour(const ShadingScene& shading, const Fragment& fragment);

/// Returns the colour of a fragment of a layer, computed by the shading model shading.model.
glm::dvec3 fur_colour(const ShadingScene& shading, const Fragment& fragment);

/// Returns the colour of the base surface (docs/shells.md, section 7). The models "curling" and "wet" both
/// use the diffuse term of W Eq. 2. Each of the two models multiplies this term by its own shadow factor at
/// fragment.height. The model "lambert" uses plain_colour().
glm::dvec3 skin_colour(const ShadingScene& shading, const Fragment& fragment);

/// Returns the unit direction T_ws of the strand in object space (W Eq. 4). `bend` is the vector from the
/// strand's point on the layer below to the strand's point on the fragment's layer, in R. `t` and `b` are the
/// surface tangents dX/du and dX/dv, in R per unit of UV. `normal` is the unit normal of the surface.
glm::dvec3 wet_tangent(const Scene& scene, const glm::dvec3& bend, const glm::dvec3& t, const glm::dvec3& b,
                       const glm::dvec3& normal, const Displacement& clump);

/// Returns the unit direction of the strand in object space, at a fragment of a layer. For the model "wet" it
/// returns wet_tangent(). For all other models it returns the direction of `bend`. The arguments are those of
/// wet_tangent().
glm::dvec3 strand_direction(const Scene& scene, const glm::dvec3& bend, const glm::dvec3& t,
                            const glm::dvec3& b, const glm::dvec3& normal, const Displacement& clump);

}  // namespace pelage::reference
