// A skin that moves and deforms: the roots of key strands in each frame of an animated mesh.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage::strands {

/// The skin at the roots of all strands at one time, in the world. All lists have one element per strand.
struct SkinFrame {
  std::vector<glm::vec3> root;          ///< position, R
  std::vector<glm::vec3> velocity;      ///< R/s
  std::vector<glm::vec3> acceleration;  ///< R/s^2
  std::vector<glm::vec3> rest;          ///< direction of the strand at rest, unit vector
  std::vector<glm::vec3> normal;        ///< normal of the skin, unit vector
};

/// Returns the normals of a deformed skin at its surface points: at each point, the normalized sum of the
/// normals of the adjacent triangles, weighted by their areas. `skin` is the skin at rest, and `position` has
/// the surface points after the deformation. Where the sum is zero, the normal is that at rest.
std::vector<glm::dvec3> normals_of(const Skin& skin, const std::vector<glm::vec3>& position);

/// Computes the skin at a mesh's surface points from the positions of these points in successive frames.
class SkinMotion {
 public:
  /// Strand i grows at the surface point point[i] of the mesh as it was loaded, and its direction at rest is
  /// rest[i]. The frames have one element per strand. Throws InputError if the two lists have different
  /// lengths, or if the mesh has no such surface point.
  SkinMotion(const Mesh& mesh, std::vector<std::uint32_t> point, std::vector<glm::vec3> rest);

  /// Returns the skin of the next frame, `duration` seconds after the last frame. `position` has the surface
  /// points (Mesh::weld) in this frame. All calls must have the same duration. Let x0 be a root in this
  /// frame, x1 in the last frame and x2 in the frame before. The velocity is (3 x0 - 4 x1 + x2) / (2
  /// duration), and the acceleration is (x0 - 2 x1 + x2) / duration^2. The first frame has the velocity 0 and
  /// the acceleration 0. The second frame has the velocity (x0 - x1) / duration and the acceleration 0.
  ///
  /// The normal is the normalized sum of the normals of the adjacent triangles, weighted by their areas. The
  /// direction at rest is rotated like the skin: by the smallest rotation from the first normal to the new
  /// normal, and then about the new normal by the angle for which the rotated edges at the surface point
  /// match the edges of this frame best (least squares).
  SkinFrame next(const std::vector<glm::vec3>& position, double duration);

 private:
  Skin skin_;  ///< of the mesh as it was loaded
  std::vector<std::uint32_t> point_;
  std::vector<glm::vec3> rest_;
  std::vector<std::vector<glm::vec3>> before_;  ///< positions of the last frame and of the frame before it
};

}  // namespace pelage::strands
