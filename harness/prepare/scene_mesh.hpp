// Loads the model of a scene, with the scene's mesh options.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "harness/mesh/mesh.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// Returns the combined rotation of mesh.up and mesh.rotate: angles in degrees about x, then y, then z. If
/// the angles of mesh.rotate are between -360 and 360 degrees, the returned angles are also in this range.
glm::vec3 rotation_of(const MeshScene& mesh);

/// Loads the model of `scene` with the scene's mesh options. `progress` receives messages if the preparation
/// of the mesh takes long. Throws InputError like load_model().
std::shared_ptr<const Mesh> load_scene_mesh(const Scene& scene,
                                            const std::function<void(const std::string&)>& progress);

/// A cache in memory with one mesh per combination of model and mesh options.
class SceneMeshes {
 public:
  std::shared_ptr<const Mesh> of(const Scene& scene, const std::function<void(const std::string&)>& progress);

 private:
  using Key = std::tuple<std::string, std::string, std::string, int, float, float, float, std::string>;
  std::map<Key, std::shared_ptr<const Mesh>> kept_;
};

}  // namespace pelage
