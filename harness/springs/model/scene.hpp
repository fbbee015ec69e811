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

/// Returns the local force of the scene's poke on each stick, in newtons. The result is empty if the scene
/// has no poke.
std::vector<glm::vec3> pushes(const SpringNetwork& network, const Mesh& mesh, const PokeScene& poke);

}  // namespace pelage::springs
