// The part of a scene that describes colliders: bodies that push the layers of the fur down
// (docs/shells.md, section 9). R is the radius of the mesh's bounding sphere.
#pragma once
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

namespace pelage {

inline constexpr float longest_contact = 3600.0f;  ///< greatest time of a collider, s

/// The motion of a collider: it exists from `begin` to `end` and moves with a constant velocity. Its
/// positions in the scene are those at the time `begin`.
struct ContactMotion {
  glm::vec3 velocity{0.0f};     ///< R/s
  float begin = 0.0f;           ///< s
  float end = longest_contact;  ///< s
};

struct ContactSphereScene {
  glm::vec3 centre{0.0f, 1.2f, 0.0f};  ///< R
  float radius = 0.25f;                ///< R
  ContactMotion motion;
};

/// The points whose distance from the line segment from `from` to `to` is at most `radius`.
struct ContactCapsuleScene {
  glm::vec3 from{-0.5f, 1.2f, 0.0f}, to{0.5f, 1.2f, 0.0f};  ///< R
  float radius = 0.15f;                                     ///< R
  ContactMotion motion;
};

/// A closed mesh, scaled to a bounding sphere of radius 1 around the origin, then by `scale`, and moved to
/// `position`. Its surface is approximated by a signed distance field.
struct ContactMeshScene {
  std::filesystem::path file;            ///< mesh file; empty: none
  glm::vec3 position{0.0f, 1.2f, 0.0f};  ///< R
  float scale = 0.3f;                    ///< radius of the mesh's bounding sphere, R
  int cells = 48;                        ///< number of cells of the field along the longest side of the mesh
  ContactMotion motion;
};

inline constexpr int most_colliders = 8;  ///< greatest number of spheres and capsules together

struct ContactScene {
  std::vector<ContactSphereScene> spheres;
  std::vector<ContactCapsuleScene> capsules;
  ContactMeshScene mesh;
};

inline bool has_contact(const ContactScene& contact) {
  return !contact.spheres.empty() || !contact.capsules.empty() || !contact.mesh.file.empty();
}

}  // namespace pelage
