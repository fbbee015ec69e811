// Builds the mass-spring topology, its dynamics and its local forces from a scene.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Converts the scene's dynamics to the parameters of the mass-spring solvers. If springs.reference_area of
/// the scene is above 0, the constants of a stick (mass, stiffness, damping, drag, weight of the return
/// force) are multiplied by the topology's mean surface area per stick, divided by the reference area. The
/// constants of the springs between tops do not change.
Dynamics dynamics_of(const DynamicsScene& scene, const SpringNetwork& network);

/// Builds the masses and springs of the scene's topology. Throws InputError if
/// dynamics.topology of the scene is not a mass-spring topology.
SpringNetwork network_of(const FrameInput& input);
SpringNetwork network_of(const Scene& scene, const Mesh& mesh);

/// The sticks on a skin that moves and deforms (harness/prepare/moving_skin.hpp), in one drawn frame.
struct MovedSticks {
  SpringNetwork network;             ///< bases, normals and rest lengths on the skin of this frame
  Mesh mesh;                         ///< this skin
  std::vector<glm::dvec3> velocity;  ///< of each stick's base during the frame, R/s
};
/// Returns the sticks in drawn frame `frame`. `first` is network_of(input), which keeps the phases of the
/// gusts and the area per stick. docs/springs.md, section Moving skin.
MovedSticks moved_sticks(const FrameInput& input, const SpringNetwork& first, int frame);

/// Returns the local force on each stick in newtons: `push` (empty: none) and the drag of air, with the
/// coefficient `drag`, that the velocity of its base causes.
std::vector<glm::vec3> with_drag(std::vector<glm::vec3> push, const std::vector<glm::dvec3>& velocity,
                                 float drag);

/// Returns the local force of the scene's poke on each stick, in newtons. The result is empty if the scene
/// has no poke.
std::vector<glm::vec3> pushes(const SpringNetwork& network, const Mesh& mesh, const PokeScene& poke);

}  // namespace pelage::springs
