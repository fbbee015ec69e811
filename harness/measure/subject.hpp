// What the harness times: anything that draws frames of a case. The shell pipeline is one; rivals and tests
// bring others.
#pragma once
#include <any>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "harness/cl/device.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/journal/row.hpp"
#include "harness/measure/sampler.hpp"
#include "harness/picture/picture.hpp"
#include "harness/prepare/scene_mesh.hpp"

namespace pelage {

/// The device or the pipeline cannot do this case at all: the row says so and is no failure.
struct Unsupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What the case simulates went out of bounds: the row is diverged and says where.
struct OutOfBounds : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Subject {
 public:
  virtual ~Subject() = default;
  virtual FrameSample frame() = 0;  ///< draws the next frame
  /// The last frame's own buffer, never a second drawing; no pixels where nothing is drawn.
  virtual Picture read() = 0;
  /// Compares that picture with something trusted; the row is ok only if there is a check and all hold.
  virtual std::vector<Check> check(const Picture& timed) = 0;
  /// Adds what it knows of itself: build_ms, tuning, metrics, and mesh, kernel and scene hashes to the
  /// provenance, and what follows from row.samples, which are there already.
  virtual void describe(Row& row) = 0;
};

/// Prepares a case. Throws DeviceError, Unsupported, InputError.
using MakeSubject = std::function<std::unique_ptr<Subject>(const Case&)>;

/// What the subjects of one sweep are made from.
struct SubjectContext {
  cl::Device device;
  Experiment experiment;
  std::map<std::string, int> tuning;                 ///< of the kernels
  std::function<void(const std::string&)> progress;  ///< told what takes long
  SceneMeshes meshes;
  std::map<std::string, std::any> shared;  ///< results that several cases need, under a key of their maker's

  std::shared_ptr<const Mesh> mesh_of(const Scene& scene) { return meshes.of(scene, progress); }
};

/// A row of the table of what an experiment can time (subjects/pipelines.cpp).
struct Pipeline {
  std::string_view name;  ///< as a variant of an experiment writes it
  std::unique_ptr<Subject> (*make)(SubjectContext&, const Case&);
};

}  // namespace pelage
