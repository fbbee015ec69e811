// Frame inputs computed by formulas. Tests that use them need no mesh file and no preparation stage.
#pragma once
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "harness/prepare/frame_input.hpp"

namespace pelage::synthetic {

/// A surface over the unit square of UV. The cross product of its derivatives by u and by v points outwards.
struct Surface {
  std::function<glm::dvec3(double u, double v)> point;
  bool periodic = false;  ///< true: u and v are periodic, and opposite borders are welded
};

/// A square with sides of length `side` in the plane z = 0. It faces +z; u runs along x, and v along y.
Surface square(double side);
/// A torus whose bounding sphere has radius 1. u runs around the axis of the torus (y), and v around its
/// tube.
Surface torus();

/// Returns a grid of nu x nv quads over the surface, with two triangles per quad. On a periodic surface, a
/// point on a border has a vertex on the opposite border, too.
Mesh grid(const Surface& surface, int nu, int nv);

/// Returns the complete input of a frame of `scene` with a grid of nu x nv quads, upright cones as fur, a
/// smooth coat and `droplets` random droplets. The keys of the scene for the number of strands and of random
/// droplets and for the pattern of the coat have no effect.
FrameInput frame(const Scene& scene, const Surface& surface, int nu, int nv, int droplets);

/// Returns a scene of 16 layers and 160 x 100 pixels with combed, curly, wet and windy fur.
Scene lively_scene();

/// Returns lively_scene() without comb, curl, gravity and wind.
Scene upright_scene();

/// Returns the camera that `scene` describes. The key `framed` is ignored, as if it were false.
Camera camera(const CameraScene& scene, int width, int height);

/// Returns a pseudorandom number in [0, 1) that depends only on the three arguments.
double noise(std::uint32_t a, std::uint32_t b, std::uint32_t c);

/// A reproducible sequence of numbers in [-1, 1).
struct Any {
  std::uint32_t seed, count = 0;
  double operator()() { return 2 * noise(seed, count++, 31) - 1; }
  glm::dvec3 vector() { return {(*this)(), (*this)(), (*this)()}; }
  glm::dvec3 direction() { return glm::normalize(vector()); }
};

}  // namespace pelage::synthetic
