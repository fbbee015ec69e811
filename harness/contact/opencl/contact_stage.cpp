#include "harness/contact/opencl/contact_stage.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>

#include "harness/prepare/contact.hpp"

namespace pelage {
namespace {

using Row = std::array<float, 12>;  // CONTACT_COLUMNS of kernels/common/contact.clh

/// Number of adjacent fields on the device if the mesh deforms. The substeps of a frame take less time than
/// there is between two files. They are therefore in at most two intervals, which have three ends.
constexpr int fields_at_once = 3;

Row row_of(const glm::dvec3& from, const glm::dvec3& axis, double length, double radius,
           const glm::vec3& velocity) {
  return {float(from.x), float(from.y), float(from.z), float(axis.x), float(axis.y), float(axis.z),
          float(length), float(radius), velocity.x,    velocity.y,    velocity.z,    0.0f};
}

void append(std::vector<float>& table, const Row& row) {
  table.insert(table.end(), row.begin(), row.end());
}

/// Appends the rows of the mesh. `first`: number of the first file on the device.
void append_mesh(std::vector<float>& table, const ContactMeshScene& mesh, const DynamicsScene& dynamics,
                 int first, double time) {
  if (mesh.file.empty() || !mesh.motion.exists(time)) {
    append(table, {});
    return append(table, {});
  }
  const ContactMoment m = contact_moment(mesh, dynamics, time);
  const int field = std::min(m.file - first, fields_at_once - 2);
  const double share = m.share + (m.file - first - field);
  const double rate = 1 / (double(dynamics.step) * static_cast<double>(dynamics.substeps));
  append(table, row_of(m.position, {double(field), share, rate}, 1 / double(mesh.scale), double(mesh.scale),
                       mesh.motion.velocity));
  Row turn{};
  for (std::size_t i = 0; i < 9; ++i) turn[i] = float(m.turn[int(i / 3)][int(i % 3)]);
  for (std::size_t i = 0; i < 3; ++i) turn[9 + i] = float(m.spin[int(i)]);
  append(table, turn);
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
}

/// Returns the header of the table: rows per time, and the grid of the field.
std::vector<float> header_of(const ContactScene& scene, const ContactFields& fields) {
  const auto rows = float(scene.spheres.size() + scene.capsules.size() + 2);
  if (fields.empty()) return {rows, 2, 2, 2, 1, 0, 0, 0};
  const DistanceField& field = *fields.front();
  const glm::vec3 nodes(field.nodes), origin = field.origin;
  return {rows, nodes.x, nodes.y, nodes.z, 1 / field.cell, origin.x, origin.y, origin.z};
}

/// Returns the fields that are on the device at the same time, from the file number `first` on.
std::vector<float> some_fields(const ContactFields& fields, const ContactMeshScene& mesh, int first) {
  if (fields.empty()) return {0.0f};
  std::vector<float> all;
  for (int i = 0; i < (fields.size() > 1 ? fields_at_once : 1); ++i) {
    const std::vector<float>& one = fields[field_of_interval(mesh, first + i)]->distance;
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

}  // namespace

std::string contact_options(const ContactScene& scene) {
  if (!has_contact(scene)) return {};
  return scene.mesh.frames > 1 ? " -D CONTACT=2" : " -D CONTACT=1";
}

ContactStage::ContactStage(const cl::Queue& queue, const Scene& scene, const ContactFields& fields)
    : scene_(scene.contact), dynamics_(scene.dynamics), fields_(fields), header_(header_of(scene_, fields)) {
  first_ = first_file(0);
  table_ = cl::Buffer<float>(queue, std::span<const float>(values(0)));
  field_ = cl::Buffer<float>(queue, std::span<const float>(some_fields(fields_, scene_.mesh, first_)));
}

double ContactStage::time_of(int frame, int substep) const {
  return (double(frame) * dynamics_.substeps + substep + 1) * double(dynamics_.step);
}

int ContactStage::first_file(int frame) const {
  return contact_moment(scene_.mesh, dynamics_, time_of(frame, 0)).file;
}

std::vector<float> ContactStage::values(int frame) const {
  std::vector<float> table = header_;
  for (int i = 0; i < dynamics_.substeps; ++i) {
    const double time = time_of(frame, i);
    append_time(table, scene_, time);
    append_mesh(table, scene_.mesh, dynamics_, first_, time);
  }
  return table;
}

void ContactStage::set_frame(const cl::Queue& queue, int frame) {
  if (const int first = first_file(frame); first != first_) {
    field_.write(queue, some_fields(fields_, scene_.mesh, first_ = first));
  }
  table_.write(queue, values(frame));
}

}  // namespace pelage
