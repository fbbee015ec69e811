// A skin that moves and deforms, for the tests in tests/springs.
#pragma once
#include <cmath>
#include <memory>

#include "harness/prepare/frame_input.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs::test {

/// Returns a sphere of 42 points with `count` frames, as the input of a frame without textures. The sphere
/// travels, turns and swells. The air is in a steady wind.
inline FrameInput deforming_sphere(Kind kind, Solver solver, int count) {
  Mesh mesh = sphere(1);
  for (int k = 0; k < count; ++k) {
    std::vector<glm::vec3> frame;
    const double a = 0.05 * k, swell = 1 + 0.02 * k;
    for (const glm::vec3& p : mesh.position)
      frame.emplace_back(swell * (std::cos(a) * p.x - std::sin(a) * p.y) + 0.01 * k * k,
                         std::sin(a) * p.x + std::cos(a) * p.y - 0.005 * k, p.z + 0.03 * k * p.x * p.x);
    mesh.frames.push_back(frame);
  }
  mesh.position = mesh.frames.front();
  FrameInput input;
  input.scene.fur.length = fur_length;
  DynamicsScene& d = input.scene.dynamics;
  d.topology = std::string(kind.name);
  d.solver = std::string(solver.name);
  d.step = solver == Solver::explicit_euler ? 1e-3f : 1.0f / 240;
  d.substeps = solver == Solver::explicit_euler ? 16 : 4;
  d.mass = 1e-3f;
  d.drag = 0.004f;
  d.gravity = {0, -9.81f, 0};
  d.wind.direction = {1, 0.2f, 0.5f};
  d.wind.strength = 0.012f;
  d.wind.gust = 0;
  input.mesh = std::make_shared<Mesh>(std::move(mesh));
  return input;
}

}  // namespace pelage::springs::test
