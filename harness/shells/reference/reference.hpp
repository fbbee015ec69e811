// The same picture by the naive road: double precision, N passes over the mesh, back to front, written from
// the papers and docs/frame.md. Slow and plain on purpose; shares no line with kernels/.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

using pelage::Window;

/// Wrong on purpose: mistakes that a comparison with the reference must catch. Tests plant them; nothing else
/// does.
enum class Mutant {
  none,
  layer_missing,       ///< layer N/2 is not drawn
  height_without_one,  ///< h = n/N instead of (1+n)/N
  triangles_reversed,  ///< triangles in reverse order inside every layer
  back_faces_culled,   ///< layers draw only triangles that face the eye
  uv_swapped,          ///< u and v change places in every texture lookup of a fragment
  mask_bilinear,       ///< the wetness mask is interpolated
  droplets_reversed,   ///< Algorithm 1 takes the droplets from last to first
  log_negated,         ///< k = -ln N in S Eq. 5, as printed
  sticks_straight,     ///< k = 1 in B Eq. 4: layers lie along the stick
  corners_turned,      ///< a triangle's corners take each other's sticks
};

struct Options {
  int frames = 0;               ///< frames of strand motion since rest before the picture is drawn
  bool eight_bit = false;       ///< round the framebuffer to 8 bits after every layer, as a 2010 GPU did
  std::vector<Window> windows;  ///< draw only these; empty: the whole picture
  /// Of a scene with a mass-spring topology, in place of `frames`: the tops less their bases, R, per surface
  /// point, or per triangle corner where the topology is separable. Their motion is not this reference's: see
  /// harness/springs/reference/reference.hpp. Empty: at rest.
  std::vector<glm::dvec3> sticks;
  Mutant mutant = Mutant::none;
};

/// Draws the picture of the camera's size. Outside of `windows` it holds the background with alpha 0. Only
/// strands and triangles that a window can see are computed, so a few small windows of a large scene are
/// quick. Two threads. Throws InputError when the input's arrays do not fit each other.
Picture render(const FrameInput& input, const Options& options);

}  // namespace pelage::reference
