// The input of a picture of strands: everything that is computed once from a scene and its mesh.
#pragma once
#include <memory>
#include <string_view>

#include "harness/prepare/frame_input.hpp"
#include "harness/strands/chain/chain.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/groom/fur.hpp"

namespace pelage::strands {

struct StrandInput {
  Scene scene;
  std::shared_ptr<const Mesh> mesh;
  Fur fur;  ///< key strands at rest, the chains that move them, and the strands between them
  ChainDynamics dynamics;
  Camera camera;
  Look look;
  DepthRange range;                         ///< depth range of the sort keys
  std::shared_ptr<const SkinSurface> skin;  ///< null: the picture has no skin
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

}  // namespace pelage::strands
