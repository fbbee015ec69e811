// Frame inputs made of formulas: no mesh file, no preparation stage between a test and what it tests.
#pragma once
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "harness/prepare/frame_input.hpp"

namespace pelage::synthetic {

/// A surface over the unit square; u x v turns outwards.
struct Surface {
  std::function<glm::dvec3(double u, double v)> point;
  bool periodic = false;  ///< both ways: the borders are welded
};

/// A square of side `side` in the plane z = 0, facing +z, u along x and v along y.
Surface square(double side);
/// Radii chosen so that the bounding sphere has radius 1; u around the axis (y), v around the tube.
Surface torus();

/// A quad grid of nu x nv cells over the surface, two triangles each, one copy of every border vertex.
Mesh grid(const Surface& surface, int nu, int nv);

/// Everything else, from the scene: strands (combed by scene.fur.comb), curl frame, tangents, a fur of
/// upright cones with mips, a coat of smooth noise, `droplets` random droplets, mask surface, fur scale and
/// the camera. What the scene says about recipes (strands per slice, coat pattern, random droplets) is not
/// read.
FrameInput frame(const Scene& scene, const Surface& surface, int nu, int nv, int droplets);

/// A scene of 16 layers and 160 x 100 pixels in which everything happens: combed, curly, wet, windy fur.
Scene lively_scene();

/// The camera of a scene that is not framed.
Camera camera(const CameraScene& scene, int width, int height);

/// A repeatable number in [0, 1) for three whole numbers.
double noise(std::uint32_t a, std::uint32_t b, std::uint32_t c);

}  // namespace pelage::synthetic
