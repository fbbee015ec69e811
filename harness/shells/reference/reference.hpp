// The reference renderer. It draws the frame of docs/frame.md in double precision, with N passes over the
// mesh, back to front. It is written for clarity, not for speed, and shares no code with kernels/.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

using pelage::Window;

/// Deliberate mistakes in the reference. Only tests use them, to check that a comparison of pictures detects
/// each mistake.
enum class Mutant {
  none,
  layer_missing,       ///< layer N/2 is not drawn
  height_without_one,  ///< h = n/N instead of (1+n)/N
  triangles_reversed,  ///< triangles are drawn in reverse order in each layer
  front_faces_culled,  ///< layers omit triangles for which Raster::faces_eye() is true
  uv_swapped,          ///< u and v are swapped in every texture lookup of a fragment
  mask_bilinear,       ///< the wetness mask is sampled bilinearly
  droplets_reversed,   ///< Algorithm 1 applies the droplets from last to first
  log_negated,         ///< k = -ln N in S Eq. 5, as the paper prints it
  sticks_straight,     ///< k = 1 in B Eq. 4, so that layers lie along the stick
  corners_turned,      ///< each corner of a triangle uses the stick of the next corner
};

struct Options {
  int frames = 0;               ///< number of frames of strand motion since rest
  bool eight_bit = false;       ///< round the framebuffer to 8 bits after every layer, as GPUs did in 2010
  std::vector<Window> windows;  ///< the parts of the picture to draw; empty: the whole picture
  /// The sticks of a scene with a mass-spring topology, used in place of `frames`: top minus base, in R, per
  /// surface point, or per triangle corner if the topology is separable.
  /// harness/springs/reference/reference.hpp computes their motion. If empty, the sticks are at rest.
  std::vector<glm::dvec3> sticks;
  Mutant mutant = Mutant::none;
};

/// Draws a picture of the camera's size on two threads. Pixels outside `windows` have the background colour
/// and alpha 0. Only strands and triangles that a window can show are computed, so a few small windows of a
/// large scene are fast. Throws InputError if the sizes of the input's arrays do not match.
Picture render(const FrameInput& input, const Options& options);

}  // namespace pelage::reference
