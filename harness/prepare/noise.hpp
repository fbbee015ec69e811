// Smooth random functions of space. Evaluated on surface points, they know nothing of UV seams.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

namespace pelage {

/// Value noise in [-1, 1], C2, features about one unit across.
double noise(glm::dvec3 p, std::uint32_t seed);

/// Three octaves of it, in [-1, 1].
double fractal_noise(glm::dvec3 p, std::uint32_t seed);

/// Three independent noises.
glm::dvec3 noise3(glm::dvec3 p, std::uint32_t seed);

}  // namespace pelage
