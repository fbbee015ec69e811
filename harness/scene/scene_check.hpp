// Checks of single values of a scene, used by parse_scene() and check_scene().
#pragma once
#include <string>
#include <vector>

#include "harness/scene/scene_keys.hpp"

namespace pelage {

/// Returns the error text for the value of a key, for instance "7 is out of range; give 2 to 5"; empty if the
/// key permits the value. `values` are the components of one value.
std::string complaint(const Key& key, const std::vector<double>& values);
std::string complaint(const Key& key, const std::string& value);

/// Greatest permitted number of fur texels, layers * texture^2. At 2 bytes per texel, this number of texels
/// needs 512 MiB.
inline constexpr long most_fur_texels = 1L << 28;
/// Greatest permitted number of pixels, width * height. At 4 floats per pixel, this number of pixels needs
/// 1 GiB.
inline constexpr long most_pixels = 1L << 26;
/// Greatest permitted number of frames that are simulated before the first picture.
inline constexpr long most_frames = 1000000;

}  // namespace pelage
