// The lighting models and their properties.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace pelage {

/// Other code tests the properties of a shading model and never compares names. To add a model, add a row to
/// shading_models.cpp, and add the computation of the colour to kernels/rasterize/shading/fragment.clh and
/// harness/shells/reference/shading.cpp.
struct ShadingModel {
  std::string_view name;  ///< value of the scene key shading.model
  std::string_view what;  ///< equations of the model
  /// True: diffuse light and shadow use the surface normal (W Eq. 2 to 5). False: they use the strand's
  /// tangent (S Eq. 6).
  bool surface_light;
  /// True: the model consists of Lambert's law and the self-shadow; it has no highlight, no wrapped light and
  /// no wet darkening.
  bool plain;
};

std::span<const ShadingModel> shading_models();

/// Returns the model called `name`. Throws InputError with all names if no model has this name.
const ShadingModel& shading_model(const std::string& name);

}  // namespace pelage
