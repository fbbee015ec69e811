// Constants that the host passes to the kernels that draw strands, for OpenCL C and C++. All members have four bytes.
// docs/strands.md, section Drawing, defines the picture. R is the radius of the mesh's bounding sphere.
#ifndef PELAGE_STRANDS_DRAW_PARAMS_H
#define PELAGE_STRANDS_DRAW_PARAMS_H

typedef struct {
  int width, height;           // size of the picture, pixels
  int tiles_x, tiles_y;        // number of tiles across and down the picture
  // Rows of the camera matrix. Their products with (p, 1), for a point p in the object's frame, are X, Y and W. W is the
  // view depth in R. X and Y are W times the distance from the image centre in pixels.
  float row_x[4], row_y[4], row_w[4];
  float eye[3];                // R
  float near_depth;            // view depth of the near plane, R
  float pixel;                 // side of a pixel at the view depth 1, R
  float half_per_width;        // 0.5 / pixel
  float nearest, per_depth;    // view depth of the first depth step, R; number of depth steps per R
  float first_segment;         // length of the first segment, in lengths of the strand
  float slope;                 // length of the second segment divided by the length of the first segment
  int strands;                 // number of strands that are drawn: the first ones (docs/strands.md, section "Level of detail")
  float widen, per_fade;       // factor of all widths; 1 / number of strands that fade
  int units;                   // number of units of LANES strands
  int runs;                    // number of runs; one work-item of strand_keys computes one run
  int units_per_run;
  int capacity;                // number of pairs for which a run has room
  int keep_curves;             // 1: strand_keys also writes the curves
  int is_map;                  // 1: an opacity map is drawn (STRAND_MAP)
  int back_facing;             // what happens to strands that face away from the eye: a BACK_ constant
  int block_side;              // BLOCK_SIDE of the kernel that draws the tiles
  int chunks;                  // number of chunks of the sorted list; one work-item of strand_bin_count counts one chunk
  // Look (harness/strands/drawing/drawing.hpp).
  int segments;                // greatest number of segments of a curve
  int strand_segments;         // number of segments of a whole strand of a file, over all its curves
  int own_segments;            // 1: each strand has as many segments as it needs, at most `segments`
  float taper, opacity;
  float light[3];              // unit vector towards the key light in camera axes: right, down, forward
  float intensity, ambient, exponent;
  int whole_exponent;          // the exponent if it is an integer from 1 to 1024 and that of all layers, else 0
  float specular[3], background[3];
  float fill[27];              // irradiance of the fill lights: nine coefficients each for red, green and blue
  float rim[3], rim_exponent;
  float skin_shadow, skin_shadow_height;
  // The opacity map. The products of these rows with (X, Y, W, 1) are the column and the row of a point in the map, in
  // texels from the centre of the first texel, and the depth in R, which grows away from the light.
  float map_x[4], map_y[4], map_z[4];
  float per_shadow_length;     // 1 / mean length of the strands, 1/R
  int map_size;                // texels per side of the map
} DrawParams;

// Columns of the table of the drawn strands' constants. The keys of a strand are the key strands at the corners of its
// triangle. KEY: indices of the three keys (bits of integers). WEIGHT: barycentric weights of the second and third key.
// LENGTH and WIDTH are in R. COLOUR: one byte each for red, green, blue and the number of the fur layer, the lowest
// byte first. RESPONSE: factor of the movement. TWIST and CURVATURE: cosine and sine of the angle, in 16 bits each and in units
// of 1/32767, the cosine in the lower bits. Kernels that are built with STRAND_STYLES 0 do not use the last three columns.
enum { DRAWN_KEY, DRAWN_WEIGHT = 3, DRAWN_LENGTH = 5, DRAWN_WIDTH, DRAWN_COLOUR, DRAWN_RESPONSE, DRAWN_TWIST, DRAWN_CURVATURE,
       DRAWN_COLUMNS };

// 1: some strand has a response other than 1, or a twist or a curvature other than 0.
#ifndef STRAND_STYLES
#define STRAND_STYLES 1
#endif

// 1: the curves are parts of strands of a file.
#ifndef STRAND_SHAPES
#define STRAND_SHAPES 0
#endif

// Columns of the table of the curves' shapes: the part of the strand, from 0 (root) to 1 (tip); the width at the end of the
// part divided by that at its start; and the control points at rest, from those points of the straight strand that are at
// the start, in the middle and at the end of the part, in R. Kernels that are built with STRAND_SHAPES 0 do not read it.
enum { SHAPE_FROM, SHAPE_TO, SHAPE_WIDTH_END, SHAPE_OFFSET, SHAPE_COLUMNS = SHAPE_OFFSET + 9 };

