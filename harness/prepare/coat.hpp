// The colour of the fur as a function of the position on the surface, and a cache on disk for textures that
// take long to compute. The files are in cache_folder()/textures and have at most 512 MiB.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Returns the coat's colours as a texture in UV space. They come from a picture or a pattern. A pattern is a
/// function of the position in space and therefore has no seams. Throws InputError for an unknown pattern or
/// an unreadable picture.
CoatTexture make_coat(const Mesh& mesh, const CoatScene& coat);

/// Returns the coat's colour at `uv`, each component 0 to 1. The value is interpolated linearly between the
/// centres of the texels. The texture repeats.
glm::dvec3 coat_colour(const CoatTexture& coat, glm::dvec2 uv);

/// Returns size x size surface points, in R (the mesh radius). Row j of the result is at v = (j+.5)/size. A
/// texel whose centre is in no UV triangle gets the point of the nearest covered texel. Distances are
/// measured in UV. If the UV map is periodic, distances wrap around the unit square.
std::vector<glm::vec3> surface_map(const Mesh& mesh, int size);

/// Version of the texture generators. The name of every cache file contains it. Increase it whenever a change
/// of the code changes a texture. tests/prepare/texture_cache_test.cpp detects such changes by the hashes of
/// three textures.
constexpr int texture_recipe = 1;

/// These functions return the same results as make_fur_texture(), make_coat() and surface_map(). They read a
/// result from the cache if it was computed before for the same scene and mesh. A result whose cache file is
/// damaged is computed again. If the cache folder is not writable, every run computes the textures. Coats
/// from pictures are not cached.
FurTexture kept_fur_texture(const FurScene& fur);
CoatTexture kept_coat(const Mesh& mesh, const CoatScene& coat);
std::vector<glm::vec3> kept_surface_map(const Mesh& mesh, int size);

}  // namespace pelage
