// Builds the mass-spring topology, its dynamics and its local forces from a scene.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Converts the scene's dynamics. The wind's speed is strength / drag. With this speed, the wind exerts the
/// scene's force `strength` on a mass at rest, as it does on Silva's strands.
Dynamics dynamics_of(const DynamicsScene& scene);

/// Returns the scene's topology over its mesh: one stick per surface point, or one per triangle corner if
/// separable.
SpringNetwork topology_of(const FrameInput& input);

/// Returns the local force of the scene's poke on each stick, in newtons. The result is empty if the scene
/// has no poke.
std::vector<glm::vec3> pushes(const SpringNetwork& topology, const Mesh& mesh, const PokeScene& poke);

}  // namespace pelage::springs
