#include "harness/prepare/moving_skin.hpp"

#include <algorithm>

#include "harness/prepare/skin.hpp"
#include "harness/prepare/strands.hpp"

namespace pelage {
namespace {

/// Returns the positions of the surface points in drawn frame `frame`. Frame -1 is the skin at rest, frame 0.
const std::vector<glm::vec3>& points_of_frame(const FrameInput& input, int frame) {
  const auto& frames = input.mesh->frames;
  const int count = int(frames.size()), at = std::max(frame, 0);
  return frames[std::size_t(input.scene.mesh.after_frames == "repeat" ? at % count
                                                                      : std::min(at, count - 1))];
}

void set_skin(FrameInput& output, const FrameInput& input, int frame) {
  const Scene& scene = input.scene;
  auto mesh = std::make_shared<Mesh>(mesh_of_frame(input, frame));
  const Skin skin = weld(*mesh);
  output.strands = make_strands(skin, scene.fur, scene.dynamics.wind, input.style);
  output.tangents = surface_tangents(*mesh, skin);
  output.curl = curl_frame(*mesh, skin, output.tangents, scene.curl);
  output.stick_normal.assign(skin.normal.begin(), skin.normal.end());
  output.mesh = std::move(mesh);
}

}  // namespace

Mesh mesh_of_frame(const FrameInput& input, int frame) {
  const Mesh& first = *input.mesh;
  Mesh mesh;
  mesh.name = first.name;
  mesh.hash = first.hash;
  mesh.uv = first.uv;
  mesh.weld = first.weld;
  mesh.triangle = first.triangle;
  mesh.welded = first.welded;
  mesh.periodic_uv = first.periodic_uv;
  mesh.length_per_uv = first.length_per_uv;
  const std::vector<glm::vec3>& point = points_of_frame(input, frame);
  mesh.position.reserve(first.weld.size());
  for (const std::uint32_t w : first.weld) mesh.position.push_back(point[w]);
  return mesh;
}

std::vector<glm::dvec3> skin_velocity(const FrameInput& input, int frame) {
  const std::vector<glm::vec3>&now = points_of_frame(input, frame),
        &before = points_of_frame(input, frame - 1);
  const double duration = double(input.scene.dynamics.step) * input.scene.dynamics.substeps;
  std::vector<glm::dvec3> velocity;
  velocity.reserve(now.size());
  for (std::size_t i = 0; i < now.size(); ++i)
    velocity.push_back((glm::dvec3(now[i]) - glm::dvec3(before[i])) / duration);
  return velocity;
}

FrameInput skin_of_frame(const FrameInput& input, int frame) {
  FrameInput output;
  output.scene = input.scene;
  output.style = input.style;
  set_skin(output, input, frame);
  return output;
}

std::shared_ptr<const FrameInput> with_skin(std::shared_ptr<const FrameInput> input, int frame) {
  if (input->mesh->frames.empty()) return input;
  auto output = std::make_shared<FrameInput>(*input);
  set_skin(*output, *input, frame);
  return output;
}

}  // namespace pelage
