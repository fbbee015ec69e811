#include "harness/shells/reference/shading.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/scene/shading_models.hpp"
#include "harness/shells/reference/vector.hpp"

namespace pelage::reference {
namespace {

/// Returns max(0, (n.l + .4) / 1.4), which is above 0 also on surfaces that face slightly away from the
/// light.
double wrapped(const glm::dvec3& normal, const glm::dvec3& light) {
  return std::max(0.0, (glm::dot(normal, light) + 0.4) / 1.4);
}

/// Returns I_l, the intensity with which a light arrives at the fragment.
double arriving(const ShadingScene& shading, const LightScene& light, const Fragment& f) {
  return double(light.intensity) * (&light == &shading.lights.front() ? f.through : 1.0);
}

/// Returns g_l (docs/shells.md, section 6), the light's intensity times a factor that decreases with the
/// angle between the normal and the light. The factor is 1 if shading.wrap is 0.
double intensity(const ShadingScene& shading, const LightScene& light, const Fragment& f,
                 const glm::dvec3& towards) {
  return arriving(shading, light, f) * (1.0 + double(shading.wrap) * (wrapped(f.normal, towards) - 1.0));
}

/// Returns [(T.L)(T.E) + sin(T,L) sin(T,E)]^p with the base clamped at 0. This is Kajiya and Kay's highlight,
/// which both papers of Silva et al. 2010 use.
double highlight(const glm::dvec3& t, const glm::dvec3& l, const glm::dvec3& e, double p) {
  const double base =
      glm::dot(t, l) * glm::dot(t, e) + glm::length(glm::cross(t, l)) * glm::length(glm::cross(t, e));
  return std::pow(std::max(0.0, base), p);
}

/// Returns the diffuse term C_d of Eq. 2 of W.
glm::dvec3 lambert(const ShadingScene& shading, const Fragment& f) {
  double sum = double(shading.ambient);
  const double wrap = double(shading.wrap);
  for (const LightScene& light : shading.lights) {
    const glm::dvec3 towards = unit(glm::dvec3(light.direction));
    sum += arriving(shading, light, f) *
           ((1.0 - wrap) * std::max(0.0, glm::dot(towards, f.normal)) + wrap * wrapped(f.normal, towards));
  }
  return sum * f.colour;
}

double curling_shadow(const ShadingScene& shading, double h) {
  if (shading.self_shadow != "darkening") return 1.0;
  return (double(shading.shadow) - 1.0 + h) / double(shading.shadow);
}

/// Returns the product of the self-shadow factor gamma_occ and the wet-darkening factor gamma_wet (Eq. 5 of
/// W).
double wet_shadow(const ShadingScene& shading, double h, double rho) {
  const double occlusion = shading.self_shadow == "darkening" ? double(shading.occlusion) : 0.0;
  return (1.0 + occlusion * (h - 1.0)) * (1.0 - double(shading.darkening) * rho);
}

}  // namespace

bool shows_back(const ShadingScene& shading, const glm::dvec3& normal, const glm::dvec3& view) {
  return shading.sides == "two" && glm::dot(normal, view) > 0.0;
}

glm::dvec3 lit_normal(const ShadingScene& shading, const glm::dvec3& normal, const glm::dvec3& view) {
  return shows_back(shading, normal, view) ? -normal : normal;
}

glm::dvec3 curling_colour(const ShadingScene& shading, const Fragment& f) {
  double diffuse = double(shading.ambient), specular = 0.0;
  for (const LightScene& light : shading.lights) {
    const glm::dvec3 towards = unit(glm::dvec3(light.direction));
    const double g = intensity(shading, light, f, towards);
    diffuse += g * glm::length(glm::cross(f.tangent, towards));
    specular += g * highlight(f.tangent, towards, f.view, double(shading.exponent));
  }
  return curling_shadow(shading, f.height) * (diffuse * f.colour + specular * glm::dvec3(shading.specular));
}

glm::dvec3 wet_colour(const ShadingScene& shading, const Fragment& f) {
  const double exponent = (1.0 + double(shading.wet_specular) * (f.wetness - 1.0)) * double(shading.exponent);
  const glm::dvec3 mirrored = f.view - 2.0 * glm::dot(f.view, f.normal) * f.normal;
  double specular = 0.0;
  for (const LightScene& light : shading.lights) {
    const glm::dvec3 towards = unit(glm::dvec3(light.direction));
    const double film =
        f.gloss * std::pow(std::max(0.0, glm::dot(mirrored, towards)), double(shading.exponent));
    specular += intensity(shading, light, f, towards) *
                ((1.0 - f.film) * highlight(f.tangent, towards, f.view, exponent) + f.film * film);
  }
  const double wetness = (1.0 - f.film) * f.wetness + f.film * f.film_wetness;
  return wet_shadow(shading, f.height, wetness) *
         (lambert(shading, f) + specular * glm::dvec3(shading.specular));
}

glm::dvec3 plain_colour(const ShadingScene& shading, const Fragment& f) {
  double light = double(shading.ambient);
  for (const LightScene& lamp : shading.lights)
    light += arriving(shading, lamp, f) * std::max(0.0, glm::dot(f.normal, unit(glm::dvec3(lamp.direction))));
  const double darkest = shading.self_shadow == "darkening" ? 1.0 - double(shading.occlusion) : 1.0;
  return (darkest + (1.0 - darkest) * f.height) * light * f.colour;
}

glm::dvec3 fur_colour(const ShadingScene& shading, const Fragment& f) {
  const ShadingModel& model = shading_model(shading.model);
  if (model.plain) return plain_colour(shading, f);
  return model.surface_light ? wet_colour(shading, f) : curling_colour(shading, f);
}

glm::dvec3 skin_colour(const ShadingScene& shading, const Fragment& f) {
  const ShadingModel& model = shading_model(shading.model);
  if (model.plain) return plain_colour(shading, f);
  const double shadow =
      model.surface_light ? wet_shadow(shading, f.height, f.wetness) : curling_shadow(shading, f.height);
  return shadow * lambert(shading, f);
}

glm::dvec3 wet_tangent(const Scene& scene, const glm::dvec3& bend, const glm::dvec3& t, const glm::dvec3& b,
                       const glm::dvec3& normal, const Displacement& clump) {
  const std::string& reading = scene.shading.tangent;
  const auto on_surface = [&](const glm::dvec2& shift) { return shift.x * t + shift.y * b; };
  if (reading == "strand") return unit(on_surface(clump.moved) + bend);
  if (reading == "drawn") return unit(on_surface(-clump.delta_d) + bend);
  if (reading == "printed")
    return unit(clump.delta_d.x * unit(t) + clump.delta_d.y * unit(b) + normal / double(scene.fur.layers));
  return unit(on_surface(clump.delta_d) + bend);
}

glm::dvec3 strand_direction(const Scene& scene, const glm::dvec3& bend, const glm::dvec3& t,
                            const glm::dvec3& b, const glm::dvec3& normal, const Displacement& clump) {
  const ShadingModel& model = shading_model(scene.shading.model);
  return model.surface_light && !model.plain ? wet_tangent(scene, bend, t, b, normal, clump) : unit(bend);
}

}  // namespace pelage::reference
