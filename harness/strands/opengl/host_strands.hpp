// The host's part of the OpenGL baseline: interpolates strands between key strands, removes those that are
// not drawn, and sorts the others from back to front.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands {

/// A strand as OpenGL reads it. X, Y and W are products of the camera's rows with the control points
/// (docs/strands.md, section Drawing).
struct StrandRecord {
  std::array<glm::vec3, 3> view{};  ///< X, Y and W of root, joint and tip
  float radius = 0;                 ///< half of the width at the root divided by Camera::pixel
  std::uint32_t colour = 0;         ///< red, green and blue, the lowest byte first
  float unused = 0;
};

class HostStrands {
 public:
  HostStrands(const DrawingScene& scene, const std::vector<KeyedStrand>& strands);
  /// Returns the strands to draw, from back to front. The result is valid until the next call. All cores of
  /// the machine interpolate strands; one core sorts them.
  const std::vector<StrandRecord>& back_to_front(const std::vector<KeyStrand>& keys);

 private:
  struct Item {
    std::uint32_t key, strand;
  };
  void interpolate(const std::vector<KeyStrand>& keys);
  void sort();

  Camera camera_;
  DepthRange range_;
  float first_segment_;
  std::vector<KeyedStrand> strands_;
  std::vector<std::uint32_t> ranks_;            ///< rank of each strand's fur layer
  std::vector<StrandRecord> records_, sorted_;  ///< one per strand; those to draw, from back to front
  std::vector<std::uint32_t> keys_;             ///< one per strand; not_drawn for strands that are not drawn
  std::vector<Item> entries_, other_;
};

}  // namespace pelage::strands
