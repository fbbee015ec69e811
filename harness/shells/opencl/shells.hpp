// The pipeline that draws fur as texture layers (shells) on an OpenCL device. Every frame has the phases
// simulate, transform, bin and raster. If the water changes over time (docs/shells.md, section 10), every
// frame also has the phase wet, which computes the wetness mask. Otherwise the mask is computed once.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "harness/cl/frame_timing.hpp"
#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Returns the names of all mappings.
const std::vector<std::string>& mappings();
/// Returns "name: description; ..." of all mappings, for --help.
std::string mappings_help();

/// Returns the names of the mappings that the commands offer on a device, its default mapping first. The
/// mapping `tile` is left out if a work-item has one lane: it then needs 350 KB of private memory per
/// work-item, which compilers for GPUs refuse.
std::vector<std::string> mappings_on(const cl::DeviceInfo& device);

/// Returns `name`, or the name of the device's default mapping for "". Throws InputError if mappings_on()
/// does not contain `name`.
std::string offered_mapping(const std::string& name, const cl::DeviceInfo& device);

/// Returns the name of the device's default mapping.
std::string default_mapping(const cl::DeviceInfo& device);

struct ShellOptions {
  std::string mapping;                ///< a name from mappings(); "": the device's default_mapping()
  std::map<std::string, int> tuning;  ///< values of tuning axes (kernels/*/tuning.toml), e.g. {"TILE_W", 16}
  int layers_at_once = 0;             ///< number of layers that one pass draws; 0: as many as fit in memory
  bool refine = true;                 ///< calls Shells::refine(); false for a single picture
};

/// Fragment counts of a frame, summed over all layers. Fragments of the base surface are not counted.
struct Tally {
  /// Number of covered fragments. Each triangle of a layer has one fragment in every pixel that it covers.
  /// Fragments behind the base surface or behind opaque fur are counted, too.
  std::uint64_t covered = 0;
  /// Number of covered fragments that are not behind the base surface and are drawn before their pixel is
  /// opaque.
  std::uint64_t shaded = 0;
  /// Number of shaded fragments whose fur is not fully transparent. Only these fragments are lit and blended.
  std::uint64_t blended = 0;
};

/// True if Shells::set_view() can change the scene key: the keys of the camera and of the shading (without
/// shading.self_shadow), and the background.
bool is_view_key(std::string_view key);

/// A scene on an OpenCL device. The constructor uploads the scene, builds the kernels and computes the
/// wetness mask of the picture at the time dynamics.time. frame() advances the strands by
/// scene.dynamics.substeps substeps and draws one picture. read() copies the picture to the host. Lengths are
/// in R. Velocities are in R per second.
class Shells {
 public:
  Shells(const cl::Device& device, std::shared_ptr<const FrameInput> input, const ShellOptions& options = {});
  ~Shells();
  Shells(Shells&&) noexcept;
  Shells& operator=(Shells&&) noexcept;

  /// Places the fur on the skin of the next frame, if the skin deforms. frame() calls this function if the
  /// caller has not; its time does not contain it.
  void follow_skin();
  // frame() and advance() throw springs::Diverged if masses of a mass-spring topology have diverged.
  cl::FrameTiming frame();   ///< simulates, draws and times one frame
  void advance(int frames);  ///< simulates `frames` frames without drawing
  cl::FrameTiming still();   ///< draws and times the present fur once more, without a simulation
  /// Changes the camera, the light and the background of the following pictures, and builds nothing. `input`
  /// differs from the present input only in the camera and in keys for which is_view_key() is true. Returns
  /// false, and changes nothing, if the size of the picture differs.
  bool set_view(std::shared_ptr<const FrameInput> input);
  Picture read() const;  ///< copies the picture of the last frame to the host
  /// Computes in which layers each triangle of wet fur can be visible, more tightly than the first picture
  /// needs it. This takes longer than a frame, and later frames take less time. The picture is the same.
  void refine();
  int frames_simulated() const;  ///< number of frames simulated since the fur was at rest
  /// Returns the wetness mask of the last frame, or of the picture at the time dynamics.time before the first
  /// frame. It has wetness.size^2 texels. A texel holds the centre (c_u, c_v) and the radius
  /// r of a clump, and the wetness rho.
  std::vector<glm::vec4> mask() const;
  /// Returns the vector from the root to the tip of each strand, or from the base to the top of each stick.
  std::vector<glm::vec3> tips() const;
  std::vector<glm::vec3> velocities() const;  ///< of the tips or tops
  /// Counts the fragments of the last frame in all layers. The function draws the frame again with the pixel
  /// mapping, but only in a random sample of about one in `every` pixels. The function then multiplies the
  /// counts by `every`. With every = 1 the counts are exact, but slow to compute. With every = 0 the sample
  /// has about 8192 pixels, and the relative error of the counts is about 1%.
  Tally tally(int every = 0);
  std::uint64_t count();    ///< number of covered fragments of the last frame in all layers
  double build_ms() const;  ///< build time of all kernels, ms
  /// What a new wetness mask costs, wall times in ms. 0 without droplets.
  struct MaskTime {
    /// From the upload of the droplets until the device has computed all that depends on them.
    double all = 0;
    /// The part of `all` for what depends on the mask: the dryness of each vertex, the curl frame of each
    /// vertex (only if fur.substeps > 1 or shadows are traced), and the number of layers in which each
    /// triangle is drawn.
    double after_mask = 0;
  };
  /// Computes the mask of the last picture once more, and measures it. The kernels have been compiled before.
  MaskTime mask_time();
  std::string kernel_hash() const;  ///< hash of the sources of all built programs, including their headers
  std::vector<const cl::Program*> programs() const;  ///< the programs of all stages

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pelage
