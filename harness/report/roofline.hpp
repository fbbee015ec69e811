// Where a frame's time goes: its kernels' times, bytes and operations against what the device can do at best.
#pragma once
#include <string>
#include <vector>

namespace pelage {

/// A kernel within a frame.
struct KernelWork {
  std::string kernel, phase;
  double ms = 0;          ///< median over frames of its events, all launches of a frame together
  double bytes = 0;       ///< of the buffers it is given, each counted once
  double operations = 0;  ///< floating-point, of the equations; 0 where there are none
};

struct FrameWork {
  std::string name;      ///< of the case
  double triangles = 0;  ///< of the mesh
  double frame_ms = 0;   ///< median wall time
  double covered = 0, shaded = 0, blended = 0;
  std::vector<KernelWork> kernels;
};

/// What `pelage devices --measure` says of the device.
struct Ceilings {
  std::string device;
  double gb_s = 0, gflop_s = 0;
};

/// Operations per second that the two ceilings allow a kernel of this intensity (operations per byte), 1e9/s.
double allowed_gflop_s(const Ceilings& ceilings, double intensity);

/// For a terminal: a table of frames, then one of kernels.
std::string text_of(const std::vector<FrameWork>& frames, const Ceilings& ceilings);
/// One line per case and kernel, for programs and for plots/roofline.py.
std::string csv_of(const std::vector<FrameWork>& frames, const Ceilings& ceilings);

}  // namespace pelage
