#include "harness/prepare/picture_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/error.hpp"
#include "harness/picture/image_io.hpp"

namespace pelage {

PictureMap::PictureMap(const std::filesystem::path& path) : picture_(read_picture(path)) {
  for (const glm::vec4& p : picture_.pixel)
    if (!(std::isfinite(p.x + p.y + p.z) && p.x >= 0 && p.y >= 0 && p.z >= 0))
      throw InputError(
          fmt::format("{}: a pixel has a colour value that is negative, infinite or not a number; colour "
                      "values must be finite and at least 0",
                      path.string()));
}

glm::vec4 PictureMap::at(glm::dvec2 uv) const {
  const double px = std::clamp(uv.x * width() - 0.5, 0.0, width() - 1.0);
  const double py = std::clamp((1.0 - uv.y) * height() - 0.5, 0.0, height() - 1.0);
  const int x0 = int(px), y0 = int(py);
  const int x1 = std::min(x0 + 1, width() - 1), y1 = std::min(y0 + 1, height() - 1);
  const float u = float(px - x0), v = float(py - y0);
  return (1 - v) * ((1 - u) * picture_.at(x0, y0) + u * picture_.at(x1, y0)) +
         v * ((1 - u) * picture_.at(x0, y1) + u * picture_.at(x1, y1));
}

}  // namespace pelage
