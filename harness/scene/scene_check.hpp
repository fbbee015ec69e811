// Checks of single values. Each returns an error text. The reader and check_scene() use them.
#pragma once
#include <string>
#include <vector>

#include "harness/scene/scene_keys.hpp"

namespace pelage {

/// The error text for the value of a key, for instance "7 is out of range; give 2 to 5"; empty if the key
/// permits the value. `values` are the components of one value.
std::string complaint(const Key& key, const std::vector<double>& values);
std::string complaint(const Key& key, const std::string& value);

inline constexpr long most_fur_texels = 1L << 28;  ///< layers x texture^2; 2 bytes each, 512 MiB in all
inline constexpr long most_pixels = 1L << 26;      ///< width x height; 4 floats each, 1 GiB in all
inline constexpr long most_frames = 1000000;       ///< frames simulated before the first picture

}  // namespace pelage
