// The interface of everything that an experiment can time, such as a pipeline that draws frames of a case.
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
#include "harness/measure/sampler.hpp"
#include "harness/picture/picture.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/record/row.hpp"

namespace pelage {

/// Thrown if the device or the pipeline cannot run this case. Its row gets the status `unsupported`.
struct Unsupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown if the simulation of the case diverges. Its row gets the status `diverged` with the message.
struct OutOfBounds : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Subject {
 public:
  virtual ~Subject() = default;
  virtual FrameSample frame() = 0;  ///< runs and times the next frame
  /// Reads the picture of the last frame back without drawing it again; empty if the subject draws nothing.
  virtual Picture read() = 0;
  /// Compares the timed frame, of which read() returned the picture `timed`, with results that count as
  /// correct. The row gets the status `ok` only if there is at least one check and all checks hold.
  virtual std::vector<Check> check(const Picture& timed) = 0;
  /// Sets build_ms, tuning and metrics of `row`, whose samples are already filled. Adds the hashes of mesh,
  /// kernels and scene to row.provenance, and those of OpenCL programs and shaders to row.identity.
  virtual void describe(Row& row) = 0;
};

/// Makes the subject of a case. Throws DeviceError, Unsupported or InputError.
using MakeSubject = std::function<std::unique_ptr<Subject>(const Case&)>;

/// Data from which the subjects of one run are made.
struct SubjectContext {
  cl::Device device;
  Experiment experiment;
  std::map<std::string, int> tuning;                 ///< values of the kernels' tuning parameters
  std::function<void(const std::string&)> progress;  ///< receives progress messages of slow steps
  SceneMeshes meshes;
  /// Computed values that later cases use again, for example the exact solution of a simulation.
  std::map<std::string, std::any> shared;

  std::shared_ptr<const Mesh> mesh_of(const Scene& scene) { return meshes.of(scene, progress); }
};

/// An entry in the table of studies that an experiment can time (harness/subjects/pipelines.cpp).
struct Pipeline {
  std::string_view name;  ///< value of the key `pipeline` in the variants of an experiment file
  std::unique_ptr<Subject> (*make)(SubjectContext&, const Case&);
};

}  // namespace pelage
