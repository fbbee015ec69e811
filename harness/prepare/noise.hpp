// Smooth random functions of the position in space. Their values on a surface are continuous across UV seams.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

namespace pelage {

/// Returns value noise in [-1, 1] with continuous second derivatives. Its features have a size of about one
/// unit.
double noise(glm::dvec3 p, std::uint32_t seed);

/// Returns a sum of three octaves of noise(), in [-1, 1].
double fractal_noise(glm::dvec3 p, std::uint32_t seed);

/// Returns a vector of three independent values of noise().
glm::dvec3 noise3(glm::dvec3 p, std::uint32_t seed);

}  // namespace pelage
