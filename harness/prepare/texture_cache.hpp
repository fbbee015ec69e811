// Textures that take long to make, kept on disk between runs (cache_folder()/textures, half a GiB at most).
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Part of every file's name: raise it whenever the same scene would give another texture. A test knows the
/// bytes that belong to it.
constexpr int texture_recipe = 1;

/// make_fur_texture, make_coat and surface_map, or what they gave before for the same scene and mesh. A file
/// that is damaged is made again; a folder that cannot be written costs time only. Coats from pictures are
/// not kept.
FurTexture kept_fur_texture(const FurScene& fur);
CoatTexture kept_coat(const Mesh& mesh, const CoatScene& coat);
std::vector<glm::vec3> kept_surface_map(const Mesh& mesh, int size);

}  // namespace pelage
