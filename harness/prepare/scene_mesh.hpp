// The mesh that a scene's keys mean.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "harness/mesh/mesh.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// Prepares the model of `scene` as its mesh keys say; `progress` is told what takes long. Throws InputError,
/// see load_model().
std::shared_ptr<const Mesh> load_scene_mesh(const Scene& scene,
                                            const std::function<void(const std::string&)>& progress);

/// Keeps the meshes of scenes in memory, one per different set of mesh keys.
class SceneMeshes {
 public:
  std::shared_ptr<const Mesh> of(const Scene& scene, const std::function<void(const std::string&)>& progress);

 private:
  using Key = std::tuple<std::string, std::string, std::string, float, float, float>;
  std::map<Key, std::shared_ptr<const Mesh>> kept_;
};

}  // namespace pelage
