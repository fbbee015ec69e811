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

/// Names of the ways to spread a frame's pixels over a device's work-items.
const std::vector<std::string>& mappings();
/// "name: what it does; ..." of all of them, for --help.
std::string mappings_help();

/// The name of the one that suits the device.
std::string default_mapping(const cl::DeviceInfo& device);

struct ShellOptions {
  std::string mapping;                ///< one of mappings(); "": default_mapping() of the device
  std::map<std::string, int> tuning;  ///< -D axes of kernels/*/tuning.toml, e.g. {"TILE_W", 16}
  int layers_at_once = 0;             ///< drawn in one pass; 0: as many as the memory for passes holds
};

/// Fragments of a frame's layers, the base apart.
struct Tally {
  std::uint64_t covered = 0;  ///< whether seen or not
  std::uint64_t shaded =
      0;  ///< not behind the base, and the pixel was not opaque yet: clump and fur are looked up
  std::uint64_t blended = 0;  ///< of those, where fur grows: they are lit and drawn
};

/// A kernel's launch within a frame.
struct KernelTime {
  std::string kernel, phase;
  double ms = 0;
  std::size_t bytes = 0;  ///< of all the buffers it was given, each counted once
};

/// What one frame cost. Milliseconds; event times are absent (empty) where the device's timer cannot be
/// trusted.
struct FrameTiming {
  double wall_ms = 0;                            ///< first enqueue to finish
  std::map<std::string, double> phase_event_ms;  ///< simulate, transform, bin, raster
  std::vector<KernelTime> kernels;               ///< in their order; empty where those are
  std::uint64_t covered_fragments = 0;           ///< of all layers; counted only on request (count())
};

/// A scene on a device. Construction uploads, builds the kernels and makes the wetness mask; frame() advances
/// the strands by scene.dynamics.substeps and draws one picture that stays on the device until read().
class Shells {
 public:
  Shells(const cl::Device& device, std::shared_ptr<const FrameInput> input, const ShellOptions& options = {});
  ~Shells();
  Shells(Shells&&) noexcept;
  Shells& operator=(Shells&&) noexcept;

  // Both throw springs::Diverged where a topology's masses flew apart: nothing is drawn from those.
  FrameTiming frame();                  ///< one timed frame
  void advance(int frames);             ///< strands only
  Picture read() const;                 ///< the last frame's own buffer
  int frames_simulated() const;         ///< frames since rest, the last one included
  std::vector<glm::vec4> mask() const;  ///< wetness.size^2: c_u, c_v, r, rho
  std::vector<glm::vec3> tips() const;  ///< F, p minus root; of a topology one per stick, top minus base
  std::vector<glm::vec3> velocities() const;  ///< of the tips, R/s
  /// Fragments of the last frame, all layers, from one pixel in `every`, spread at random: an extra pass,
  /// pixel by pixel. 1: exact, and slow; 0: as many as leave about 8192 pixels, for an error of about 1%.
  Tally tally(int every = 0);
  /// Floating-point operations of the last frame's kernels by name; `wet_share` of the surface is wet.
  std::map<std::string, double> operations(const Tally& tally, double wet_share) const;
  std::uint64_t count();    ///< covered fragments of the last frame, all layers (an extra, untimed pass)
  double build_ms() const;  ///< kernel builds
  double wet_ms() const;    ///< Algorithm 1
  /// Kernels that run once per mask outside of the frame, warm: dryness and curl frames of vertices, reach of
  /// triangles.
  double per_mask_ms() const;
  std::string kernel_hash() const;  ///< of the sources of all programs that were built, includes and all

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pelage
