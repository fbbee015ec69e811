#include "harness/prepare/contact.hpp"

#include <fmt/format.h>

#include "harness/distance/closed_surface.hpp"
#include "harness/error.hpp"

namespace pelage {

std::shared_ptr<const DistanceField> contact_field(const ContactMeshScene& mesh) {
  if (mesh.file.empty()) return {};
  std::shared_ptr<const Mesh> loaded;
  try {
    loaded = load_model(mesh.file.string());
  } catch (const InputError& error) {
    throw InputError(fmt::format("contact.mesh: {}", error.what()));
  }
  if (!is_closed(*loaded))
    throw InputError(
        fmt::format("contact.mesh: {}: the mesh is not closed, so it has no inside; give a closed mesh",
                    mesh.file.string()));
  return kept_distance_field(loaded, mesh.cells);
}

}  // namespace pelage
