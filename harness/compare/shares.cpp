#include "harness/compare/shares.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace pelage {

double model_height(const Picture& picture) {
  int rows = 0;
  for (int y = 0; y < picture.height; ++y) {
    const auto row = picture.pixel.begin() + std::ptrdiff_t(y) * picture.width;
    rows += std::any_of(row, row + picture.width, [](const glm::vec4& p) { return p.w > 0; });
  }
  return double(rows) / std::max(1, picture.height);
}

double wet_share(const Mesh& mesh, const std::vector<glm::vec4>& mask, int side) {
  double wet = 0, all = 0;
  auto texel = [side](float u) {
    // nearest sampling (docs/shells.md, section 2)
    return std::min(side - 1, int((u - std::floor(u)) * float(side)));
  };
  for (const glm::uvec3& t : mesh.triangle) {
    const glm::vec3 a = mesh.position[t.x], b = mesh.position[t.y], c = mesh.position[t.z];
    const double area = glm::length(glm::cross(b - a, c - a));
    const glm::vec2 uv = (mesh.uv[t.x] + mesh.uv[t.y] + mesh.uv[t.z]) / 3.0f;
    all += area;
    if (mask[std::size_t(texel(uv.y)) * std::size_t(side) + std::size_t(texel(uv.x))].w > 0) wet += area;
  }
  return all > 0 ? wet / all : 0;
}

}  // namespace pelage
