#include "harness/mesh/store.hpp"

namespace pelage {

std::shared_ptr<const Mesh> MeshStore::get(const std::string& model) {
  std::shared_ptr<const Mesh>& mesh = meshes_[model];
  if (!mesh) {
    MeshOptions options;
    options.progress = progress_;
    mesh = load_model(model, options);
  }
  return mesh;
}

}  // namespace pelage
