// Times, bytes and operations of a frame's kernels, compared with the peak rates of the device.
#pragma once
#include <string>
#include <vector>

namespace pelage {

/// A kernel within a frame.
struct KernelWork {
  std::string kernel, phase;
  double ms = 0;          ///< median over frames of its events, all launches of a frame together
  double bytes = 0;       ///< of the kernel's buffers, each counted once
  double operations = 0;  ///< floating-point, of the equations; 0 without any
};

struct FrameWork {
  std::string name;      ///< of the case
  double triangles = 0;  ///< of the mesh
  double frame_ms = 0;   ///< median wall time
  double covered = 0, shaded = 0, blended = 0;
  std::vector<KernelWork> kernels;
};

/// The peak rates that `pelage devices --measure` reports.
struct Ceilings {
  std::string device;
  double gb_s = 0, gflop_s = 0;
};

/// Returns the rate that the two ceilings allow a kernel of this intensity (operations per byte), 1e9
/// operations per second.
double allowed_gflop_s(const Ceilings& ceilings, double intensity);

/// Returns text for a terminal: a table of frames, then a table of kernels.
std::string text_of(const std::vector<FrameWork>& frames, const Ceilings& ceilings);
/// Returns one line per case and kernel, for programs and for plots/roofline.py.
std::string csv_of(const std::vector<FrameWork>& frames, const Ceilings& ceilings);

}  // namespace pelage
