#include "harness/mesh/procedural.hpp"

#include <cmath>
#include <numbers>

namespace pelage {

Surface make_torus(int around, int across, double minor_radius) {
  Surface surface;
  surface.periodic_uv = true;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      const double reach = 1 + minor_radius * std::cos(b);
      surface.point.push_back({reach * std::cos(a), minor_radius * std::sin(b), -reach * std::sin(a)});
    }
  }
  const auto point = [&](int i, int j) { return std::uint32_t((i % around) * across + j % across); };
  const auto uv = [&](int i, int j) { return glm::dvec2(double(i) / around, double(j) / across); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      surface.triangle.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
      surface.uv.push_back({uv(i, j), uv(i + 1, j), uv(i + 1, j + 1)});
      surface.triangle.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
      surface.uv.push_back({uv(i, j), uv(i + 1, j + 1), uv(i, j + 1)});
    }
  }
  return surface;
}

Surface make_square(int quads) {
  Surface surface;
  const auto add = [&](double u, double v) { surface.point.push_back({u, 0, -v}); };
  for (int j = 0; j <= quads; ++j)
    for (int i = 0; i <= quads; ++i) add(double(i) / quads, double(j) / quads);
  for (int j = 0; j < quads; ++j)
    for (int i = 0; i < quads; ++i) add((i + 0.5) / quads, (j + 0.5) / quads);
  const auto uv = [&](std::uint32_t p) { return glm::dvec2(surface.point[p].x, -surface.point[p].z); };
  for (int j = 0; j < quads; ++j) {
    for (int i = 0; i < quads; ++i) {
      const auto corner = [&](int x, int y) { return std::uint32_t(y * (quads + 1) + x); };
      const std::uint32_t ring[] = {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
      const auto centre = std::uint32_t((quads + 1) * (quads + 1) + j * quads + i);
      for (int k = 0; k < 4; ++k) {
        const std::uint32_t a = ring[k], b = ring[(k + 1) % 4];
        surface.triangle.push_back({a, b, centre});
        surface.uv.push_back({uv(a), uv(b), uv(centre)});
      }
    }
  }
  return surface;
}

}  // namespace pelage
