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

/// Limit of layers * texture^2; 512 MiB at 2 bytes per texel.
inline constexpr long most_fur_texels = 1L << 28;
inline constexpr long most_pixels = 1L << 26;  ///< limit of width * height; 1 GiB at 4 floats per pixel
inline constexpr long most_frames = 1000000;   ///< limit of the frames simulated before the first picture

}  // namespace pelage
