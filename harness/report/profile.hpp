// The times of the kernels of a frame, as text for a terminal and as CSV.
#pragma once
#include <string>
#include <vector>

namespace pelage {

/// A kernel within a frame.
struct KernelWork {
  std::string kernel, phase;
  double ms = 0;     ///< sum of the event times of the kernel's launches in a frame, median over frames
  double bytes = 0;  ///< size of the kernel's buffers, summed over the launches in a frame
};

struct FrameWork {
  std::string name;                 ///< name of the case
  double triangles;                 ///< number of triangles of the mesh
  double frame_ms;                  ///< median wall time
  double covered, shaded, blended;  ///< numbers of fragments
  std::vector<KernelWork> kernels;
};

/// The device and its memory bandwidth (triad), as `pelage devices --measure` reports it.
struct Bandwidth {
  std::string device;
  double gb_s;
};

/// Returns text for a terminal.
std::string text_of(const std::vector<FrameWork>& frames, const Bandwidth& bandwidth);
/// Returns CSV with one line per case and kernel. The program plots/profile.py reads this CSV.
std::string csv_of(const std::vector<FrameWork>& frames, const Bandwidth& bandwidth);

}  // namespace pelage
