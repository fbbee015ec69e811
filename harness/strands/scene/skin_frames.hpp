// The skin of a mesh that moves and deforms, for one drawn frame after the other.
#pragma once
#include <memory>
#include <optional>

#include "harness/scene/scene.hpp"
#include "harness/strands/body/skin.hpp"
#include "harness/strands/drawing/skin_surface.hpp"
#include "harness/strands/groom/fur.hpp"

namespace pelage::strands {

class SkinFrames {
 public:
  /// `mesh` has frames (Mesh::frames), and `fur` grows on it. `surface` is the skin in the picture at rest,
  /// or null. The object keeps references to the mesh and to the surface.
  SkinFrames(const Scene& scene, std::shared_ptr<const Mesh> mesh, const Fur& fur,
             std::shared_ptr<const SkinSurface> surface);

  /// Proceeds to the next frame. The first call proceeds to the frame at time 0, and every other call by
  /// dynamics.substeps time steps. After the last frame of the mesh follows what the scene key
  /// mesh.after_frames says.
  void advance();

  const SkinFrame& frame() const { return frame_; }  ///< at the roots of the key strands
  /// The skin in the picture, or null.
  std::shared_ptr<const SkinSurface> surface() const { return surface_; }

 private:
  std::shared_ptr<const Mesh> mesh_;
  Skin skin_;  ///< of the mesh at rest
  SkinMotion motion_;
  std::shared_ptr<const SkinSurface> surface_;
  double duration_;  ///< of a frame, s
  bool repeat_;
  std::size_t next_ = 0;  ///< number of the frame to which advance() proceeds
  SkinFrame frame_;
};

}  // namespace pelage::strands
