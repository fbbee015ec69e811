// The colliders of a scene (docs/colliders.md) in double precision. Lengths are in R.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/contact.hpp"

namespace pelage::reference {

/// A mass that colliders push.
struct Pushed {
  glm::dvec3 place;     ///< relative to the root of its strand or stick
  glm::dvec3 velocity;  ///< R/s
};

/// The colliders of a scene at one time.
class Colliders {
 public:
  /// `fields`: FrameInput::contact_fields. `time`: in s since the start of the simulation.
  Colliders(const Scene& scene, const ContactFields& fields, double time);

  bool none() const { return capsules_.empty() && !field_[0]; }
  /// Returns the distance of a point from the nearest surface of a collider, below 0 inside. For the mesh, it
  /// is the value of the distance field. A large number if there is no collider.
  double distance(const glm::dvec3& point) const;
  /// Moves a mass out of the colliders, one after another, and removes the part of its velocity that points
  /// into them, relative to the velocity of their surface. `normal`: of the skin at the root.
  Pushed push(Pushed mass, const glm::dvec3& root, const glm::dvec3& normal) const;
  /// Returns the displacement of a layer's vertex from `root` after colliders have moved it towards the root:
  /// `along` times a number from 0 to 1.
  glm::dvec3 kept(const glm::dvec3& root, const glm::dvec3& along) const;

 private:
  struct Capsule {  // a sphere if both ends are equal
    glm::dvec3 from, to;
    double radius;
    glm::dvec3 velocity;
  };
  double mesh_distance(const glm::dvec3& point) const;
  glm::dvec3 turned(const glm::dvec3& v, double angle) const;
  glm::dvec3 in_mesh(const glm::dvec3& point) const;

  std::vector<Capsule> capsules_;
  std::array<const DistanceField*, 2> field_{};  ///< of the last and of the next file; null: no mesh
  double share_ = 0, duration_ = 1;              ///< passed part and duration of the time between the files
  glm::dvec3 position_{0.0}, velocity_{0.0}, axis_{0.0};
  double angle_ = 0, spin_ = 0, scale_ = 1;
};

}  // namespace pelage::reference
