// Colliders that push strands and layers (docs/shells.md, section 9), in double precision. Lengths are in R.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/reference/strands.hpp"

namespace pelage::reference {

/// The colliders of a scene at one time.
class Colliders {
 public:
  /// `time`: in s since the start of the simulation.
  Colliders(const FrameInput& input, double time);

  bool none() const { return capsules_.empty() && !field_; }
  /// Returns the distance of a point from the nearest surface of a collider, below 0 inside. For the mesh, it
  /// is the value of the distance field. A large number if there is no collider.
  double distance(const glm::dvec3& point) const;
  /// Moves the mass of a strand out of the colliders, one after another, and removes the part of its velocity
  /// that points into them, relative to their own velocities. `root` and `normal`: of the strand.
  Strand push(Strand strand, const glm::dvec3& root, const glm::dvec3& normal) const;
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

  std::vector<Capsule> capsules_;
  const DistanceField* field_ = nullptr;
  glm::dvec3 position_{0.0}, velocity_{0.0};
  double scale_ = 1.0;
};

/// Returns the time of the picture after `frames` frames, in s.
double time_after(const DynamicsScene& dynamics, int frames);

}  // namespace pelage::reference
