// The input of a picture of strands (docs/strands.md, section Drawing). R is the radius of the mesh's
// bounding sphere.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::strands {

struct StrandShape;

/// What a drawn curve is of a strand of a file.
struct StrandPart {
  float from = 0, to = 1;    ///< the part of the strand, from 0 (root) to 1 (tip)
  float width_end = 1;       ///< width at `to` divided by the width at `from`
  glm::vec3 root{0};         ///< root of the strand, R
  float length = 0.1f;       ///< length of the strand's chain, R
  std::uint32_t strand = 0;  ///< number of the strand
};

/// A strand as it is drawn, or a part of a strand of a file. Positions and directions are in the object's
/// frame.
struct DrawnStrand {
  /// Control points of a quadratic Bezier curve: root, joint and tip, in R.
  std::array<glm::vec3, 3> point{};
  glm::vec3 normal{0, 1, 0};  ///< normal of the skin at the root, unit vector
  glm::vec3 colour{0.5f};     ///< colour of the strand, gamma-encoded, each component 0 to 1
  float width = 0.002f;       ///< width at the root, or at the start of the part, R
  int layer = 0;              ///< number of the fur layer, 0 to 255
  int rank = 0;  ///< strands of a lower rank are in front of all strands of a higher rank; 0 to 255
  std::optional<StrandPart> part;  ///< empty: the whole strand, of a fur layer that was grown
};

/// A fill light. It is projected to spherical harmonics together with the other fill lights.
struct FillLight {
  glm::vec3 direction{0, 1, 0};  ///< towards the light, of any length above 0
  glm::vec3 colour{0.5f};        ///< intensity for each colour, at least 0
};

/// A sample of a film strip: factors of a strand's colour, highlight and alpha at one place along the strand.
struct FilmSample {
  std::uint8_t luminance = 128, gloss = 128;  ///< 128 means 1
  std::uint8_t opacity = 255;                 ///< 255 means 1
};
using FilmFrame = std::array<FilmSample, 8>;  ///< samples at equal distances from the root to the tip

/// Readings of the paper's opacity map: how the key light decreases behind the first strands.
enum class Shadow { none, linear, exponential };

/// The shadow that the strands cast on each other (docs/strands.md, section Shadow).
struct ShadowLook {
  Shadow reading = Shadow::none;
  int size = 512;        ///< texels per side of the opacity map, 16 to 8192
  float length = 0.1f;   ///< mean length of the strands, R; the shadow is complete at this depth
  float radius = 1.25f;  ///< radius of a ball around the object's origin that contains all strands, R
};

inline constexpr int most_layers = 256;  ///< limit of the number of fur layers
inline constexpr int most_frames = 256;  ///< limit of the number of frames of the film strips

/// The place of a fur layer in the order of drawing, its frames of the film strip, and its look: factors of
/// values of Look.
struct LayerLook {
  int rank = 0;  ///< strands of a lower rank are in front of all strands of a higher rank; 0 to 255
  int first_frame = 0, frames = 1;  ///< the layer uses `frames` frames of Look::film from `first_frame` on
  float opacity = 1, taper = 1;     ///< at least 0; the products with those of Look are at most 1
  float gloss = 1;                  ///< factor of Look::specular, at least 0
  float exponent = 1;               ///< factor of Look::exponent; the product is 1 to 10000
  glm::vec3 rim{1};                 ///< factor of Look::rim, at least 0
  float rim_exponent = 1;           ///< factor of Look::rim_exponent; the product is 1 to 1000
  float skin_shadow = 1;            ///< factor of Look::skin_shadow; the product is 0 to 1
  bool operator==(const LayerLook&) const = default;

  bool has_own_look() const {
    return opacity != 1 || taper != 1 || gloss != 1 || exponent != 1 || rim != glm::vec3(1) ||
           rim_exponent != 1 || skin_shadow != 1;
  }
};

/// What happens to strands that face away from the camera: they are left out before the sort; or they are
/// sorted behind all others and left out there; or they are drawn.
enum class BackFacing { removed, last, drawn };

/// The values that all strands of a picture share.
struct Look {
  /// Part of the strands that is drawn, above 0 and at most 1. The other strands become wider, so that the
  /// coverage stays nearly the same (harness/strands/drawing/detail.hpp).
  float fraction = 1;
  /// Factor of the widths of all strands, above 0 and at most 1, from overlap_factor(); 1 if fraction is 1.
  float width_factor = 1;
  int segments = 6;  ///< greatest number of straight segments that a curve is divided into, 1 to 7
  /// Number of segments of a whole strand of a file, over all its curves; segments_of_part() divides it. 1 to
  /// 7.
  int strand_segments = 6;
  bool own_segments = false;  ///< true: each strand has as many segments as it needs, at most `segments`
  BackFacing back_facing = BackFacing::removed;
  float taper = 0.85f;                  ///< part of the width that a strand loses from root to tip, 0 to 1
  float opacity = 0.85f;                ///< alpha of a strand at its root, 0 to 1; it falls to 0 at the tip
  glm::vec3 light{0.25f, 1.0f, -0.4f};  ///< direction towards the key light, of any length above 0
  float intensity = 1.0f;               ///< intensity of the key light
  float ambient = 0.2f;                 ///< ambient light
  glm::vec3 specular{0.2f};             ///< colour of the highlight
  float exponent = 24.0f;               ///< exponent of the highlight, at least 1
  std::vector<FillLight> fills;
  int bands = 2;           ///< highest degree l of the spherical harmonics: 1 or 2
  glm::vec3 rim{0};        ///< colour of the rim light
  float rim_exponent = 3;  ///< exponent of the rim light, at least 1
  ShadowLook shadow;
  float skin_shadow = 0;            ///< part of the light that a strand loses at its root, 0 to 1
  float skin_shadow_height = 0.5f;  ///< height above the skin without this loss, in lengths of the strand
  std::vector<FilmFrame> film;      ///< frames of the film strips; empty: no film strip
  /// One entry per fur layer. layer_look() defines the values of a layer without an entry.
  std::vector<LayerLook> layers;
  glm::vec3 background{0.30f, 0.34f, 0.39f};
};

