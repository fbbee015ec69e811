#include "harness/strands/drawing/light_view.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace pelage::strands {

LightView light_view(const Look& look) {
  constexpr int margin = 2;  // texels
  const glm::dvec3 forward = -glm::normalize(glm::dvec3(look.light));
  const glm::dvec3 up = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, up)), down = glm::cross(forward, right);
  const double texel = 2 * double(look.shadow.radius) / (look.shadow.size - 2 * margin);
  LightView view;
  view.row_x = glm::vec4(glm::dvec4(right / texel, 0));
  view.row_y = glm::vec4(glm::dvec4(down / texel, 0));
  view.row_z = glm::vec4(glm::dvec4(forward, 0));
  view.texel = float(texel);
  view.size = look.shadow.size;
  return view;
}

}  // namespace pelage::strands
