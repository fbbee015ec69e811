#include "harness/strands/drawing/skin_surface.hpp"

#include "harness/prepare/coat.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage::strands {

SkinSurface skin_surface(const Mesh& mesh, const CoatTexture& coat, glm::vec3 factor) {
  const Skin skin = weld(mesh);
  SkinSurface surface{mesh.position, {}, {}, mesh.triangle};
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    surface.normal.emplace_back(skin.normal[mesh.weld[v]]);
    surface.colour.emplace_back(coat_colour(coat, glm::dvec2(mesh.uv[v])) * glm::dvec3(factor));
  }
  return surface;
}

}  // namespace pelage::strands
