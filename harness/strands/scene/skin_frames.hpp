// The skin of a mesh that moves and deforms, for one drawn frame after the other.
#pragma once
#include <memory>
#include <optional>

#include "harness/scene/scene.hpp"
#include "harness/strands/body/skin.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/groom/fur.hpp"

namespace pelage::strands {

class SkinFrames {
 public:
  /// `mesh` has frames (Mesh::frames), and `fur` grows on it. `surface` is the skin in the picture at rest,
  /// or null. The object keeps references to the mesh and to the surface.
  SkinFrames(const Scene& scene, std::shared_ptr<const Mesh> mesh, const Fur& fur,
             std::shared_ptr<const SkinSurface> surface);

  /// Proceeds to the next drawn frame. The first call gives the skin at rest, and the call k + 2 gives the
  /// skin of drawn frame k, which is frame k of the mesh. After the last frame of the mesh follows what the
  /// scene key mesh.after_frames says; a skin that stays has the velocity 0.
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
  std::size_t next_ = 0;  ///< number of the mesh's frame that follows
  int calls_ = 0;         ///< number of calls of advance()
  SkinFrame frame_;
};

}  // namespace pelage::strands
