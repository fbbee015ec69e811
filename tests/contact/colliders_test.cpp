// Tests the colliders (docs/colliders.md): the kernels' text in double precision and the reference
// give the same numbers, and both keep closed forms.
#include "harness/contact/reference/colliders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>

#include "tests/support/opencl_as_cpp.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::in_double {
inline real gather(const real* table, whole i) {
  return table[i];
}
#define CONTACT 2
// clang-format off
#include "common/contact.clh"
// clang-format on
}  // namespace pelage::in_double

namespace pelage {
namespace {

using in_double::real3;
using synthetic::Any;

double frame_of(const Scene& scene) {
  return double(scene.dynamics.step) * scene.dynamics.substeps;
}

glm::dvec3 to_glm(real3 v) {
  return {v.x, v.y, v.z};
}
real3 in_shim(glm::dvec3 v) {
  return in_double::vec3(v.x, v.y, v.z);
}

/// Returns a field whose values are those of `value` at the nodes of a grid with `cells` cells per side.
std::shared_ptr<const DistanceField> field_of(int cells, const std::function<double(glm::dvec3)>& value) {
  DistanceField f;
  f.nodes = glm::ivec3(cells + 1, cells + 2, cells + 3);
  f.cell = 2.4f / float(cells);
  f.origin = glm::vec3(-1.2f);
  for (int z = 0; z < f.nodes.z; ++z)
    for (int y = 0; y < f.nodes.y; ++y)
      for (int x = 0; x < f.nodes.x; ++x)
        f.distance.push_back(float(value(glm::dvec3(f.origin + f.cell * glm::vec3(x, y, z)))));
  return std::make_shared<const DistanceField>(f);
}

/// The table and the fields of kernels/common/contact.clh for one time, from the definitions of the document.
struct Table {
  std::vector<double> table, field;

