// The input of a picture of strands: everything that is computed once from a scene and its mesh.
#pragma once
#include <memory>
#include <string_view>

#include "harness/prepare/frame_input.hpp"
#include "harness/strands/body/skin.hpp"
#include "harness/strands/chain/chain.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/groom/fur.hpp"

namespace pelage::strands {

struct StrandInput : DrawingScene {
  Scene scene;
  std::shared_ptr<const Mesh> mesh;
  Fur fur;  ///< key strands at rest, the chains that move them, and the strands between them
  ChainDynamics dynamics;
  ContactFields contact_fields;  ///< distances from the mesh contact.mesh
};

/// Computes the input of a picture of strands. The result depends only on the arguments and on the pictures
/// that the scene names. Throws InputError if the mesh has no triangles, or if a picture cannot be read.
std::shared_ptr<const StrandInput> prepare_strands(const Scene& scene, std::shared_ptr<const Mesh> mesh);

/// Returns the same input as prepare_strands(scene, input.mesh), if `scene` differs from the scene of `input`
/// only in dynamics.time and in keys for which is_view_key() is true.
std::shared_ptr<const StrandInput> with_view(const StrandInput& input, const Scene& scene);

/// True for the keys that change only the camera, the light, the background or the look of the strands in a
/// picture, but neither the fur nor its motion.
bool is_view_key(std::string_view key);

/// Returns the reading of the opacity map that strands.shadow names.
Shadow shadow_named(const std::string& name);

/// Converts the scene's keys to the look of a picture. The first light of the scene is the key light. The
/// second light becomes a white fill light.
Look look_of(const Scene& scene);

/// Converts the scene's keys to the constants that all chains share. A chain's wind has the speed
/// wind.strength / (dynamics.mass * strands.chain.drag): at rest, a wind of this speed accelerates a strand
/// by wind.strength / dynamics.mass, as it accelerates the strands of the other pipelines.
ChainDynamics chain_dynamics(const Scene& scene);

/// Returns the dynamics of the simulated frame number `frame`, from 0 (dynamics_of_frame() of a scene).
ChainDynamics dynamics_of_frame(const StrandInput& input, int frame);

/// The skin of a mesh that moves and deforms, for one drawn frame after the other.
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
