// The shell pipeline on an OpenCL device: simulate -> wet -> transform -> bin -> raster.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/cl/device.hpp"
#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Returns the names of all mappings. A mapping is a way to assign the pixels of a frame to work-items.
const std::vector<std::string>& mappings();
/// Returns "name: description; ..." of all mappings, for --help.
std::string mappings_help();

/// Returns the name of the device's default mapping.
std::string default_mapping(const cl::DeviceInfo& device);

struct ShellOptions {
  std::string mapping;                ///< one of mappings(); "": default_mapping() of the device
  std::map<std::string, int> tuning;  ///< values of tuning axes (kernels/*/tuning.toml), e.g. {"TILE_W", 16}
  int layers_at_once = 0;             ///< layers drawn in one pass; 0: as many as fit in memory
};

/// Numbers of fragments of a frame in all layers, without the base surface.
struct Tally {
  std::uint64_t covered = 0;  ///< covered fragments, visible or not
  std::uint64_t shaded = 0;   ///< covered, not behind the base, in a pixel that is not yet opaque
  std::uint64_t blended = 0;  ///< shaded and with a coverage above 0: lit and blended
};

/// One kernel launch of a frame.
struct KernelTime {
  std::string kernel, phase;
  double ms = 0;
  std::size_t bytes = 0;  ///< total size of the kernel's buffers, each counted once
};

/// The times of one frame, in milliseconds. Event times are empty if the device's timer is not reliable.
struct FrameTiming {
  double wall_ms = 0;                            ///< from the first enqueue until the queue has finished
  std::map<std::string, double> phase_event_ms;  ///< sums for simulate, transform, bin and raster
  std::vector<KernelTime> kernels;               ///< in launch order; empty if phase_event_ms is empty
};

/// A scene on a device. The constructor uploads the scene, builds the kernels and computes the wetness mask.
/// frame() advances the strands by scene.dynamics.substeps substeps and draws one picture, which stays on the
/// device until read().
class Shells {
 public:
  Shells(const cl::Device& device, std::shared_ptr<const FrameInput> input, const ShellOptions& options = {});
  ~Shells();
  Shells(Shells&&) noexcept;
  Shells& operator=(Shells&&) noexcept;

  // frame() and advance() throw springs::Diverged if masses of a mass-spring topology have diverged.
  FrameTiming frame();                        ///< simulates and draws one frame, and times it
  void advance(int frames);                   ///< advances the strands without drawing
  Picture read() const;                       ///< reads the picture of the last frame back
  int frames_simulated() const;               ///< number of frames since rest, including the last one
  std::vector<glm::vec4> mask() const;        ///< wetness.size^2: c_u, c_v, r, rho
  std::vector<glm::vec3> tips() const;        ///< tip minus root per strand, or top minus base per stick, R
  std::vector<glm::vec3> velocities() const;  ///< velocities of the tips, R/s
  /// Counts the fragments of the last frame in all layers. It draws the frame again with the pixel mapping,
  /// in about one pixel of `every` chosen at random, and multiplies the counts by `every`. With every = 1 the
  /// counts are exact and slow to compute. 0 selects about 8192 pixels, for an error of about 1%.
  Tally tally(int every = 0);
  /// Returns the number of floating-point operations in the last frame by kernel name. `wet_share` is the wet
  /// share of the surface, 0 to 1.
  std::map<std::string, double> operations(const Tally& tally, double wet_share) const;
  std::uint64_t count();    ///< number of covered fragments of the last frame in all layers
  double build_ms() const;  ///< build time of all kernels, ms
  double wet_ms() const;    ///< time of Algorithm 1, ms
  /// Wall time, in ms, of the kernels that run once per mask, measured after a warm-up run: dryness and curl
  /// frames of the vertices, reach of the triangles. A frame's time does not include it.
  double per_mask_ms() const;
  std::string kernel_hash() const;  ///< hash of the sources of all built programs with their includes

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pelage
