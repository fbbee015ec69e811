// Builds the mass-spring topology, its dynamics and its local forces from a scene.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Converts the scene's dynamics. The wind's speed is strength / drag, so that it pushes a mass at rest with
/// the scene's `strength`, the same force as on Silva's strand.
Dynamics dynamics_of(const DynamicsScene& scene);

/// Returns the scene's topology over its mesh: one stick per surface point, or one per triangle corner if
/// separable.
SpringNetwork topology_of(const FrameInput& input);

/// Returns the scene's local force on each stick, N. The result is empty if the scene has no poke.
std::vector<glm::vec3> pushes(const SpringNetwork& topology, const Mesh& mesh, const PokeScene& poke);

}  // namespace pelage::springs
