// What a scene says of a mass-spring topology.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// The scene's dynamics in the topology's terms. The wind is air of speed strength / drag, which pushes a
/// mass at rest with the scene's strength: the same force as on Silva's strand.
Dynamics dynamics_of(const DynamicsScene& scene);

/// Sticks over surface points; those of a separable topology over every triangle's own corners.
SpringNetwork topology_of(const FrameInput& input);

/// The scene's poke, N per stick; empty where there is none.
std::vector<glm::vec3> pushes(const SpringNetwork& topology, const Mesh& mesh, const PokeScene& poke);

}  // namespace pelage::springs
