// The mesh among the colliders (docs/shells.md, section 9): its distance fields, and its place over time.
#pragma once
#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

#include "harness/distance/field.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// The distance fields of contact.mesh: one per file, all on the same grid. Empty without such a mesh.
using ContactFields = std::vector<std::shared_ptr<const DistanceField>>;

/// Returns the distances from the mesh among the colliders. They are scaled so that the mesh of the first
/// file has a bounding sphere of radius 1 around the origin. Throws InputError if a file is no usable mesh,
/// if the mesh is not closed, or if the fields need too much memory.
ContactFields contact_fields(const ContactMeshScene& mesh);

/// The shape and the pose of the mesh at one time.
struct ContactMoment {
  int file = 0;  ///< number of the interval between two files that contains the time; counts on after the end
  double share = 0;     ///< part of the interval that has passed, 0 to 1
  glm::dvec3 position;  ///< of the centre, R
  glm::dmat3 turn;      ///< rotation from the mesh's axes to those of the scene
  glm::dvec3 spin;      ///< angular velocity, rad/s
};

/// Returns the mesh at a time, in s; before the time mesh_begin, as at this time.
ContactMoment contact_moment(const ContactMeshScene& mesh, const DynamicsScene& dynamics, double time);

/// Returns the index of the field with which the interval number `interval` (ContactMoment::file) begins.
std::size_t field_of_interval(const ContactMeshScene& mesh, int interval);

/// Returns the field at a time (s), interpolated between two files. `fields` must not be empty.
DistanceField contact_field_at(const ContactFields& fields, const ContactMeshScene& mesh,
                               const DynamicsScene& dynamics, double time);

}  // namespace pelage
