// What is wrong with a value, in words; used while reading and by check_scene.
#pragma once
#include <string>
#include <vector>

#include "harness/scene/scene_keys.hpp"

namespace pelage {

/// Empty when the numbers (all components of one value) or the string suit the key; else "7 is out of range;
/// give ...".
std::string complaint(const Key& key, const std::vector<double>& values);
std::string complaint(const Key& key, const std::string& value);

inline constexpr long most_fur_texels = 1L << 28;  ///< layers x texture^2: half a gigabyte
inline constexpr long most_pixels = 1L << 26;      ///< width x height: a gigabyte of floats
inline constexpr long most_frames = 1000000;       ///< simulated before the first picture

}  // namespace pelage
