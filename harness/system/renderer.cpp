#include "harness/system/renderer.hpp"

#include "harness/dump/dump.hpp"
#include "harness/scene/keyframes.hpp"

namespace pelage {

Renderer::Renderer(KnownBackend known, const BackendOptions& options, const Scene& scene)
    : system_(*known.system), backend_(known.kind->open(options, scene)) {}

/// True if the state of the backend is, or was made by set_view(), that of `scene` but for the simulation:
/// the scene differs from that of the last picture only in its time and in view keys, and it shows the same
/// frame or a later one.
bool Renderer::continues(const Scene& scene, const std::shared_ptr<const Mesh>& mesh) {
  const auto is_time = [](std::string_view key) { return key == "dynamics.time"; };
  const auto may_differ = [&](std::string_view key) { return is_time(key) || system_.is_view_key(key); };
  if (mesh_ != mesh || frames_before(scene.dynamics) + 1 < backend_->frames_simulated() ||
      !equal_except(scene_, scene, may_differ))
    return false;
  if (equal_except(scene_, scene, is_time)) return true;
  SystemInput changed = system_.with_view(input_, scene);
  if (!backend_->set_view(changed)) return false;
  input_ = std::move(changed);
  return true;
}

Picture Renderer::draw(const Scene& scene, const std::shared_ptr<const Mesh>& mesh) {
  if (!continues(scene, mesh)) {
    input_ = system_.prepare(scene, mesh);
    backend_->load(input_);
  }
  scene_ = scene;
  mesh_ = mesh;
  const int missing = frames_before(scene.dynamics) + 1 - backend_->frames_simulated();
  if (missing > 0) backend_->advance(missing - 1);
  ms_ = (missing == 0 ? backend_->still() : backend_->frame()).wall_ms;
  return picture_ = backend_->read();
}

void Renderer::dump(const std::filesystem::path& path) {
  write_dump(path, {scene_, *mesh_, picture_, backend_->title(), backend_->frames_simulated()},
             [&](Hdf5File& file) { backend_->dump(file, scene_); });
}

}  // namespace pelage
