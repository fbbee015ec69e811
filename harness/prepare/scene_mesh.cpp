#include "harness/prepare/scene_mesh.hpp"

namespace pelage {

std::shared_ptr<const Mesh> load_scene_mesh(const Scene& scene,
                                            const std::function<void(const std::string&)>& progress) {
  MeshOptions options;
  options.rotate = scene.mesh.rotate;
  options.largest_only = scene.mesh.components == "largest";
  options.keep_uv = scene.fur.uv == "file";
  options.progress = progress;
  return load_model(scene.model, options);
}

std::shared_ptr<const Mesh> SceneMeshes::of(const Scene& scene,
                                            const std::function<void(const std::string&)>& progress) {
  const glm::vec3 turn = scene.mesh.rotate;
  std::shared_ptr<const Mesh>& mesh =
      kept_[{scene.model, scene.fur.uv, scene.mesh.components, turn.x, turn.y, turn.z}];
  if (!mesh) mesh = load_scene_mesh(scene, progress);
  return mesh;
}

}  // namespace pelage
