// The double-precision reference for pictures of strands, written from docs/strands.md, section Drawing. It
// draws one strand at a time, visits every pixel near each segment, and sorts with std::stable_sort. It
// shares no code with the kernels.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands::reference {

/// Returns the curve of a strand between three of the key strands `keys`. `first_segment` is the length of
/// the first segment in lengths of the strand, above 0 and below 1. The strand's rank is the number of its
/// fur layer; the caller knows the look, and replaces the rank if the look orders the layers differently.
/// Stores in `magnified`, unless it is null, how much the curvature and the raising of the tip onto the skin
/// magnify an error of the direction w: the first if the strand is nearly upright, the second if w is nearly
/// orthogonal to the skin.
DrawnStrand between(const std::vector<KeyStrand>& keys, const KeyedStrand& strand, float first_segment,
                    double* magnified = nullptr);

/// The same for a curve of a strand of a file (docs/grooms.md, section "Motion"). `*magnified` also grows
/// with the length of the strand above 1 R, and with the offsets, most where a segment turns by nearly 180
/// degrees.
DrawnStrand shaped(const std::vector<KeyStrand>& keys, const KeyedStrand& strand, const StrandShape& shape,
                   float first_segment, double* magnified = nullptr);

/// Returns the number of segments of a curve that does not choose it by its bend.
int least_segments(const Look& look, const DrawnStrand& strand);

/// Returns half of the width of a strand at the parameter t of its curve, R.
double half_width(const Look& look, const DrawnStrand& strand, double t);

/// Returns the alpha of strand `number` at the parameter t of its curve.
double alpha_of(const Look& look, const DrawnStrand& strand, std::uint32_t number, double t);

/// Returns the strands that are drawn for the look's fraction and width factor (docs/strands.md, section
/// "Level of detail"), with their widths.
std::vector<DrawnStrand> pruned(const std::vector<DrawnStrand>& strands, const Look& look);

/// Returns the strands to draw, from front to back. The list contains no strands that face away from the
/// camera, unless `back` is BackFacing::drawn, none that are nearer than the near plane and none that are
/// beyond a side of the picture. Its operations are those of docs/strands.md in single precision, so that a
/// device must give the same list.
std::vector<Entry> drawing_order(const Camera& camera, const DepthRange& range,
                                 const std::vector<DrawnStrand>& strands,
                                 BackFacing back = BackFacing::removed);

/// Returns the light F of all fill lights on a surface with the unit normal n.
glm::dvec3 fill_light(const Look& look, glm::dvec3 n);

/// Draws the strands of `order`, which is a result of drawing_order(), above the skin. Without a skin
/// (`skin` is null), the strands hang in front of the background. Alpha of a pixel is 1 on the skin, and the
/// coverage of the strands elsewhere. The values in `look` must be in their valid ranges. All `strands` cast
/// shadows, also those that are not in `order`. The function does not use look.fraction. Stores the number of
/// fragments with an alpha above 0 in `fragments` unless it is null.
Picture draw(const Camera& camera, const Look& look, const std::vector<DrawnStrand>& strands,
             const std::vector<Entry>& order, const SkinSurface* skin = nullptr,
             std::uint64_t* fragments = nullptr);

/// The curve of one strand.
struct Curve {
  std::array<glm::dvec3, 3> p;  ///< control points
  glm::dvec3 at(double t) const { return (1 - t) * (1 - t) * p[0] + 2 * t * (1 - t) * p[1] + t * t * p[2]; }
  glm::dvec3 tangent(double t) const { return (1 - t) * (p[1] - p[0]) + t * (p[2] - p[1]); }
};

struct Vertex {
  glm::dvec2 place;  ///< pixels from the top left corner of the picture
  double half = 0;   ///< half of the strand's width, pixels
  double alpha = 0;
  glm::dvec3 colour{0};
  double depth = 0;  ///< depth in the view, R
};

struct Fragment {
  double alpha = 0;
  glm::dvec3 colour{0};
  double depth = 0;  ///< R
};

/// Receives a fragment, and the column and the row of its pixel.
using Visit = std::function<void(int x, int y, const Fragment& fragment)>;

/// Visits all fragments of the strip between the vertices, segment by segment, in a picture of the given
/// size.
void each_fragment(const std::vector<Vertex>& vertices, int width, int height, const Visit& visit);

/// A fragment of a strand in the light's view.
struct LightFragment {
  double alpha = 0;
  double depth = 0;  ///< R
};

/// The fragments of each texel, row by row, each texel in the order of the strands.
using LightColumns = std::vector<std::vector<LightFragment>>;

/// Returns the fragments of all strands in the light's view.
LightColumns light_columns(const Look& look, const LightView& view, const std::vector<DrawnStrand>& strands);

/// A texel of the opacity map.
struct Texel {
  double first = 0;    ///< z0; least depth of the texel's fragments, R
  double through = 1;  ///< 1 - A; 1 if there is no fragment
  double mean = 0;     ///< mean depth of the texel's fragments, weighted by their alphas, R
};
using OpacityMap = std::vector<Texel>;  ///< row by row

OpacityMap opacity_map(const LightColumns& columns);
OpacityMap opacity_map(const Look& look, const LightView& view, const std::vector<DrawnStrand>& strands);

/// Returns the part of the key light at the depth z (R) behind a texel, as look.shadow.reading defines it.
double texel_light(const Look& look, const Texel& texel, double z);

/// Returns the part of the key light that reaches a point (R, object's frame), as look.shadow.reading defines
/// it.
double key_light(const Look& look, const LightView& view, const OpacityMap& map, glm::dvec3 point);

/// The view of the key light, and its opacity map.
struct ShadowMap {
  LightView view;
  OpacityMap map;
};

/// Returns the opacity map of all strands; nothing if look.shadow.reading is `none`.
std::optional<ShadowMap> shadow_map_of(const Look& look, const std::vector<DrawnStrand>& strands);

/// Returns the colour of strand `number` at the parameter t of its curve.
glm::dvec3 strand_colour(const Camera& camera, const Look& look, const std::optional<ShadowMap>& shadow,
                         const DrawnStrand& strand, std::uint32_t number, double t);

/// What a pixel shows of the skin.
struct SkinPixel {
  glm::dvec3 colour{0};
  double depth = std::numeric_limits<double>::infinity();  ///< view depth, R; infinite: no skin
};

/// Returns the colour of each vertex of the skin. `shadow` may be null: no shadow.
std::vector<glm::dvec3> skin_colours(const Look& look, const SkinSurface& skin, const ShadowMap* shadow);

/// Returns the pixels of the camera's picture, row by row. `shadow` may be null: no shadow.
std::vector<SkinPixel> skin_pixels(const Camera& camera, const Look& look, const SkinSurface& skin,
                                   const ShadowMap* shadow);

/// Returns the part of a fragment with the view depth z that the skin does not hide.
double before_skin(const SkinPixel& pixel, double z);

}  // namespace pelage::strands::reference