// Floats in the record of a key strand. Vectors are in the object's frame: position of the root in R, normal of the skin,
// the directions u and w of the two segments, and the direction d of the strand at rest; one unused float.
#define KEY_RECORD 16

// Columns of the curves: the control points root, joint and tip in R, and the normal at the root, in the object's frame.
enum { CURVE_ROOT, CURVE_JOINT = 3, CURVE_TIP = 6, CURVE_NORMAL = 9, CURVE_COLUMNS = 12 };

// Strands that face away from the eye are not listed; or they are sorted behind all others and not drawn; or they are
// drawn.
#define BACK_REMOVED 0
#define BACK_LAST 1
#define BACK_DRAWN 2
#define LAST_KEY 0xffffffffu   // sort key of strands that face away from the eye with BACK_LAST

// Floats in the row of a strand: X, Y and W of root, joint and tip; half of the width at the root divided by the side of a
// pixel at the view depth 1; the bits of the colour, with the number of the film frame in the highest byte; the heights of
// joint and tip above the skin, divided by skin_shadow_height times the length of the strand; red, green and blue of the
// light that does not change along the strand: ambient light, fill lights and rim light. Kernels that are built with
// STRAND_LIGHTS 0 do not use the last five floats.
#define STRAND_ROW 16
// With STRAND_SHAPES 1, a row has four more floats: the start and the end of the part, the width at its end divided by that
// at its start, and the height of its start above the skin, divided as the other heights are.
#define SHAPED_ROW 20
#define ROW_FLOATS (STRAND_SHAPES ? SHAPED_ROW : STRAND_ROW)

// 1: the look has fill lights, a rim light, a shadow of the skin, a film strip, or fur layers with looks of their own.
#ifndef STRAND_LIGHTS
#define STRAND_LIGHTS 1
#endif

// 1: some fur layer has a factor of its look other than 1.
#ifndef STRAND_LAYERS
#define STRAND_LAYERS 0
#endif

// 1: the kernels draw the opacity map of the key light instead of a picture. The rows of the camera matrix then are those of
// the light's view (harness/strands/drawing/drawing.hpp), and W is the depth. Because the projection is parallel, X and Y
// are not divided by W. A texel has two floats: the least depth of its fragments in R, and their transmittance 1 - A.
// strand_keys reads p->is_map instead, so that the picture and its map share a program.
#ifndef STRAND_MAP
#define STRAND_MAP 0
#endif
// 1: the skin hides the strands behind it (docs/strands.md, section Skin).
#ifndef STRAND_SKIN
#define STRAND_SKIN 0
#endif
// Depth behind the skin, in R, at which a strand becomes invisible: 2^-7.
#define SKIN_FADE 0.0078125f
// Readings of the opacity map.
#define SHADOW_NONE 0
#define SHADOW_LINEAR 1
#define SHADOW_EXPONENTIAL 2
#ifndef STRAND_SHADOW
#define STRAND_SHADOW SHADOW_NONE
#endif
#define LEAST_THROUGH 9.5367431640625e-7f    // least transmittance whose logarithm is the optical depth of a texel, 2^-20
#define NO_DEPTH 1e30f                       // depth of a texel without fragments, and of a pixel without skin

// Integers in a frame of the film strip: its samples, and then the bits of the layer's factors of opacity, taper, gloss,
// exponent and skin_shadow.
// Kernels that are built with STRAND_LAYERS 0 do not use the factors. If they are not all 1, each layer has frames of its own.
#define FILM_SAMPLES 8
#define FILM_OPACITY 8
#define FILM_TAPER 9
#define FILM_GLOSS 10
#define FILM_EXPONENT 11
#define FILM_SKIN_SHADOW 12
#define FILM_RECORD 13

// Integers in the record of a fur layer: its rank, its first film frame, its number of film frames, and the bits of its three
// factors of the rim light and of its factor of rim_exponent; one unused integer.
#define LAYER_RIM 3
#define LAYER_RIM_EXPONENT 6
#define LAYER_RECORD 8

// Width of a tile in pixels: 16, 32, 64 or 128. A tile is square and has at most 16 x 16 blocks of 8 x 8 pixels.
#ifndef STRAND_TILE
#define STRAND_TILE 64
#endif
#if STRAND_TILE == 128
#define BLOCK_SIDE 8
#else
#define BLOCK_SIDE 4
#endif
#ifndef TILE_BLOCKS  // tiles of 64 and of 128 pixels have as many blocks, so they can share the program bins.cl
#define TILE_BLOCKS (STRAND_TILE / BLOCK_SIDE)
#endif

#define MOST_SEGMENTS 7
// The keys have one depth step more than this number.
#define LAST_DEPTH_STEP 16777215.0f
// A pixel whose transmittance is at most this number may miss the strands behind.
#define STRAND_OPAQUE 0.001953125f

#endif
