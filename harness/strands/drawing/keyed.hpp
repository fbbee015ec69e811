// Strands between key strands. Only key strands are simulated; D interpolates the other strands. R is the
// radius of the mesh's bounding sphere.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace pelage::strands {

struct DrawnStrand;

/// A key strand at one moment, in the object's frame.
struct KeyStrand {
  glm::vec3 root{0};          ///< R
  glm::vec3 normal{0, 1, 0};  ///< normal of the skin at the root, unit vector
  glm::vec3 first{0, 1, 0};   ///< direction of the segment from the root to the joint, unit vector
  glm::vec3 second{0, 1, 0};  ///< direction of the segment from the joint to the tip, unit vector
  glm::vec3 rest{0, 1, 0};    ///< direction of both segments at rest, unit vector
};

/// A strand of a picture. It lies between three key strands.
struct KeyedStrand {
  std::array<std::uint32_t, 3> key{};  ///< indices of the key strands
  glm::vec2 weight{0.0f};  ///< barycentric weights of the second and the third key strand, each 0 to 1
  float length = 0.1f;     ///< R
  float width = 0.002f;    ///< width at the root, R
  std::array<std::uint8_t, 3> colour{128, 128, 128};  ///< red, green and blue, gamma-encoded
  float response = 1;      ///< factor of the movement away from the direction at rest, 0 to 10
  float twist = 0;         ///< rotation of the strand about the normal, degrees, -360 to 360
  float curvature = 0;     ///< rotation of the second segment towards the skin, degrees, -180 to 180
  std::uint8_t layer = 0;  ///< number of the fur layer, an index of Look::layers
};

/// The shape of a strand of a file, or of a part of one (docs/grooms.md). The
/// strand's three key strands are the same one, its own, and `length` is that of its chain.
struct StrandShape {
  float from = 0, to = 1;  ///< the part of the strand, from 0 (root) to 1 (tip)
  float width_end = 1;     ///< width at `to` divided by the width at `from`, KeyedStrand::width
  /// The control points at rest, from the points of the straight strand at `from`, in the middle and at `to`,
  /// R.
  std::array<glm::vec3, 3> offset{};
  float middle() const { return 0.5f * (from + to); }
};

/// True if some strand has a response other than 1, or a twist or a curvature other than 0.
bool has_styles(const std::vector<KeyedStrand>& strands);

/// Returns the records of the key strands in the memory layout of the kernels: KEY_RECORD floats each
/// (kernels/strands/draw/params.h).
std::vector<float> key_records(const std::vector<KeyStrand>& keys);

/// Converts the first `count` records back to key strands.
std::vector<KeyStrand> keys_of(const std::vector<float>& records, std::size_t count);

/// Returns the strands in the memory layout of the kernels: slices of 16 strands with DRAWN_COLUMNS columns
/// (kernels/common/slices.clh). Throws InputError if a value is not finite or outside its valid range, or if
/// an index is not below `keys`, the number of key strands.
std::vector<float> keyed_columns(const std::vector<KeyedStrand>& strands, std::size_t keys);

/// Sets DrawnStrand::part of all curves, of which `strands` and `shapes` have one entry each. The curves of a
/// strand follow each other, from its root on.
void set_parts(std::vector<DrawnStrand>& curves, const std::vector<KeyedStrand>& strands,
               const std::vector<StrandShape>& shapes);

/// Returns the shapes in the memory layout of the kernels, with SHAPE_COLUMNS columns. Throws InputError if a
/// value is not finite or outside its valid range.
std::vector<float> shape_columns(const std::vector<StrandShape>& shapes);

}  // namespace pelage::strands
