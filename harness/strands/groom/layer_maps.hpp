// The maps of a fur layer: pictures in UV space that vary the layer's values over the surface.
#pragma once
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/prepare/picture_map.hpp"
#include "harness/scene/strands_scene.hpp"
#include "harness/strands/groom/roots.hpp"

namespace pelage::strands {

/// All maps of a fur layer except the film strip.
struct LayerMaps {
  /// Reads the pictures of the layer. `name` is the layer's name in messages, for instance
  /// "strands.layer[1]".
  LayerMaps(const StrandLayerScene& layer, const std::string& name);

  /// Returns the layer's relative density of strands at a root, 0 to 1: the value of the density map divided
  /// by the map's largest value. It is 0 outside of the layer's region and of its mask, and where length or
  /// width are 0.
  double density(const Mesh& mesh, const Root& root) const;
  /// Returns for each triangle whether the density is 0 on the whole triangle. A triangle of density 0 may
  /// have the value false.
  std::vector<bool> bare(const Mesh& mesh) const;
  /// Throws InputError if the layer has no place for strands. The message names the scene key, and the
  /// picture if it is the reason.
  void require_place(const Mesh& mesh) const;

  StrandLayerScene layer;
  std::string name;
  LumaMap mask, density_map, length, width, stiffness, curvature, twist;
  std::optional<PictureMap> comb;

 private:
  double most_density_;

  /// A condition for strands at a point: the scene key that it comes from, and the picture if there is one.
  struct Condition {
    std::string key;
    std::filesystem::path file;
    std::function<double(const Mesh&, const Root&)> density;
    std::function<bool(const Mesh&, std::uint32_t face)> possible;
  };
  std::vector<Condition> conditions() const;
};

}  // namespace pelage::strands
