#include <glm/geometric.hpp>
#include <span>

#include "harness/shells/opencl/simulate_stage.hpp"

namespace pelage::shells {
namespace {

using Row = std::array<float, 12>;  // CONTACT_COLUMNS of kernels/common/contact.clh

Row row_of(const glm::dvec3& from, const glm::dvec3& axis, double length, double radius,
           const glm::vec3& velocity) {
  return {float(from.x), float(from.y), float(from.z), float(axis.x), float(axis.y), float(axis.z),
          float(length), float(radius), velocity.x,    velocity.y,    velocity.z,    0.0f};
}

void append(std::vector<float>& table, const Row& row) {
  table.insert(table.end(), row.begin(), row.end());
}

void append_time(std::vector<float>& table, const ContactScene& scene, double time) {
  for (const ContactSphereScene& s : scene.spheres)
    append(table, s.motion.exists(time) ? row_of(s.motion.moved(s.centre, time), glm::dvec3(0), 0,
                                                 double(s.radius), s.motion.velocity)
                                        : Row{});
  for (const ContactCapsuleScene& c : scene.capsules) {
    const glm::dvec3 along = glm::dvec3(c.to) - glm::dvec3(c.from);
    const double length = glm::length(along);
    append(table, c.motion.exists(time)
                      ? row_of(c.motion.moved(c.from, time), length > 0 ? along / length : glm::dvec3(0),
                               length, double(c.radius), c.motion.velocity)
                      : Row{});
  }
  const ContactMeshScene& mesh = scene.mesh;
  append(table, !mesh.file.empty() && mesh.motion.exists(time)
                    ? row_of(mesh.motion.moved(mesh.position, time), glm::dvec3(0), 1 / double(mesh.scale),
                             double(mesh.scale), mesh.motion.velocity)
                    : Row{});
}

/// Returns the header of the table: rows per time, and the grid of the field.
std::vector<float> header_of(const ContactScene& scene, const DistanceField* field) {
  const auto rows = float(scene.spheres.size() + scene.capsules.size() + 1);
  if (!field) return {rows, 2, 2, 2, 1, 0, 0, 0};
  const glm::vec3 nodes(field->nodes), origin = field->origin;
  return {rows, nodes.x, nodes.y, nodes.z, 1 / field->cell, origin.x, origin.y, origin.z};
}

}  // namespace

ContactStage::ContactStage(const cl::Queue& queue, const FrameInput& input)
    : scene_(input.scene.contact),
      dynamics_(input.scene.dynamics),
      header_(header_of(scene_, input.contact_field.get())) {
  table_ = cl::Buffer<float>(queue, std::span<const float>(values(0)));
  const std::vector<float> none{0.0f};
  field_ = cl::Buffer<float>(
      queue, std::span<const float>(input.contact_field ? input.contact_field->distance : none));
}

std::vector<float> ContactStage::values(int frame) const {
  std::vector<float> table = header_;
  for (int i = 0; i < dynamics_.substeps; ++i) {
    const double number = double(frame) * dynamics_.substeps + i + 1;
    append_time(table, scene_, number * double(dynamics_.step));
  }
  return table;
}

void ContactStage::set_frame(const cl::Queue& queue, int frame) {
  table_.write(queue, values(frame));
}

}  // namespace pelage::shells
