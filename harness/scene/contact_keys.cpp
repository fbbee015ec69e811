// The scene keys of colliders (docs/shells.md, section 9). In the help texts, R is the radius of the model's
// bounding sphere.
#include "harness/scene/contact_keys.hpp"

namespace pelage {
namespace {

// clang-format off
std::vector<Key> motion_keys(ContactMotion& motion) {
  return {
      {"velocity", &motion.velocity, "R/s", -1000, 1000, "velocity of the collider"},
      {"begin", &motion.begin, "s", 0, longest_contact, "time at which the collider appears, at the given position"},
      {"end", &motion.end, "s", 0, longest_contact, "time at which the collider disappears"},
  };
}

std::vector<Key> joined(std::vector<Key> keys, const std::vector<Key>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

}  // namespace

std::vector<Key> contact_keys(ContactScene& c) {
  ContactMeshScene& mesh = c.mesh;
  ContactMotion& motion = mesh.motion;
  return {
      {.name = "contact.mesh", .slot = &mesh.file, .unit = "", .help = "mesh file of a collider, which must be closed; pelage scales it to a bounding sphere of radius 1 around the origin, and contact.mesh_scale and contact.mesh_position then scale and move it; \"\": no such collider"},
      {"contact.mesh_position", &mesh.position, "R", -1000, 1000, "position of the mesh's centre at the time contact.mesh_begin"},
      {"contact.mesh_scale", &mesh.scale, "R", 0.001, 100, "radius of the mesh's bounding sphere"},
      {"contact.mesh_cells", &mesh.cells, "", 4, 256, "number of cells of the signed distance field along the longest side of the mesh"},
      {"contact.mesh_velocity", &motion.velocity, "R/s", -1000, 1000, "velocity of the mesh"},
      {"contact.mesh_begin", &motion.begin, "s", 0, longest_contact, "time at which the mesh appears"},
      {"contact.mesh_end", &motion.end, "s", 0, longest_contact, "time at which the mesh disappears"},
  };
}

std::vector<Key> contact_sphere_keys(ContactSphereScene& s) {
  return joined({
      {"centre", &s.centre, "R", -1000, 1000, "centre of the sphere at the time begin"},
      {"radius", &s.radius, "R", 0.001, 100, "radius of the sphere"},
  }, motion_keys(s.motion));
}

std::vector<Key> contact_capsule_keys(ContactCapsuleScene& c) {
  return joined({
      {"from", &c.from, "R", -1000, 1000, "first end of the capsule's axis at the time begin"},
      {"to", &c.to, "R", -1000, 1000, "second end of the capsule's axis at the time begin"},
      {"radius", &c.radius, "R", 0.001, 100, "radius of the capsule"},
  }, motion_keys(c.motion));
}
// clang-format on

}  // namespace pelage
