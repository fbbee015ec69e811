// The same picture by the naive road: double precision, N passes over the mesh, back to front, written from
// the papers and docs/frame.md. Slow and plain on purpose; shares no line with kernels/.
#pragma once
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

using pelage::Window;

struct Options {
  int frames = 0;               ///< frames of strand motion since rest before the picture is drawn
  bool eight_bit = false;       ///< round the framebuffer to 8 bits after every layer, as a 2010 GPU did
  std::vector<Window> windows;  ///< draw only these; empty: the whole picture
};

Picture render(const FrameInput& input, const Options& options);

}  // namespace pelage::reference
