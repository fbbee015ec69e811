#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "harness/gl/context.hpp"
#include "harness/shells/opengl/program.hpp"

namespace pelage::gl {
namespace {

void set_vectors(GLuint program, const char* name, const std::vector<glm::vec4>& values) {
  const GLint place = glGetUniformLocation(program, name);
  if (place >= 0) glProgramUniform4fv(program, place, GLsizei(values.size()), &values.front().x);
}

void upload(GLuint texture, glm::ivec3 nodes, const std::vector<float>& distance) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage3D(texture, 0, 0, 0, 0, nodes.x, nodes.y, nodes.z, GL_RED, GL_FLOAT, distance.data());
}

}  // namespace

std::string contact_defines(const FrameInput& input) {
  const ContactScene& contact = input.scene.contact;
  if (!has_contact(contact)) return {};
  return fmt::format("#define CONTACT {}\n{}", contact.spheres.size() + contact.capsules.size(),
                     input.contact_fields.empty() ? "" : "#define CONTACT_MESH\n");
}

gl::Object field_texture(const FrameInput& input) {
  const std::vector<float> far{1.0f};
  const DistanceField* field = input.contact_fields.empty() ? nullptr : input.contact_fields[0].get();
  const glm::ivec3 nodes = field ? field->nodes : glm::ivec3(1);
  gl::Object texture = gl::make_texture(GL_TEXTURE_3D);
  glTextureStorage3D(texture.id(), 1, GL_R32F, nodes.x, nodes.y, nodes.z);
  upload(texture.id(), nodes, field ? field->distance : far);
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl::check_gl("uploading a distance field");
  return texture;
}

void set_colliders(GLuint program, GLuint field, const FrameInput& input, double time) {
  const ContactScene& contact = input.scene.contact;
  if (!has_contact(contact)) return;
  std::vector<glm::vec4> from, axis;
  for (const ContactSphereScene& s : contact.spheres) {
    from.emplace_back(glm::vec3(s.motion.moved(s.centre, time)), s.motion.exists(time) ? s.radius : 0.0f);
    axis.emplace_back(0.0f);
  }
  for (const ContactCapsuleScene& c : contact.capsules) {
    const glm::dvec3 along = glm::dvec3(c.to) - glm::dvec3(c.from);
    const double length = glm::length(along);
    from.emplace_back(glm::vec3(c.motion.moved(c.from, time)), c.motion.exists(time) ? c.radius : 0.0f);
    axis.emplace_back(glm::vec3(length > 0 ? along / length : along), float(length));
  }
  from.emplace_back(0.0f);
  axis.emplace_back(0.0f);
  set_vectors(program, "collider_from", from);
  set_vectors(program, "collider_axis", axis);
  if (input.contact_fields.empty()) return;
  const ContactMeshScene& mesh = contact.mesh;
  const DistanceField& grid = *input.contact_fields.front();
  const ContactMoment m = contact_moment(mesh, input.scene.dynamics, time);
  if (mesh.frames > 1)
    upload(field, grid.nodes,
           contact_field_at(input.contact_fields, mesh, input.scene.dynamics, time).distance);
  const auto axis_of = [&](int i) { return glm::vec4(glm::vec3(m.turn[i]), 0.0f); };
  set_vectors(program, "mesh_axes", {axis_of(0), axis_of(1), axis_of(2)});
  set_vectors(program, "mesh_place",
              {glm::vec4(glm::vec3(m.position), mesh.motion.exists(time) ? mesh.scale : 0.0f)});
  set_vectors(program, "mesh_grid", {glm::vec4(grid.origin, 1.0f / grid.cell)});
}

}  // namespace pelage::gl
