#include "harness/strands/drawing/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"

namespace pelage::strands {
namespace {

constexpr double depth_steps = 1 << 24;

void in_range(const char* what, float value, float least, float most) {
  if (!(value >= least && value <= most))  // also true for NaN
    throw InputError(fmt::format("{}: {}; it must be from {} to {}", what, value, least, most));
}

}  // namespace

DepthRange depth_range(const Camera& camera, float radius) {
  const double centre = camera.row_w.w;  // view depth of the object's origin
  const double nearest = std::max(double(camera.near), centre - double(radius));
  const double furthest = std::max(centre + double(radius), nearest + 1e-3 * double(radius));
  return {float(nearest), float((depth_steps - 1) / (furthest - nearest))};
}

void check(const Look& look) {
  in_range("number of segments", float(look.segments), 1, 8);
  in_range("taper", look.taper, 0, 1);
  in_range("opacity", look.opacity, 0, 1);
  in_range("intensity of the key light", look.intensity, 0, 1000);
  in_range("ambient light", look.ambient, 0, 100);
  in_range("exponent of the highlight", look.exponent, 1, 10000);
  for (int axis = 0; axis < 3; ++axis) {
    in_range("specular colour", look.specular[axis], 0, 100);
    in_range("background", look.background[axis], 0, 1);
    in_range("direction of the key light", look.light[axis], -1e6f, 1e6f);
  }
  in_range("length of the direction of the key light", glm::length(look.light), 1e-6f, 1e7f);
}

}  // namespace pelage::strands
