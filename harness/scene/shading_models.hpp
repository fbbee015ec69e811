// The lighting models and their properties (docs/shells.md).
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace pelage {

/// A lighting model. Other code tests the properties below and never compares the names of models.
/// docs/code.md lists what to change to add a model.
struct ShadingModel {
  std::string_view name;  ///< value of the scene key shading.model
  std::string_view what;  ///< equations of the model
  /// True: diffuse light and shadow use the surface normal (W Eq. 2 to 5). False: diffuse light and shadow
  /// use the strand's tangent (S Eq. 6).
  bool surface_light;
  /// True: the model consists of Lambert's law and the self-shadow; it has no highlight, no wrapped light and
  /// no wet darkening.
  bool plain;
  bool in_opengl;  ///< true: the OpenGL baseline can draw this model
};

std::span<const ShadingModel> shading_models();

/// Returns the model called `name`. Throws InputError with a list of the valid names if no
/// model has this name.
const ShadingModel& shading_model(const std::string& name);

}  // namespace pelage
