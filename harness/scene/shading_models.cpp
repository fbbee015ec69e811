#include "harness/scene/shading_models.hpp"

#include <fmt/format.h>

#include "harness/error.hpp"

namespace pelage {
namespace {

constexpr ShadingModel models[] = {
    {.name = "curling", .what = "S Eq. 6", .surface_light = false, .plain = false, .in_opengl = true},
    {.name = "wet", .what = "W Eq. 2-5", .surface_light = true, .plain = false, .in_opengl = true},
    {.name = "lambert",
     .what = "Lambert's law with self-shadow (Banisch and Wuethrich 2006)",
     .surface_light = true,
     .plain = true,
     .in_opengl = false},
};

}  // namespace

std::span<const ShadingModel> shading_models() {
  return models;
}

const ShadingModel& shading_model(const std::string& name) {
  std::string names;
  for (const ShadingModel& model : models) {
    if (model.name == name) return model;
    names += (names.empty() ? "" : ", ") + std::string(model.name);
  }
  throw InputError(fmt::format("shading.model '{}': unknown; give one of {}", name, names));
}

}  // namespace pelage
