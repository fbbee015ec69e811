// The host's part of the OpenGL baseline: interpolates strands between key strands, removes those that are
// not drawn, and sorts the others from back to front.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "harness/strands/drawing/detail.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands {

/// A strand as OpenGL reads it. X, Y and W are products of the camera's rows with the control points
/// (docs/strands.md, section Drawing).
struct StrandRecord {
  std::array<glm::vec3, 3> view{};  ///< X, Y and W of root, joint and tip
  float radius = 0;                 ///< half of the width at the root divided by Camera::pixel
  std::uint32_t colour = 0;  ///< red, green, blue and the number of the film frame, the lowest byte first
  float joint_height = 0;    ///< of the joint above the skin, in heights of the skin's shadow
};

/// The rest of a strand, if the look has more than a key light and ambient light.
struct LightRecord {
  glm::vec3 steady{0};   ///< light that does not change along the strand
  float tip_height = 0;  ///< of the tip above the skin, in heights of the skin's shadow
};

/// The part of a strand of a file (StrandShape).
struct ShapeRecord {
  float from = 0, to = 1, width_end = 1;
  float root_height = 0;  ///< of the start above the skin, in heights of the skin's shadow
};

/// The strands of a picture or of an opacity map. `light` is empty in an opacity map, and if the look has a
/// key light and ambient light only. `shape` is empty if the strands have no shapes.
struct Records {
  std::vector<StrandRecord> strand;
  std::vector<LightRecord> light;
  std::vector<ShapeRecord> shape;
};

class HostStrands {
 public:
  HostStrands(const DrawingScene& scene, const std::vector<KeyedStrand>& strands);
  /// Interpolates the strands between the key strands. All cores of the machine interpolate.
  void interpolate(const std::vector<KeyStrand>& keys);
  /// Returns the strands to draw, from back to front. The result is valid until the next call. One core sorts
  /// the strands.
  const Records& back_to_front();
  /// Returns all strands in the view of the key light, with the opacity and the taper of their layers.
  const Records& in_light() const { return in_light_; }

 private:
  struct Item {
    std::uint32_t key, strand;
  };
  struct Curve;
  Curve curve_of(const std::vector<KeyStrand>& keys, std::size_t strand) const;
  void set_light(const Curve& curve, const KeyedStrand& strand, std::size_t at);
  std::uint32_t key_of(const StrandRecord& record, float width_end, int rank, bool away) const;
  void sort();

  DrawingScene scene_;
  bool lights_, map_;
  Irradiance fill_;
  LightView light_;
  Pruning pruning_;
  std::vector<KeyedStrand> strands_;  ///< those that are drawn
  std::vector<LayerLook> layers_;     ///< looks of all 256 possible fur layers
  Records records_, sorted_;          ///< one per strand; those to draw, from back to front
  Records in_light_;
  std::vector<std::uint32_t> keys_;  ///< one per strand; not_drawn for strands that are not drawn
  std::vector<Item> entries_, other_;
};

}  // namespace pelage::strands
