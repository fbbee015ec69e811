// Compares the times, bytes and operations of a frame's kernels with the peak rates of the device (roofline
// model).
#pragma once
#include <string>
#include <vector>

namespace pelage {

/// A kernel within a frame.
struct KernelWork {
  std::string kernel, phase;
  double ms = 0;          ///< sum of the event times of the kernel's launches in a frame, median over frames
  double bytes = 0;       ///< size of the kernel's buffers, summed over the launches in a frame
  double operations = 0;  ///< floating-point operations of the kernel in a frame; 0 if not counted
};

struct FrameWork {
  std::string name;                             ///< name of the case
  double triangles = 0;                         ///< number of triangles of the mesh
  double frame_ms = 0;                          ///< median wall time
  double covered = 0, shaded = 0, blended = 0;  ///< numbers of fragments
  std::vector<KernelWork> kernels;
};

/// The device's peak rates, as `pelage devices --measure` reports them.
struct Ceilings {
  std::string device;
  double gb_s = 0, gflop_s = 0;
};

/// Returns the highest possible rate of a kernel with `intensity` operations per byte, in 1e9 operations per
/// second. This is the smaller one of two rates: the arithmetic peak, and the intensity times the bandwidth.
double allowed_gflop_s(const Ceilings& ceilings, double intensity);

/// Returns text for a terminal: a table of frames, then a table of kernels.
std::string text_of(const std::vector<FrameWork>& frames, const Ceilings& ceilings);
/// Returns CSV with one line per case and kernel. The program plots/roofline.py reads this CSV.
std::string csv_of(const std::vector<FrameWork>& frames, const Ceilings& ceilings);

}  // namespace pelage
