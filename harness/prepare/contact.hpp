// The mesh among the colliders (docs/shells.md, section 9).
#pragma once
#include <memory>

#include "harness/distance/field.hpp"
#include "harness/scene/contact_scene.hpp"

namespace pelage {

/// Returns the distances from the mesh that the scene names, scaled to a bounding sphere of radius 1 around
/// the origin; null if the scene names no mesh. Throws InputError if the file is no usable mesh, or if the
/// mesh is not closed.
std::shared_ptr<const DistanceField> contact_field(const ContactMeshScene& mesh);

}  // namespace pelage
