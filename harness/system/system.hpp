// A system is a way to model fur, such as shells or strands. A backend computes and draws the frames of a
// system, for instance on an OpenCL device, with OpenGL, or as the reference in double precision. The
// commands render, animate, run, check and profile and the program pelage-bench use systems and backends
// only through this interface. harness/system/table.cpp lists all of them.
#pragma once
#include <any>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/cl/frame_timing.hpp"
#include "harness/cl/program.hpp"
#include "harness/compare/checks.hpp"
#include "harness/error.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/picture/hdf5_file.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// What a system computes once from a scene and its mesh: a std::shared_ptr to a const object of the system.
using SystemInput = std::any;

/// Returns the object in the input of a system.
template <class Own>
const std::shared_ptr<const Own>& own(const SystemInput& input) {
  return std::any_cast<const std::shared_ptr<const Own>&>(input);
}

/// How a backend is opened.
struct BackendOptions {
  std::optional<cl::Device> device = {};  ///< empty for backends without the flag on_device
  std::string mapping = {};               ///< mapping of pixels to work-items; "": the device's default
  std::string opengl = {};  ///< implementation choices of an OpenGL baseline (docs/baselines.md)
  std::map<std::string, int> tuning = {};  ///< values of the kernels' tuning axes
  int bits = 32;                           ///< 8: the reference rounds its picture after every layer
  /// True: the first picture counts. The backend begins to build the programs before the input is there, and
  /// leaves out work that pays only for many pictures.
  bool few_pictures = false;
};

/// The amount of work in a frame.
struct BackendWork {
  double covered = 0, shaded = 0, blended = 0;  ///< numbers of fragments
};

/// What a row of results says about a backend.
struct Description {
  std::map<std::string, std::pair<double, std::string>> metrics;  ///< name -> value and unit
  std::map<std::string, int> tuning;                              ///< values of the tuning axes
  std::string opengl_renderer, opengl_options;                    ///< only of OpenGL baselines
};

/// Thrown if a backend cannot draw a scene on this machine although the scene is valid.
struct CannotDraw : InputError {
  using InputError::InputError;
};

/// One implementation of a system. A backend has no scene until load() is called.
class Backend {
 public:
  virtual ~Backend() = default;
  /// Prepares the backend for frames of `input`, with the fur at rest.
  virtual void load(const SystemInput& input) = 0;
  /// Changes the camera, the light and other view keys (System::is_view_key) of the following pictures, and
  /// keeps the simulated state. Returns false, and changes nothing, if this needs load().
  virtual bool set_view(const SystemInput&) { return false; }

  /// Computes the input of the next frame() that no time should contain, such as the skin of an animated
  /// mesh. frame() calls this function if the caller has not.
  virtual void prepare_frame() {}
  virtual cl::FrameTiming frame() = 0;       ///< simulates, draws and times one frame
  virtual cl::FrameTiming still() = 0;       ///< draws the present fur once more, without a simulation
  virtual void advance(int frames) = 0;      ///< simulates `frames` frames without drawing
  virtual int frames_simulated() const = 0;  ///< number of frames since the fur was at rest
  virtual Picture read() = 0;                ///< the picture of the last frame

  /// Keeps what checks() needs to know about the state before the first timed frame.
  virtual void begin_checks() {}
  /// Compares the last frame, whose picture is `timed`, with the reference. `seed` selects samples. The
  /// default draws the frame again; both pictures must have the same bits.
  virtual std::vector<Check> checks(const Picture& timed, std::uint32_t seed);
  /// Adds what a row of results says about the last frame. checks() was called before.
  virtual void describe(Description&) {}
  /// Number of parts of the fur between two simulated points; 0 if their time is not reported.
  virtual std::size_t segments() const { return 0; }
  /// Returns the work of the last frame. checks() was called before.
  virtual BackendWork work() { return {}; }
  /// Writes the arrays of the last frame, except its picture (docs/dump.md). `scene` is that of the input,
  /// but with the time of the frame.
  virtual void dump(Hdf5File& file, const Scene& scene) = 0;
  virtual std::string title() const = 0;  ///< names the backend and its device in a dump

  virtual std::vector<const cl::Program*> programs() const { return {}; }
  virtual double build_ms() const;  ///< build time of all kernels or shaders, ms
  /// Returns the device and its driver, or "" for backends that run on the host.
  virtual std::string device() const { return {}; }
};

struct System;

/// A backend in the table of its system.
struct BackendKind {
  std::string_view name;  ///< value of --pipeline, of the scene key `pipeline`, and of `pipeline` in variants
  /// Reads the options and opens the device. Throws InputError or DeviceError. The commands call it before
  /// they prepare the mesh, which may take minutes, so that errors are reported at once.
  std::unique_ptr<Backend> (*open)(const BackendOptions&, const Scene&);
  bool on_device = false;     ///< needs BackendOptions::device, and accepts --mapping
  bool has_variants = false;  ///< draws with OpenGL, and accepts --opengl
  bool rounds = false;        ///< accepts --reference-bits
};

/// A test scene of `pelage check`, and the options of the command.
struct CheckRequest {
  const Scene& scene;
  std::shared_ptr<const Mesh> mesh;
  cl::Device device;
  std::string mapping;  ///< draw with this mapping only; "": with all that suit the device
  bool motion = true;   ///< false: compare only pictures
  std::function<bool(std::string_view stage)> wants;
};

/// The result of one comparison with the reference, and the name of the compared stage.
struct StageCheck {
  std::string stage;
  Check check;
};

struct System {
  std::string_view name;
  SystemInput (*prepare)(const Scene&, const std::shared_ptr<const Mesh>&);
  /// True for the scene keys that change only the view, but neither the fur nor its motion.
  bool (*is_view_key)(std::string_view key) = [](std::string_view) { return false; };
  /// Returns the same input as prepare(), if `scene` differs from that of `input` only in dynamics.time and
  /// in view keys.
  SystemInput (*with_view)(const SystemInput& input, const Scene& scene) = nullptr;
  std::span<const BackendKind> backends;  ///< the first one is what `pelage check` compares
  // The rest is for `pelage check`. A system without stages needs none of it.
  std::span<const std::string_view> stages = {};
  std::vector<StageCheck> (*check)(const CheckRequest&) = nullptr;
  /// Prints hashes of all results of the request's scene: calls `print` with the name of some data and with
  /// the hash of its bytes.
  void (*hash)(const CheckRequest&,
               const std::function<void(const std::string&, const std::string&)>& print) = nullptr;
  /// Returns the names of the mappings that suit the device, its default first.
  std::vector<std::string> (*mappings)(const cl::DeviceInfo&) = nullptr;
};

/// Returns the table of all systems.
std::span<const System* const> systems();

/// A backend and the system to which it belongs. Both pointers are null if there is no such backend.
struct KnownBackend {
  const System* system = nullptr;
  const BackendKind* kind = nullptr;
  explicit operator bool() const { return kind != nullptr; }
};
KnownBackend backend_named(std::string_view name);

}  // namespace pelage
