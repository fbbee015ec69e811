// The names of two ways to draw a picture on a device. Shells and strands have both.
#pragma once
#include <string_view>

namespace pelage::cl {

inline constexpr std::string_view item_mapping = "tile";    ///< a work-item draws a tile, for CPUs
inline constexpr std::string_view group_mapping = "group";  ///< a work-group draws a tile, for GPUs

}  // namespace pelage::cl
