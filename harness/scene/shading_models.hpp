// The models of shading, as the properties that tell them apart.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace pelage {

/// Code asks for a property, never for a name. To add a model: a row in shading_models.cpp; its colour in
/// kernels/rasterize/shading/fragment.clh and harness/shells/reference/shading.cpp.
struct ShadingModel {
  std::string_view name;  ///< as users write it
  std::string_view what;  ///< its source
  /// Diffuse light and shadow are the surface's (W Eq. 2 to 5); false: the strand's (S Eq. 6).
  bool surface_light;
  /// Of the surface's light only Lambert's law and the self-shadow: no highlight, no wrapped light, no wet
  /// darkening.
  bool plain;
};

std::span<const ShadingModel> shading_models();

/// The model of that name. Throws InputError naming those there are.
const ShadingModel& shading_model(const std::string& name);

}  // namespace pelage
