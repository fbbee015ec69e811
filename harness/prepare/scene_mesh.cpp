#include "harness/prepare/scene_mesh.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/prepare/placed_strands.hpp"
#include "harness/scene/scene_keys.hpp"

namespace pelage {

glm::vec3 rotation_of(const MeshScene& mesh) {
  // If z is the model's upward axis, a rotation by -90 degrees about x turns z to y. The first rotation of
  // mesh.rotate is also about x, so the two angles are added. If the sum would leave the range from -360 to
  // 360 degrees, the code adds 270 degrees in place of -90 degrees.
  glm::vec3 angles = mesh.rotate;
  if (mesh.up == "z") angles.x -= angles.x - 90 < -360 && angles.x >= -360 ? -270.0f : 90.0f;
  return angles;
}

std::shared_ptr<const Mesh> load_scene_mesh(const Scene& scene,
                                            const std::function<void(const std::string&)>& progress) {
  MeshOptions options;
  options.rotate = rotation_of(scene.mesh);
  options.largest_only = scene.mesh.components == "largest";
  options.keep_uv = scene.fur.uv == "file";
  options.even_uv = scene.fur.uv == "even";
  options.progress = progress;
  std::optional<Polylines> strands;  // read first: the preparation of a mesh may take minutes
  if (scene.strands.groom == "file") strands = read_strands(scene);
  const auto mesh = scene.model == no_model ? nullptr : load_model(scene.model, options);
  if (strands) return with_strands(scene, std::move(*strands), mesh, progress);
  if (scene.mesh.frames == 1) return mesh;
  if (!is_model_file(scene.model))
    throw InputError(fmt::format("mesh.frames: the model {} is no mesh file; frames need one mesh file each",
                                 scene.model));
  auto moving = std::make_shared<Mesh>(*mesh);
  moving->frames =
      read_mesh_frames(*mesh, scene.model, scene.mesh.frames, glm::dvec3(rotation_of(scene.mesh)));
  Hash hash;
  hash.text(mesh->hash);
  for (const std::vector<glm::vec3>& frame : moving->frames) hash.values(frame);
  moving->hash = hash.hex();
  return moving;
}

std::shared_ptr<const Mesh> SceneMeshes::of(const Scene& scene,
                                            const std::function<void(const std::string&)>& progress) {
  const glm::vec3 turn = rotation_of(scene.mesh);
  std::shared_ptr<const Mesh>& mesh =
      kept_[{scene.model, scene.fur.uv, scene.mesh.components, scene.mesh.frames, turn.x, turn.y, turn.z,
             scene.strands.groom == "file" ? scene.strands.file_unit + scene.strands.file.string() : ""}];
  if (!mesh) mesh = load_scene_mesh(scene, progress);
  return mesh;
}

}  // namespace pelage
