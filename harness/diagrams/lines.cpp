#include "harness/diagrams/lines.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace pelage::diagrams {

void draw_line(Picture& picture, glm::dvec2 a, glm::dvec2 b, double width, const glm::vec4& colour,
               const Visible& visible) {
  const glm::dvec2 d = b - a;
  const double square = glm::dot(d, d), reach = 0.5 * width + 0.5;
  const auto first = [&](double p, double q) { return std::max(0, int(std::floor(std::min(p, q) - reach))); };
  const auto last = [&](double p, double q, int side) {
    return std::min(side - 1, int(std::ceil(std::max(p, q) + reach)));
  };
  for (int y = first(a.y, b.y); y <= last(a.y, b.y, picture.height); ++y)
    for (int x = first(a.x, b.x); x <= last(a.x, b.x, picture.width); ++x) {
      const glm::dvec2 centre(x + 0.5, y + 0.5);
      const double along = square > 0 ? std::clamp(glm::dot(centre - a, d) / square, 0.0, 1.0) : 0.0;
      const double cover = std::clamp(reach - glm::distance(centre, a + along * d), 0.0, 1.0);
      if (!(cover > 0) || (visible && !visible(x, y, along))) continue;
      const float opacity = float(cover) * colour.a;
      glm::vec4& pixel = picture.at(x, y);
      pixel = glm::mix(pixel, glm::vec4(glm::vec3(colour), 1), opacity);
    }
}

}  // namespace pelage::diagrams
