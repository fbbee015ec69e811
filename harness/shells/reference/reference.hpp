// The reference renderer. It draws the frame that docs/shells.md defines, in double precision. It draws the
// mesh once per layer, from the innermost layer to the outermost. It is written for clarity, not for speed,
// and shares no code with kernels/. docs/shells.md defines the symbols and the papers S, W and B.
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
  front_faces_culled,  ///< mistake: layers omit the triangles that face the eye
  uv_swapped,          ///< u and v are swapped in every texture lookup of a fragment
  mask_bilinear,       ///< the wetness mask is sampled bilinearly
  droplets_reversed,   ///< the droplets are blended into the mask from last to first
  log_negated,         ///< mistake: k = -ln N in S Eq. 5, as printed in S; the correct value is k = ln N
  tangent_reversed,    ///< mistake: the clump's term in W Eq. 4 has the opposite sign
  eye_reversed,        ///< mistake: E points from the surface to the eye
  facing_swapped,      ///< mistake: triangles that face the eye count as those that face away
  sticks_straight,     ///< k = 1 in B Eq. 4, so that layers lie along the stick
  corners_turned,      ///< mistake: corner c of a triangle uses the stick of corner (c + 1) % 3
};

struct Options {
  int frames = 0;               ///< number of frames for which the strands move, from rest
  bool eight_bit = false;       ///< round the framebuffer to 8 bits after every layer, as GPUs did in 2010
  std::vector<Window> windows;  ///< the parts of the picture to draw; empty: the whole picture
  /// The sticks of a mass-spring topology, each as the vector from its base to its top. The unit is the
  /// radius of the mesh's bounding sphere. There is one stick per surface point, or one per triangle corner
  /// if the topology is "separable-sticks" or "separable-prisms". The renderer does not simulate sticks;
  /// harness/springs/reference/reference.hpp computes their motion. If `sticks` is empty, the sticks of the
  /// topology are at rest. In this case `frames` must be 0.
  std::vector<glm::dvec3> sticks;
  Mutant mutant = Mutant::none;
};

/// Draws a picture with the width and height of input.camera, on two threads. Pixels outside options.windows
/// have the background colour and alpha 0. Strands and triangles that cannot be visible in a window are not
/// computed, so a few small windows of a large scene take little time. Throws InputError if the sizes of the
/// input's arrays do not match.
Picture render(const FrameInput& input, const Options& options);

/// Throws InputError if the sizes of the input's arrays do not match, or if the options do not fit the input.
void check_input(const FrameInput& input, const Options& options);

}  // namespace pelage::reference
