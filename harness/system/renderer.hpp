// Draws pictures of a scene at different times with one backend, and continues the simulation from one
// picture to the next where the pictures stay the same bit for bit.
#pragma once
#include <filesystem>

#include "harness/system/system.hpp"

namespace pelage {

class Renderer {
 public:
  /// Opens the backend. `scene` is the scene of the first picture.
  Renderer(KnownBackend known, const BackendOptions& options, const Scene& scene);

  /// Draws the scene after dynamics.time seconds of motion from the fur at rest. The scene has only keyframes
  /// of forces. The picture has the same bits as that of a new renderer.
  Picture draw(const Scene& scene, const std::shared_ptr<const Mesh>& mesh);
  double ms() const { return ms_; }  ///< wall time of the last picture, ms
  std::string device() const { return backend_->device(); }
  /// Writes all inputs and intermediate arrays of the last picture as HDF5 (docs/dump.md). Throws InputError
  /// if the file cannot be written.
  void dump(const std::filesystem::path& path);

 private:
  bool continues(const Scene& scene, const std::shared_ptr<const Mesh>& mesh);

  const System& system_;
  std::unique_ptr<Backend> backend_;
  SystemInput input_;
  Scene scene_;                       ///< of the last picture
  std::shared_ptr<const Mesh> mesh_;  ///< of the last picture
  Picture picture_;
  double ms_ = 0;
};

}  // namespace pelage
