// A cache on disk for textures that take long to compute (cache_folder()/textures, at most 512 MiB).
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Version of the texture generators, part of every cache file's name. Increase it after a change of the code
/// that changes a texture. A test compares the textures with stored hashes.
constexpr int texture_recipe = 1;

/// These functions return the same results as make_fur_texture(), make_coat() and surface_map(). They read a
/// result from the cache if it was computed before for the same scene and mesh. A result whose cache file is
/// damaged is computed again. If the cache folder is not writable, every run computes the textures. Coats
/// from pictures are not cached.
FurTexture kept_fur_texture(const FurScene& fur);
CoatTexture kept_coat(const Mesh& mesh, const CoatScene& coat);
std::vector<glm::vec3> kept_surface_map(const Mesh& mesh, int size);

}  // namespace pelage
