// A cache on disk for grown fur. The files are in cache_folder()/fur and have at most 512 MiB.
#pragma once
#include "harness/strands/groom/fur.hpp"

namespace pelage::strands {

/// Version of the code that grows fur. The name of every cache file contains it. Increase it whenever a
/// change of the code changes the fur. tests/strands/groom/fur_cache_test.cpp detects such changes by a hash.
constexpr int fur_recipe = 3;

/// Returns the same fur as grow(). Reads it from the cache if it was grown before for the same mesh, coat and
/// fur layers, including the content of their pictures. Grows it again if the cache file is damaged. If the
/// cache folder is not writable, or if the mesh has no hash, every call grows the fur.
Fur kept_fur(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat);

}  // namespace pelage::strands
