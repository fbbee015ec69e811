// Sections of the fur and curves of the papers' equations, as tables of numbers that the reference computes.
// docs/experiments.md describes the columns. harness/report/plots/section.py draws the tables.
#pragma once
#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/strands/scene/strand_input.hpp"

namespace pelage::diagrams {

struct Section {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< one value per column
};

/// Returns the section as CSV, with nine significant digits.
std::string csv_of(const Section& section);

/// The factor f(h) of a clump's displacement (S Eq. 5) for clump.shape 0, .25, .5, .75 and 1, at the heights
/// of the scene's layers. Columns: w, h, f.
Section shape_section(const Scene& scene);

/// The strands of one clump in a vertical plane through its centre, with the scene's readings. The clump has
/// the radius wetness.radius and the wetness wetness.wetness; its centre has the UV 0. The strands stand
/// upright at equal distances, two radii to each side. Columns: strand, inside (1 in the clump, else 0),
/// layer (-1 for the root), h, f, root (UV), u (UV at which the strand is drawn on the layer), d (root - u:
/// the displacement of S Eq. 5), x (u in R, for `length_per_uv` R per unit of UV) and y (height over the
/// surface, R).
Section clump_section(const Scene& scene, double length_per_uv);

/// The curl of an upright strand (S Eq. 1 and 4) for the wetness 0, .5 and 1. Columns: rho, h, x, y (offset
/// by the curl along u and v, R) and z (height over the surface, R).
Section curl_section(const Scene& scene);

/// The layers of the fur above the cut of the mesh by the plane z = 0, after `frames` frames. A row is an end
/// of a cut triangle's segment on a layer. Columns: segment, end (0 or 1), layer (-1 for the base surface),
/// h, x and y (position, R). The points of a layer lie where the strands of the cut reach it, which may be in
/// front of the plane or behind it.
Section layer_section(const FrameInput& input, int frames);

/// The path of a strand's tip in the pictures of the times 0, d, 2 d, ..., dynamics.time, where d is the
/// duration of a frame, with the reference. The function simulates about `most` strands (sticks, or key
/// strands), and takes the one whose tip is once farthest from its position at rest. Columns: t (s), x and y
/// (position of the tip relative to the root, R: y along the surface normal, x along the part of the greatest
/// displacement that is orthogonal to the normal), rest_x and rest_y (the same at rest), apart (distance from
/// the position at rest, in lengths of the strand).
Section path_section(const FrameInput& input, std::size_t most);
Section path_section(const strands::StrandInput& input, std::size_t most);

// Lines over a picture of the fur: the strands of the mass-spring model, as in S Fig. 4 (a), and the
// direction of the wind, as in S Fig. 4 (b).

/// Points on a strand from its root to its tip, in R.
using Curve = std::vector<glm::dvec3>;

/// Returns the curves of the strands (docs/shells.md, section 3, without the curl). `tips` are the simulated
/// tips relative to the roots (FrameOutput::tips): one strand per triangle for Silva's model; one per surface
/// point, or per triangle corner, for a mass-spring topology. If there are more than `most` strands, the
/// function takes `most` of them at equal distances in this order.
std::vector<Curve> strand_curves(const FrameInput& input, const std::vector<glm::vec3>& tips,
                                 std::size_t most);

/// Draws the curves as white lines of `width` pixels over `picture`, which has the size of input.camera. A
/// pixel of a line is drawn if no triangle of the base surface is nearer to the eye there. The fur hides no
/// line. Parts of a curve nearer than the near plane are not drawn.
void draw_strands(Picture& picture, const FrameInput& input, const std::vector<Curve>& curves, double width);

/// Whether a pixel of a line is drawn. `along` is the place on the line, 0 at its start and 1 at its end.
using Visible = std::function<bool(int x, int y, double along)>;

/// Blends a line from `a` to `b` over the picture. Positions are in pixels from the picture's upper left
/// corner; pixel (i, j) has its centre at (i + .5, j + .5). `width` is the width of the line in pixels; its
/// border is one pixel wide. colour.a is the opacity. Parts outside the picture, and pixels for which
/// `visible` returns false, are not drawn.
void draw_line(Picture& picture, glm::dvec2 a, glm::dvec2 b, double width, const glm::vec4& colour,
               const Visible& visible = {});

/// Draws a red arrow along dynamics.wind.direction over `picture`, which has the size of input.camera. The
/// arrow's middle is above the picture's centre, an eighth of the height below the upper border. It has the
/// view depth of the origin, so that the arrow has the perspective of the model. In space its length is a
/// quarter of the picture's height at that depth. `width` is the width of its lines in pixels. Throws
/// InputError if the scene has no wind, or if the wind blows along the line of sight.
void draw_wind_arrow(Picture& picture, const FrameInput& input, double width);

// The wetness mask as a picture, with the triangles of the UV map over it, as in the insets of S Fig. 5, 11
// and 12 and W Fig. 1, 3 and 6 (docs/experiments.md), and the textures of the fur, as in S Fig. 3.

/// Edges of triangles are drawn only if their mean length is at least this number of pixels.
inline constexpr double least_edge = 6.0;

/// Returns the colour of a mask texel. `clump` is the centre (c_u, c_v) of the texel's clump, its radius and
/// its wetness rho. Dry texels (rho = 0) are black. The colour of a wet texel is proportional to rho. Its hue
/// depends only on the centre, so that neighbouring clumps have different blues.
glm::vec3 clump_colour(const glm::vec4& clump);

/// Draws the mask into a picture of side x side pixels; the top row is at v = 1. `mask` has wetness.size^2
/// texels, and its first row is at v = 0. A texel is (c_u, c_v, radius, wetness). A pixel has the colour of
/// the mask's lookup at its centre (docs/shells.md, section 2), and is grey outside the UV map. Over it, the
/// borders and seams of the UV map are drawn in white and the edges of its triangles in a weaker white; the
/// edges are left out if they would be shorter than least_edge on average.
Picture mask_picture(const FrameInput& input, const std::vector<glm::vec4>& mask, int side);

/// Returns the coat's texture, one pixel per texel; the top row is at v = 1.
Picture coat_picture(const CoatTexture& coat);

/// Returns four slices of the fur's texture side by side, with a grey line of 8 pixels between them: those of
/// the layers floor(N (2 i + 1) / 8), i = 0..3. A slice shows the 64 x 64 texels from (u, v) = 0 on (the
/// whole slice if it is smaller) on 256 x 256 pixels. The value of a pixel is the square root of the coverage
/// times the strand's shade, divided by the greatest value of the four slices. v increases upwards.
Picture slices_picture(const FurTexture& fur);

}  // namespace pelage::diagrams
