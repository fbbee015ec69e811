// The OpenCL programs that draw and simulate strands. The classes of this folder build the programs of these
// texts. The kernels of a program are specialized by build options, because a test that the compiler
// removes costs nothing in the loop over the fragments.
#pragma once
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/scene/scene.hpp"
#include "harness/strands/chain/chain.hpp"
#include "harness/strands/drawing/drawing.hpp"

namespace pelage::strands {

/// How the work-items of a device draw a picture. `item`: a work-item draws a tile, for CPUs. `group`: a
/// work-group draws a tile, for GPUs. `standard`: the device's default.
enum class Drawing { standard, item, group };

struct DrawerOptions {
  Drawing mapping = Drawing::standard;
  int lanes = 0;  ///< strands that a work-item computes at a time: 1 or 16; 0: the device's default
  /// Lanes of Drawing::item: 8 or 16; 0: the device's default. On processors without AVX-512, 16 means 8.
  int tile_lanes = 0;
  int runs = 0;    ///< number of runs of the sort; 0: the device's default (harness/cl/radix_sort.hpp)
  int chunks = 0;  ///< number of chunks of the sorted list, 1 to 65536; 0: the device's default
  /// Width and height of a tile in pixels: 16, 32, 64 or 128; 0: the default. Drawing::group needs 16.
  int tile = 0;
};

/// The kinds of light and of strands that the kernels of a picture must compute.
struct PictureKinds {
  bool lights = false;  ///< the look has more than a key light and ambient light
  bool styles = false;  ///< has_styles() of keyed.hpp
  bool layers = false;  ///< has_layer_looks() of drawing.hpp
  Shadow shadow = Shadow::none;
  bool shapes = false;  ///< the strands have shapes (DrawingScene::shapes)
  bool operator==(const PictureKinds&) const = default;
};

/// The side, in pixels, of the blocks of a tile whose side is `tile` pixels (BLOCK_SIDE in params.h).
constexpr int block_side(int tile) {
  return tile == 128 ? 8 : 4;
}

/// How the work-items of a device draw a picture. Every value is chosen: none is 0.
struct DrawerLayout {
  bool group = false;  ///< the mapping is Drawing::group
  int tile = 0, lanes = 0, tile_lanes = 0;
};

/// Throws InputError if an option is not valid. `width` and `height`: size of the picture in pixels.
DrawerLayout layout_of(const cl::DeviceInfo& device, int width, int height, const DrawerOptions& options);

/// The layout of the opacity map for pictures with the layout `picture`.
DrawerLayout map_layout(const DrawerLayout& picture);

/// The programs that compute the strands' curves and sort keys, list the strands of each tile, and draw the
/// tiles: of a picture, or of an opacity map if `map` is true. `skin`: the picture has a skin.
struct PictureTexts {
  cl::ProgramText keys, lists, draw;
};
PictureTexts picture_texts(const PictureKinds& kinds, const DrawerLayout& layout, bool map, bool skin);

/// The program that draws the skin.
cl::ProgramText skin_text(const PictureKinds& kinds, int lanes);

/// The program that simulates chains. `follows`: the roots follow the frames of a mesh. `own_damping`:
/// has_own_damping() of the chains.
cl::ProgramText chain_text(const ChainDynamics& dynamics, int lanes, bool follows, bool own_damping);

/// The program that converts chains to key strands.
cl::ProgramText chain_keys_text(int lanes);

/// The program that pushes strands out of the colliders.
cl::ProgramText chain_contact_text(const ContactScene& contact, int lanes);

/// Returns the programs that Strands will need for this scene, in the order of their first use. `device` is
/// the device on which the scene is drawn. Throws InputError if an option is not valid.
std::vector<cl::ProgramText> expected_programs(const cl::Device& device, const Scene& scene,
                                               const DrawerOptions& options);

}  // namespace pelage::strands
