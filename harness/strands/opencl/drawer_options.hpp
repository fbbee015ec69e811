// Options that change how fast a device draws strands, but not the picture.
#pragma once

namespace pelage::strands {

/// How the work-items of a device draw a picture. `item`: a work-item draws a tile, for CPUs. `group`: a
/// work-group draws a tile, for GPUs. `standard`: the device's default.
enum class Drawing { standard, item, group };

struct DrawerOptions {
  Drawing mapping = Drawing::standard;
  int lanes = 0;  ///< strands that a work-item computes at a time: 1 or 16; 0: the device's default
  /// Lanes of Drawing::item: 8 or 16; 0: the device's default. On processors without AVX-512, 16 means 8.
  int tile_lanes = 0;
  int runs = 0;    ///< number of runs of the sort; 0: the device's default (harness/cl/pair_sort.hpp)
  int chunks = 0;  ///< number of chunks of the sorted list, 1 to 65536; 0: the device's default
  /// Width and height of a tile in pixels: 16, 32, 64 or 128; 0: the default. Drawing::group needs 16.
  int tile = 0;
};

}  // namespace pelage::strands
