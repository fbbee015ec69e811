// The interface of everything that an experiment can time, such as a pipeline that draws frames of a case.
// The shell pipeline, the baselines and tests implement it.
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

/// Thrown if the device or the pipeline cannot run this case. The row gets the status `unsupported`, which is
/// not a failure.
struct Unsupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown if the simulation of the case diverges. The row gets the status `diverged` with the message as its
/// reason.
struct OutOfBounds : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Subject {
 public:
  virtual ~Subject() = default;
  virtual FrameSample frame() = 0;  ///< runs and times the next frame
  /// Returns the last frame's own buffer; does not draw it again. The picture is empty if the subject draws
  /// nothing.
  virtual Picture read() = 0;
  /// Compares that picture with trusted results. The row is ok only if there is at least one check and all
  /// checks hold.
  virtual std::vector<Check> check(const Picture& timed) = 0;
  /// Adds to the row: build_ms, tuning, metrics, the mesh, kernel and scene hashes in the provenance, and
  /// values computed from row.samples, which are already set.
  virtual void describe(Row& row) = 0;
};

/// Prepares a case. Throws DeviceError, Unsupported, InputError.
using MakeSubject = std::function<std::unique_ptr<Subject>(const Case&)>;

/// Data from which the subjects of one run are made.
struct SubjectContext {
  cl::Device device;
  Experiment experiment;
  std::map<std::string, int> tuning;                 ///< values of the kernels' tuning axes
  std::function<void(const std::string&)> progress;  ///< receives messages about slow steps
  SceneMeshes meshes;
  /// results that several cases share; the code that adds a result chooses its key
  std::map<std::string, std::any> shared;

  std::shared_ptr<const Mesh> mesh_of(const Scene& scene) { return meshes.of(scene, progress); }
};

/// A row of the table of the pipelines that an experiment can time (harness/subjects/pipelines.cpp).
struct Pipeline {
  std::string_view name;  ///< name as written in an experiment's variants
  std::unique_ptr<Subject> (*make)(SubjectContext&, const Case&);
};

}  // namespace pelage
