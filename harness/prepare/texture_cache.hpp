// A cache on disk for textures that take long to compute. The files are in cache_folder()/textures and have
// at most 512 MiB.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

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
