#include "harness/strands/scene/strand_input.hpp"

namespace pelage::strands {
namespace {

std::vector<glm::vec3> rest_of(const Fur& fur) {
  std::vector<glm::vec3> rest;
  for (const KeyStrand& key : fur.keys) rest.push_back(key.rest);
  return rest;
}

}  // namespace

SkinFrames::SkinFrames(const Scene& scene, std::shared_ptr<const Mesh> mesh, const Fur& fur,
                       std::shared_ptr<const SkinSurface> surface)
    : mesh_(std::move(mesh)),
      skin_(weld(*mesh_)),
      motion_(*mesh_, fur.points, rest_of(fur)),
      surface_(std::move(surface)),
      duration_(double(scene.dynamics.step) * scene.dynamics.substeps),
      repeat_(scene.mesh.after_frames == "repeat") {}

void SkinFrames::advance() {
  // The first drawn frame shows the first frame of the mesh, as the skin at rest does.
  if (calls_++ == 1) return;
  const std::size_t count = mesh_->frames.size();
  if (!repeat_ && next_ == count) {
    frame_.velocity.assign(frame_.velocity.size(), glm::vec3(0));
    frame_.acceleration.assign(frame_.acceleration.size(), glm::vec3(0));
    return;
  }
  const std::vector<glm::vec3>& position = mesh_->frames[next_ % count];
  ++next_;
  frame_ = motion_.next(position, duration_);
  if (!surface_) return;
  auto surface = std::make_shared<SkinSurface>(*surface_);
  const std::vector<glm::dvec3> normals = normals_of(skin_, position);
  for (std::size_t v = 0; v < surface->position.size(); ++v) {
    surface->position[v] = position[mesh_->weld[v]];
    surface->normal[v] = glm::vec3(normals[mesh_->weld[v]]);
  }
  surface_ = std::move(surface);
}

}  // namespace pelage::strands