/// The part of the view depth that the sort divides into 2^24 steps.
struct DepthRange {
  float nearest = 0;    ///< view depth of the first step, R
  float per_depth = 1;  ///< number of steps per R
};

/// An entry of the list of strands to draw.
struct Entry {
  std::uint32_t key = 0;     ///< the rank in the upper 8 bits, and the depth step in the lower 24 bits
  std::uint32_t strand = 0;  ///< index of the strand
  bool operator==(const Entry&) const = default;
};

/// Returns the depth range of a view in which no joint is further than `radius` from the object's origin.
/// `radius` is in R and above 0.
DepthRange depth_range(const Camera& camera, float radius);

/// The nine coefficients of the fill lights' irradiance for each colour. sh[0] belongs to l = 0, sh[1] to
/// sh[3] to l = 1 and sh[4] to sh[8] to l = 2. irradiance() multiplies them with a basis() of a normal n.
using Irradiance = std::array<glm::vec3, 9>;

/// Returns whether the look has more than a key light and ambient light, or layers with looks of their own.
bool has_lights(const Look& look);

/// Returns whether some fur layer has a factor other than 1.
bool has_layer_looks(const Look& look);

/// Returns the coefficients of F of docs/strands.md, section Light. Coefficients above look.bands are 0.
Irradiance irradiance_of(const Look& look);

/// Returns the nine polynomials of the unit vector n to which the coefficients of Irradiance belong: 1; y, z,
/// x; x y, y z, 3 z^2 - 1, x z, x^2 - y^2.
std::array<double, 9> basis_at(glm::dvec3 n);

/// Returns the values of the fur layer with the number `layer`. A layer without an entry in look.layers has
/// its number as its rank, and uses all frames of the film strip.
LayerLook layer_look(const Look& look, int layer);

/// Returns the least number of segments of a curve that is the part `from` to `to` of a strand of a file:
/// the part's share of look.strand_segments, at least 2; or with look.own_segments, its share of 3, at least
/// 1.
int segments_of_part(const Look& look, float from, float to);

/// Throws InputError if a value is not finite or outside its valid range. The message names the value and the
/// valid range.
void check(const Look& look);

/// A parallel projection along the key light. The product of a row with (p, 1) gives, for a point p in the
/// object's frame: x and y in texels from the centre of the map, and z, the distance in R that grows away
/// from the light.
struct LightView {
  glm::vec4 row_x{0}, row_y{0}, row_z{0};
  float texel = 1;  ///< side of a texel, R
  int size = 1;     ///< texels per side of the map
};

/// Returns the view along look.light of a map with look.shadow.size texels per side. The ball with the radius
/// look.shadow.radius around the object's origin fills the map, with a margin of two texels on each side.
LightView light_view(const Look& look);

/// The products of these rows with (X, Y, W, 1), the view coordinates of a point, are its column and its row
/// in the opacity map, in texels from the centre of the first texel, and its depth from the light in R.
struct MapRows {
  glm::vec4 column{0}, row{0}, depth{0};
};
MapRows map_rows(const Camera& camera, const Look& look);

/// A triangle mesh with colours. Positions and normals are in the object's frame. position, normal and colour
/// have one element per vertex.
struct SkinSurface {
  std::vector<glm::vec3> position;   ///< R
  std::vector<glm::vec3> normal;     ///< unit vector
  std::vector<glm::vec3> colour;     ///< gamma-encoded, each component 0 to 1
  std::vector<glm::uvec3> triangle;  ///< indices of the vertices
};

/// Returns the surface of the mesh. The colour of a vertex is the coat's colour at its UV times `factor`. The
/// normal of a vertex is the area-weighted mean of the normals of the triangles around its surface point.
SkinSurface skin_surface(const Mesh& mesh, const CoatTexture& coat, glm::vec3 factor);

/// What a picture shows, and from where.
struct DrawingScene {
  Camera camera;
  Look look;
  DepthRange range;                         ///< see depth_range()
  float first_segment = 0.5f;               ///< length of the first segment, in lengths of the strand
  std::shared_ptr<const SkinSurface> skin;  ///< null: the picture has no skin
  /// The shape of each strand; null: the strands are those of fur layers that were grown.
  std::shared_ptr<const std::vector<StrandShape>> shapes;
};

}  // namespace pelage::strands
