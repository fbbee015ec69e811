// The stages of a frame on a device, each owning its buffers and kernels: simulate, wet, rasterize.
#pragma once
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "harness/shells/opencl/params.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/opencl/work.hpp"

namespace pelage::shells {

/// Events of one frame by phase; read once the queue has finished.
using PhaseEvents = std::vector<std::pair<std::string, cl::Event>>;

/// The axis' value in `tuning`, else `otherwise`.
int tuned(const std::map<std::string, int>& tuning, const std::string& axis, int otherwise);

/// "-D NAME=value ..." for a kernel build.
std::string build_options(int lanes, const std::map<std::string, int>& tuning);

/// How the pixels are spread over a device's work-items.
struct Mapping {
  std::string name, file, kernel;
  int lanes;  ///< of the vertices' work too
};

/// The mapping of that name; "": default_mapping() of the device. Throws InputError naming those there are.
Mapping mapping_of(const std::string& name, const cl::Device& device);

/// Layers that a pass draws: all where their screen positions fit, else as many whole groups as do, or part
/// of one; `wanted` instead where it is above 0.
int layers_at_once(const RasterParams& params, int wanted, const cl::Device& device);

class GroupBins;

/// S Eq. 2 and 3 for all strands.
class SimulateStage {
 public:
  SimulateStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry, int lanes,
                const std::map<std::string, int>& tuning = {});
  void frame(const cl::Queue& queue, int number, PhaseEvents* events);
  const cl::Buffer<float>& state() const { return state_; }  ///< STATE_COLUMNS columns
  int stride() const { return params_.stride; }
  double build_ms() const { return program_.build_ms(); }

 private:
  cl::Program program_;
  cl::Kernel step_;
  SimulateParams params_;
  DynamicsScene dynamics_;
  int lanes_;
  std::size_t local_;  // work-items in a work-group; 0: the driver's choice
  cl::Buffer<float> gusts_, constants_, state_;
};

/// Algorithm 1 over the mask. Without droplets the mask is nothing but zeros, and no kernel is built for it.
class WetStage {
 public:
  WetStage(const cl::Queue& queue, const FrameInput& input, const std::map<std::string, int>& tuning = {});
  cl::Event run(const cl::Queue& queue);  ///< makes the mask; the constructor has done so already
  const cl::Buffer<float>& mask() const { return mask_; }  ///< 4 floats per texel
  double build_ms() const { return program_ ? program_->build_ms() : 0; }
  double mask_ms() const { return mask_ms_; }  ///< wall time of the kernel, warm; 0 without droplets

 private:
  int size_, bucket_;  // texels a side, of the mask and of a bucket
  std::optional<cl::Program> program_;
  std::optional<cl::Kernel> kernel_;
  cl::Buffer<float> droplets_, surface_, mask_;
  cl::Buffer<std::int32_t> row_, drop_;
  double mask_ms_ = 0;
};

/// Vertices to the screen, triangles to tiles, tiles to pixels.
class RasterStage {
 public:
  RasterStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry, const WetStage& wet,
              const ShellOptions& options);
  ~RasterStage();
  /// Draws with the strands' tips of the simulation; without a state the vertices' own, in tip(), are there
  /// already.
  void frame(const cl::Queue& queue, const cl::Buffer<float>* strand_state, int strand_stride,
             PhaseEvents* events);
  const RasterParams& params() const { return params_; }
  const cl::Buffer<float>& vertex() const { return vertex_; }  ///< VERTEX_COLUMNS columns
  cl::Buffer<float>& tip() { return tip_; }                    ///< B of docs/frame.md, 3: three columns
  std::uint64_t count(const cl::Queue& queue);
  Tally tally(const cl::Queue& queue, int every);  ///< of the last frame; its picture is left alone
  Picture read(const cl::Queue& queue) const;
  double build_ms() const;

 private:
  void reach(const cl::Queue& queue);
  // Layers that need more memory than they may at once are drawn in passes, number 0 the innermost and last.
  int passes() const;
  void set_pass(int number);
  void begin_pass(const cl::Queue& queue, int number, PhaseEvents* events);  // all before raster()
  void bin(const cl::Queue& queue, PhaseEvents* events);
  cl::Event raster(const cl::Queue& queue, const cl::Program& program);

  Mapping mapping_;
  std::map<std::string, int> tuning_;
  RasterParams params_;
  std::string options_, one_lane_;  // -D of kernels on all lanes, and on one
  int layers_at_once_;
  std::future<std::vector<std::int32_t>> packed_;  // the fur's texels, while the programs are built
  cl::Program geometry_, raster_;
  cl::Kernel tips_, layers_, records_, count_, sum_, start_, fill_;
  std::unique_ptr<GroupBins> group_bins_;  // of the mapping "group", in place of the kernels above
  cl::Buffer<float> table_, vertex_, uv_, tangent_, curl_, weight_, dry_, tip_, record_, screen_, box_;
  cl::Buffer<std::int32_t> corner_, slice_, strand_, chunk_count_, length_, list_start_, list_, shown_,
      next_tile_;
  cl::Buffer<std::int32_t> fur_, coat_;
  const cl::Buffer<float>* mask_;
  cl::Buffer<glm::vec4> image_;
  cl::Buffer<std::uint32_t> covered_;
};

}  // namespace pelage::shells
