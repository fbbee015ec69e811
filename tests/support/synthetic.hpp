// Frame inputs computed by formulas. Tests need no mesh file and no preparation stage.
#pragma once
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "harness/prepare/frame_input.hpp"

namespace pelage::synthetic {

/// A surface over the unit square of UV. The cross product of its derivatives by u and v points outwards.
struct Surface {
  std::function<glm::dvec3(double u, double v)> point;
  bool periodic = false;  ///< in u and v: opposite borders are welded
};

/// A square of side `side` in the plane z = 0, facing +z, with u along x and v along y.
Surface square(double side);
/// A torus whose bounding sphere has radius 1; u runs around its axis (y), v around its tube.
Surface torus();

/// A grid of nu x nv quads over the surface, two triangles per quad. A periodic surface has copies of the
/// vertices on its borders.
Mesh grid(const Surface& surface, int nu, int nv);

/// Returns the input of a frame of `scene` on the grid: strands (combed by scene.fur.comb), curl frame,
/// tangents, a fur texture of upright cones with mips, a coat of smooth noise, `droplets` random droplets,
/// mask surface, fur scale and the camera. The scene's keys for strands per slice, coat pattern and random
/// droplets have no effect.
FrameInput frame(const Scene& scene, const Surface& surface, int nu, int nv, int droplets);

/// A scene of 16 layers and 160 x 100 pixels with combed, curly, wet and windy fur.
Scene lively_scene();

/// Returns the camera of a scene whose key `framed` is false.
Camera camera(const CameraScene& scene, int width, int height);

/// Returns a number in [0, 1) that depends only on the three arguments.
double noise(std::uint32_t a, std::uint32_t b, std::uint32_t c);

}  // namespace pelage::synthetic
