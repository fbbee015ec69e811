// The order of fur layers in a view. D: "Layer bounds are initially calculated by their member strands and
// sorted back-to-front, but additional controls bias and offset the order."
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::strands {

/// The smallest box with edges parallel to the object's axes that contains the roots and the tips of a
/// layer's straight strands at rest. Unit: R, the radius of the mesh's bounding sphere.
struct LayerBounds {
  glm::vec3 low{0}, high{0};
};

/// Returns the rank of each layer in a view, for LayerLook::rank. Rank 0 is in front. The layers are sorted
/// by the view depth of the centre of their bounds plus their bias (R); equal depths by their number. Then
/// each layer moves back by its offset, a number of places. A layer with an offset below 0 moves to the
/// front. If two layers move to the same place, the one with the larger offset is behind. The three lists
/// have equal lengths of at most 256.
std::vector<std::uint8_t> layer_ranks(std::span<const LayerBounds> bounds, const Camera& camera,
                                      std::span<const float> biases, std::span<const int> offsets);

}  // namespace pelage::strands
