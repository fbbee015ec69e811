#include "harness/prepare/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <future>

#include "harness/error.hpp"
#include "harness/prepare/coat.hpp"
#include "harness/prepare/droplets.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/prepare/skin.hpp"
#include "harness/prepare/strands.hpp"

namespace pelage {
namespace {

/// Returns the numbers of repeats of the fur texture per unit of u and of v. On a periodic UV map the numbers
/// are rounded to integers, so that the fur has no seam.
glm::vec2 fur_scale(const Mesh& mesh, const FurScene& fur) {
  const glm::vec2 scale = fur.tile * mesh.length_per_uv;
  if (!mesh.periodic_uv) return scale;
  return {std::max(1.0f, std::round(scale.x)), std::max(1.0f, std::round(scale.y))};
}

std::vector<glm::vec3> points_of(const FrameInput& input, const Mesh& mesh, const Skin& skin) {
  const Scene& scene = input.scene;
  auto points = has_springs(scene.dynamics) ? rest_tips(skin, input.stick_normal, scene.fur.length)
                                            : rest_tips(skin, input.strands);
  points.insert(points.end(), mesh.position.begin(), mesh.position.end());
  for (const std::vector<glm::vec3>& frame : mesh.frames)
    points.insert(points.end(), frame.begin(), frame.end());
  return points;
}

Camera camera_of(const Scene& scene, const Style& style, std::span<const glm::vec3> points) {
  const float margin = scene.mesh.frames > 1 ? scene.fur.length : 0;
  return make_camera(scene.camera, scene.image, points, margin + most_curl_radius(scene.curl, style));
}

/// Returns the keys that the fur texture depends on. Hairs are widened for the longest strands.
FurScene of_texture(FurScene fur, const Style& style) {
  if (!style.length.empty()) fur.length *= *std::max_element(style.length.begin(), style.length.end());
  fur.density = FurScene{}.density;
  fur.length_map = fur.density_map = fur.comb_map = std::filesystem::path();
  return fur;
}

/// Throws InputError if layers cannot follow the frames of the mesh.
void check_frames(const Scene& scene, Deforming deforming) {
  if (deforming == Deforming::refused)
    throw InputError("mesh.frames: this command or pipeline needs a mesh that does not deform; give 1");
  if (!has_springs(scene.dynamics))
    throw InputError(
        "mesh.frames: layers follow the frames of a mesh on sticks only; give dynamics.topology = \"sticks\" or another mass-spring topology, or a pipeline that draws strands");
  const MotionScene still, &m = scene.dynamics.motion;
  if (m.velocity != still.velocity || m.shake != still.shake || m.spin != still.spin ||
      m.swing != still.swing)
    throw InputError(
        "dynamics.motion: the frames of the mesh (mesh.frames) contain the motion, so the object must not move; leave out dynamics.motion");
}

}  // namespace

std::vector<glm::vec3> framed_points(const FrameInput& input) {
  return points_of(input, *input.mesh, weld(*input.mesh));
}

std::shared_ptr<const FrameInput> with_view(const FrameInput& input, const Scene& scene,
                                            std::span<const glm::vec3> points) {
  auto changed = std::make_shared<FrameInput>(input);
  changed->scene = scene;
  changed->camera = camera_of(scene, input.style, points);
  return changed;
}

std::shared_ptr<const FrameInput> prepare(const Scene& scene, std::shared_ptr<const Mesh> mesh,
                                          Deforming deforming) {
  if (!mesh || mesh->triangle.empty())
    throw InputError("mesh: no triangles; give a mesh with at least one triangle");
  if (has_chains(scene.dynamics))
    throw InputError(
        "dynamics.topology: \"chains\" is the motion of single strands; use a pipeline that draws strands, or give another topology");
  if (!mesh->frames.empty()) check_frames(scene, deforming);
  auto input = std::make_shared<FrameInput>();
  const Skin skin = weld(*mesh);
  input->style = make_style(*mesh, skin, scene);
  // Another thread prepares the fur texture, which depends on the mesh only by the longest strand. The
  // preparation of the fur texture takes longer than that of any other array, even if the texture is read
  // from the cache.
  auto fur = std::async(std::launch::async, [texture = of_texture(scene.fur, input->style)] {
    return kept_fur_texture(texture);
  });
  input->contact_fields = contact_fields(scene.contact.mesh);
  input->scene = scene;
  input->strands = make_strands(skin, scene.fur, scene.dynamics.wind, input->style);
  input->tangents = surface_tangents(*mesh, skin);
  input->curl = curl_frame(*mesh, skin, input->tangents, scene.curl);
  input->coat = kept_coat(*mesh, scene.coat);
  input->droplets = make_droplets(mesh, skin, scene.wetness);
  input->mask_surface = kept_surface_map(*mesh, scene.wetness.size);
  input->fur_scale = fur_scale(*mesh, scene.fur);
  input->fur = fur.get();

  if (has_springs(scene.dynamics)) input->stick_normal.assign(skin.normal.begin(), skin.normal.end());
  input->camera = camera_of(scene, input->style, points_of(*input, *mesh, skin));
  input->mesh = std::move(mesh);
  return input;
}

}  // namespace pelage