  Table(const Scene& scene, const ContactFields& fields, double time) {
    const ContactScene& c = scene.contact;
    table = {double(c.spheres.size() + c.capsules.size() + 2), 2, 2, 2, 1, 0, 0, 0};
    const auto body = [&](glm::dvec3 from, glm::dvec3 to, double radius, const ContactMotion& motion) {
      const glm::dvec3 shift = (time - double(motion.begin)) * glm::dvec3(motion.velocity), at = from + shift;
      const double length = glm::length(to - from);
      const glm::dvec3 axis = length > 0 ? (to - from) / length : glm::dvec3(0), v(motion.velocity);
      table.insert(table.end(), {at.x, at.y, at.z, axis.x, axis.y, axis.z, length, radius, v.x, v.y, v.z, 0});
    };
    for (const ContactSphereScene& s : c.spheres)
      body(glm::dvec3(s.centre), glm::dvec3(s.centre), double(s.radius), s.motion);
    for (const ContactCapsuleScene& k : c.capsules)
      body(glm::dvec3(k.from), glm::dvec3(k.to), double(k.radius), k.motion);
    const ContactMeshScene& m = c.mesh;
    if (fields.empty()) {
      table.resize(table.size() + 24);
      field = {0.0};
      return;
    }
    const DistanceField& grid = *fields.front();
    table[1] = grid.nodes.x, table[2] = grid.nodes.y, table[3] = grid.nodes.z,
    table[4] = 1 / double(grid.cell);
    for (std::size_t k = 0; k < 3; ++k) table[5 + k] = double(grid.origin[int(k)]);
    const double frame = frame_of(scene), since = time - double(m.motion.begin), passed = since / frame;
    const auto last = std::min(std::size_t(passed), fields.size() - 1);
    const auto next = std::min(last + 1, fields.size() - 1);
    for (const std::size_t file : {last, next})
      field.insert(field.end(), fields[file]->distance.begin(), fields[file]->distance.end());
    const glm::dvec3 v(m.motion.velocity), at = glm::dvec3(m.position) + since * v;
    const double scale = double(m.scale), angle = double(m.spin) * since;
    table.insert(table.end(), {at.x, at.y, at.z, 0, passed - std::floor(passed), 1 / frame, 1 / scale, scale,
                               v.x, v.y, v.z, 0});
    const glm::dvec3 n = glm::normalize(glm::dvec3(m.axis));
    for (int k = 0; k < 3; ++k) {  // Rodrigues' formula for each axis
      glm::dvec3 e(0);
      e[k] = 1;
      const glm::dvec3 turned =
          std::cos(angle) * e + std::sin(angle) * glm::cross(n, e) + (1 - std::cos(angle)) * n[k] * n;
      table.insert(table.end(), {turned.x, turned.y, turned.z});
    }
    for (int k = 0; k < 3; ++k) table.push_back(double(m.spin) * n[k]);
  }
  in_double::Colliders colliders() const { return in_double::colliders_at(table.data(), field.data(), 0); }
  reference::Pushed pushed(glm::dvec3 place, glm::dvec3 velocity, glm::dvec3 root, glm::dvec3 normal) const {
    const in_double::Pushed p = in_double::pushed_out(colliders(), {in_shim(place), in_shim(velocity)},
                                                      in_shim(root), in_shim(normal));
    return {to_glm(p.place), to_glm(p.speed)};
  }
};

/// A scene whose mesh moves and turns.
Scene turning(float scale, float spin) {
  Scene s;
  s.dynamics.step = 1.0f / 256;
  s.contact.mesh.file = "shape-0.off";
  s.contact.mesh.position = glm::vec3(0.25f, -0.5f, 0.125f) * scale;
  s.contact.mesh.scale = scale;
  s.contact.mesh.axis = {1, -2, 0.5f};
  s.contact.mesh.spin = spin;
  s.contact.mesh.motion.velocity = glm::vec3(0.5f, 0.25f, -1) * scale;
  s.contact.mesh.motion.begin = 0.25f;
  return s;
}

struct Sizes : testing::TestWithParam<std::tuple<float, float, int>> {};  // scale, spin, files

TEST_P(Sizes, KernelsAreTheReference) {
  const auto [scale, spin, files] = GetParam();
  Scene scene = turning(scale, spin);
  const double frame = frame_of(scene);
  scene.contact.mesh.frames = files;
  scene.contact.spheres.push_back(
      {.centre = glm::vec3(0.5f, 0.5f, 0) * scale, .radius = 0.25f * scale, .motion = {}});
  scene.contact.capsules.push_back({.from = glm::vec3(-0.5f, 0, 0) * scale,
                                    .to = glm::vec3(0.25f, 0.75f, 0.5f) * scale,
                                    .radius = 0.125f * scale,
                                    .motion = {.velocity = glm::vec3(1, 0, 0) * scale, .begin = 0}});
  ContactFields fields;
  Any any{7};
  for (int i = 0; i < files; ++i)  // no distances, but any numbers
    fields.push_back(field_of(5, [&](glm::dvec3 p) { return 0.5 * (glm::length(p) - 0.8) + 0.2 * any(); }));
  const double exact = 1e-9 * double(scale);
  int moved = 0, shortened = 0;
  for (const double time : {0.25, 0.25 + 0.3 * frame, 0.25 + 1.7 * frame, 0.25 + 7.2 * frame}) {
    const reference::Colliders colliders(scene, fields, time);
    const Table table(scene, fields, time);
    for (int i = 0; i < 600; ++i) {
      const glm::dvec3 root = 1.2 * double(scale) * any.vector(), q = 0.6 * double(scale) * any.vector();
      const glm::dvec3 v = 3.0 * double(scale) * any.vector(), n = any.direction();
      const reference::Pushed a = colliders.push({q, v}, root, n), b = table.pushed(q, v, root, n);
      EXPECT_LT(glm::distance(a.place, b.place), exact) << i;
      EXPECT_LT(glm::distance(a.velocity, b.velocity), exact * (100 + std::abs(double(spin)))) << i;
      moved += glm::distance(a.place, q) > 1e-3 * double(scale);
      const double share = in_double::kept_share(table.colliders(), in_shim(root), in_shim(q));
      EXPECT_LT(glm::distance(colliders.kept(root, q), share * q), exact) << i;
      shortened += share < 1;
    }
  }
  EXPECT_GT(moved, 200);
  EXPECT_GT(shortened, 200);
}

INSTANTIATE_TEST_SUITE_P(Colliders, Sizes,
                         testing::Combine(testing::Values(0.001f, 0.5f, 100.0f),
                                          testing::Values(0.0f, 2.5f, -1000.0f), testing::Values(1, 3)));

/// Returns the velocity with which a mass at rest leaves the mesh, and the direction of this velocity.
template <class Push>
void expect_velocity(const Push& push, glm::dvec3 point, glm::dvec3 outward, double speed) {
  const reference::Pushed after = push(point);
  EXPECT_LT(glm::distance(glm::normalize(after.velocity), outward), 1e-5);
  EXPECT_NEAR(glm::length(after.velocity), speed, 1e-5 * speed);
}

// A half space y < 0 of the mesh is a wall. It turns about z, and reaches a mass at the distance d from the
// axis with the speed omega d.
TEST(TurningWall, PushesWithTheSpeedOfItsSurface) {
  for (const double omega : {1e-3, 2.0, 900.0}) {
    Scene scene;
    scene.contact.mesh.file = "wall.off";
    scene.contact.mesh.position = {0, 0, 0};
    scene.contact.mesh.scale = 2;
    scene.contact.mesh.axis = {0, 0, 3};
    scene.contact.mesh.spin = float(omega);
    const ContactFields fields{field_of(8, [](glm::dvec3 p) { return p.y; })};
    const double quarter = std::numbers::pi / 2 / double(scene.contact.mesh.spin);
    const double time = 1.2 * quarter;  // the wall's normal is now turned by 108 degrees
    const double angle = double(scene.contact.mesh.spin) * time;
    const glm::dvec3 normal(-std::sin(angle), std::cos(angle), 0), along(std::cos(angle), std::sin(angle), 0);
    const glm::dvec3 point = 0.7 * along - 0.01 * normal;
    const reference::Colliders colliders(scene, fields, time);
    const Table table(scene, fields, time);
    const glm::dvec3 root(0.1, 0.2, 0.3), rest(0), up(0, 0, 1);
    const double speed = 0.7 * double(scene.contact.mesh.spin);
    expect_velocity(
        [&](glm::dvec3 p) {
          return colliders.push({p - root, rest}, root, up);
        },
        point, normal, speed);
    expect_velocity([&](glm::dvec3 p) { return table.pushed(p - root, rest, root, up); }, point, normal,
                    speed);
  }
}

// The wall y < h(t) rises by one cell in a file.
TEST(RisingWall, PushesWithTheSpeedOfItsSurface) {
  Scene scene;
  scene.contact.mesh.file = "wall-0.off";
  scene.contact.mesh.position = {0, 0, 0};
  scene.contact.mesh.scale = 0.5f;
  scene.contact.mesh.frames = 3;
  ContactFields fields;
  for (int i = 0; i < 3; ++i) fields.push_back(field_of(8, [&](glm::dvec3 p) { return p.y - 0.3 * i; }));
  const glm::dvec3 root(0), rest(0), up(0, 0, 1);
  for (const double passed : {0.25, 1.5, 2.5}) {  // the shape of the last file stays
    const double time = passed * 4 * double(scene.dynamics.step);
    const reference::Colliders colliders(scene, fields, time);
    const double height = 0.5 * 0.3 * std::min(passed, 2.0), speed = 0.15 / (4 * double(scene.dynamics.step));
    EXPECT_NEAR(colliders.distance({0.1, 0.2, 0.1}), 0.2 - height, 1e-7);
    const glm::dvec3 point(0.1, height - 0.02, -0.1);
    const reference::Pushed after = colliders.push({point, rest}, root, up);
    EXPECT_LT(glm::distance(after.place, glm::dvec3(0.1, height, -0.1)), 1e-6);
    EXPECT_LT(glm::distance(after.velocity, glm::dvec3(0, passed < 2 ? speed : 0, 0)), 1e-4);
    EXPECT_LT(
        glm::distance(Table(scene, fields, time).pushed(point, rest, root, up).velocity, after.velocity),
        1e-4);
  }
}

// After the last file, the first one follows.
TEST(RepeatedFiles, BeginAgain) {
  Scene scene;
  scene.contact.mesh.file = "wall-0.off";
  scene.contact.mesh.position = {0, 0, 0};
  scene.contact.mesh.frames = 3;
  scene.contact.mesh.after_frames = "repeat";
  scene.contact.mesh.scale = 1;
  ContactFields fields;
  for (const double height : {0.0, 0.3, 0.5})
    fields.push_back(field_of(8, [&](glm::dvec3 p) { return p.y - height; }));
  const double duration = 4 * double(scene.dynamics.step);
  for (const auto& [passed, height] :
       {std::pair(0.5, 0.15), {2.0, 0.5}, {2.5, 0.25}, {3.5, 0.15}, {3001.0, 0.3}}) {
    const double time = passed * duration;
    EXPECT_NEAR(reference::Colliders(scene, fields, time).distance({0, 0.1, 0}), 0.1 - height, 1e-5)
        << passed;
    const DistanceField now = contact_field_at(fields, scene.contact.mesh, scene.dynamics, time);
    EXPECT_NEAR(value_at(now, {0, 0.1, 0}), 0.1 - height, 1e-5) << passed;
  }
}

}  // namespace
}  // namespace pelage
