// Tests sticks on a skin that moves and deforms (docs/springs.md, section Moving skin): the reference must
// move them as Newton's law in the world frame does.
#include "harness/prepare/moving_skin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/tolerances.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/springs/support/moving_skin.hpp"

namespace pelage::springs {
namespace {

using namespace test;
using Points = std::vector<glm::dvec3>;

/// Integrates Newton's law in the world by RK4, with bases that move at constant velocity between two frames.
/// There are no inertial forces: the masses are free, and only springs, weight, air and the return force act
/// on them.
Points tops_in_the_world(const FrameInput& input, int frames) {
  const DynamicsScene& d = input.scene.dynamics;
  const double m = double(d.mass), c = double(d.drag), length = double(input.scene.fur.length),
               h = double(d.step);
  const glm::dvec3 air =
      double(float(d.wind.strength / d.drag)) * glm::normalize(glm::dvec3(d.wind.direction));
  const auto skin = [&](int k) {
    const auto& all = input.mesh->frames;
    return all[std::size_t(std::clamp(k, 0, int(all.size()) - 1))];
  };
  const SpringNetwork rest = network_of(input);
  Points place, speed(rest.sticks(), glm::dvec3(0));
  for (std::size_t i = 0; i < rest.sticks(); ++i)
    place.push_back(glm::dvec3(rest.mass[i]) + glm::dvec3(rest.length * rest.normal[i]));
  for (int frame = 0; frame < frames; ++frame) {
    const std::vector<glm::vec3> from = skin(frame - 1), to = skin(frame);
    const SpringNetwork now = build(rest.kind, mesh_of_frame(input, frame), rest.length);
    const double duration = h * d.substeps;
    for (std::size_t i = 0; i < rest.sticks(); ++i) {
      const std::uint32_t point = rest.point[i];
      const glm::dvec3 a(from[point]), u = (glm::dvec3(to[point]) - a) / duration, n(now.normal[i]);
      const auto acceleration = [&](double t, glm::dvec3 p, glm::dvec3 v) {
        const glm::dvec3 q = p - (a + t * u), s = glm::normalize(q);
        const double pull = double(d.springs.stiffness) * (glm::length(q) - length) +
                            double(d.springs.damping) * glm::dot(v - u, s);
        return glm::dvec3(d.gravity) +
               (c * (air - v) - pull * s + double(d.springs.return_weight) * (1 - glm::dot(n, s)) * (n - s)) /
                   m;
      };
      for (int step = 0; step < d.substeps; ++step) {
        const double t = step * h;
        const glm::dvec3 p = place[i], v = speed[i];
        const glm::dvec3 a1 = acceleration(t, p, v), v2 = v + h / 2 * a1;
        const glm::dvec3 a2 = acceleration(t + h / 2, p + h / 2 * v, v2), v3 = v + h / 2 * a2;
        const glm::dvec3 a3 = acceleration(t + h / 2, p + h / 2 * v2, v3), v4 = v + h * a3;
        const glm::dvec3 a4 = acceleration(t + h, p + h * v3, v4);
        place[i] = p + h / 6 * (v + 2.0 * v2 + 2.0 * v3 + v4);
        speed[i] = v + h / 6 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
      }
    }
  }
  Points offset;
  const std::vector<glm::vec3> last = skin(frames - 1);
  for (std::size_t i = 0; i < rest.sticks(); ++i)
    offset.push_back(place[i] - glm::dvec3(last[rest.point[i]]));
  return offset;
}

// Runge-Kutta schemes commute with a change to a frame of constant velocity, so only rounding differs: the
// forces on the tops are rounded to floats.
TEST(MovingSkin, SticksFollowNewtonsLawInTheWorld) {
  const FrameInput input = deforming_sphere(Kind::sticks, Solver::rk4, 8);
  for (const int frames : {1, 2, 5, 30}) {  // the last frame of the mesh stays from picture 8 on
    const SomeSticks found = some_reference_sticks(input, frames, 1000);
    EXPECT_LT(largest_difference(found.offset, tops_in_the_world(input, frames)),
              tolerance::float_records * double(fur_length))
        << frames;
  }
  const SomeSticks moved = some_reference_sticks(input, 5, 1000);
  FrameInput still = input;
  still.mesh = std::make_shared<Mesh>(mesh_of_frame(input, 0));
  EXPECT_GT(largest_difference(moved.offset, some_reference_sticks(still, 5, 1000).offset),
            0.1 * double(fur_length));
}

// A skin that stays in one shape is a skin that does not deform.
TEST(MovingSkin, EqualFramesAreNoMotion) {
  for (const Kind kind : kinds) {
    const FrameInput input = deforming_sphere(kind, Solver::rk4, 1);
    FrameInput still = input;
    still.mesh = std::make_shared<Mesh>(mesh_of_frame(input, 0));
    EXPECT_EQ(some_reference_sticks(input, 6, 1000).offset, some_reference_sticks(still, 6, 1000).offset)
        << kind.name;
  }
}

// The fur stands upright on the last shape after some time, if neither weight nor air pulls at it: the rest
// lengths of the springs between tops are those of the shape.
TEST(MovingSkin, FurComesToRestUprightOnTheLastShape) {
  for (const Kind kind : kinds) {
    FrameInput input = deforming_sphere(kind, Solver::rk4, 4);
    input.scene.dynamics.gravity = {0, 0, 0};
    input.scene.dynamics.wind.strength = 0;
    const SomeSticks found = some_reference_sticks(input, 1200, 1000);
    const SpringNetwork last = moved_sticks(input, network_of(input), 3).network;
    std::vector<glm::dvec3> upright;
    for (const std::uint32_t stick : found.stick)
      upright.push_back(double(fur_length) * glm::dvec3(last.normal[stick]));
    EXPECT_LT(largest_difference(found.offset, upright), 0.05 * double(fur_length)) << kind.name;
  }
}

TEST(MovingSkin, RepeatsOrHoldsTheFrames) {
  FrameInput input = deforming_sphere(Kind::sticks, Solver::rk4, 3);
  const auto shows = [&](int drawn, std::size_t frame) {
    EXPECT_EQ(mesh_of_frame(input, drawn).position, input.mesh->frames[frame]) << drawn;
  };
  shows(-1, 0), shows(0, 0), shows(1, 1), shows(2, 2), shows(3, 2), shows(100000, 2);
  EXPECT_EQ(skin_velocity(input, 0), Points(42, glm::dvec3(0)));
  EXPECT_EQ(skin_velocity(input, 3), Points(42, glm::dvec3(0)));
  EXPECT_NE(skin_velocity(input, 1), Points(42, glm::dvec3(0)));
  input.scene.mesh.after_frames = "repeat";
  shows(3, 0), shows(4, 1), shows(300000, 0);
}

}  // namespace
}  // namespace pelage::springs
