// Constants that the host passes to the rasterizer's kernels, for OpenCL C and C++. All members have four
// bytes. S = Silva et al. 2010, Curling and Clumping Fur Represented by Texture Layers; W = Silva et al.
// 2010, Real-Time Rendering of Wet Fur; B = Banisch and Wuethrich 2006, Making Grass and Fur Move.
#ifndef PELAGE_RASTERIZE_PARAMS_H
#define PELAGE_RASTERIZE_PARAMS_H

typedef struct {
  // Picture and camera (docs/shells.md, section 4).
  int width, height;
  // Rows of the camera matrix. Their products with (p, 1), for a point p, are x*w, y*w and w. Here w is the view depth
  // of p, and x and y are the position of p in the picture, in pixels from the image centre.
  float row_x[4], row_y[4], row_w[4];
  float ray[3], ray_dx[3], ray_dy[3];         // view ray through the image centre, and its change per pixel in x and y
  float near_depth;                           // view depth of the near plane, in R (mesh radii)
  // Geometry.
  // Length of each column of the vertex array: the number of drawn vertices, rounded up to a multiple of 16.
  int vertices;
  int triangles;
  int layers;                                 // N, the number of layers
  // Selects the Bezier parameter t of a layer at height h. 0 selects t = h; 1 selects t = 1 - sqrt(1 - h).
  int uniform_spacing;
  int sticks;                                 // 1: layers follow the sticks (B Eq. 4) instead of the Bezier curve
  int arcs;                                   // 1: layers of sticks lie on arcs (arc_offset()) instead of B Eq. 4
  float length;                               // L0, the fur's length, in R
  float curl_radius;                          // K_alpha, the curl's radius, in R
  // Number of tiles across and down the picture. The next members are constants for the triangle lists of the
  // tiles.
  int tiles_x, tiles_y;
  // Number of layers in a layer batch (a group of adjacent layers). A tile selects visible triangles once per
  // batch.
  int layer_batch;
  int layer_batches;                          // number of layer batches of this pass + 1 (the base surface is batch 0)
  // Layers of this pass: first_layer <= n < end_layer. If N layers need too much memory, several passes draw them.
  int first_layer, end_layer;
  int chunk;                                  // triangles per chunk; one work-item of bin_count processes one chunk
  int chunks;
  // 1: every triangle is drawn in all layers. 0: a triangle is not drawn in the outer layers in which the clumps (S
  // Algorithm 2) discard all fragments of the triangle.
  int every_layer;
  int faces;                                  // FACES_ALL, ...: the scene key blend.faces
  // Sweeps over the layers: from first_sweep to end_sweep - 1 in this launch, of `sweeps` in the whole picture. With
  // FACES_BACK_THEN_FRONT, sweep 0 draws the triangles that face the eye and sweep 1 the others. Otherwise there is one
  // sweep.
  int first_sweep, end_sweep, sweeps;
  // Clumps (S Eq. 5, Algorithm 2).
  int mask_size;
  float clump_shape;                          // w of S Eq. 5
  float clump_gain;
  int clump_scale;                            // CLUMP_LITERAL, ...: the reading of S Eq. 5 (scene key clump.scale)
  int clump_cells;                            // CELLS_SEPARATE, ...: the scene key clump.cells
  int film;                                   // 1: a smooth film of water replaces the clumps of soaked fur (docs/shells.md, section 11)
  float soaked;                               // the wetness from which on it does
  float film_height, film_gloss;              // the film's height as a fraction of L0, and the factor of its highlight
  // Maps of the fur's shape (docs/shells.md, section 8). Their arrays follow the layer table in its buffer; turn_points,
  // turn_angles and density_map are the indices of their first floats there.
  int turn_levels;                            // number of tabulated factors of curl.turns; 0: no map
  int turn_points;                            // one float per vertex: the number of its factor
  int turn_angles;                            // for each layer and factor: cosine and sine of the curl's angle
  float density;                              // fur.density
  float coverage_power;                       // fur.layer_correction: 16 / layers, or 1
  int density_width, density_height, density_map;
  // Textures.
  int fur_size, fur_levels;
  int shaded;                                 // 0: fur.shade is 0, and every strand has the shade 1; 1: the texture has the shades
  float fur_scale[2];                         // repeats of the fur texture per unit of u and of v
  float footprint;                            // pixel width at view depth 1, in texels of mip level 0, times 2^lod_bias
  int substeps;                               // texture samples per fragment of a layer: 1, 2, 4 or 8
  int coat_size;
  // Constants of the light equations (S Eq. 6, W Eq. 2-5). harness/scene/shading_models.cpp lists the shading models.
  // surface_light is 0 for the model "curling" and 1 for the models "wet" and "lambert". For "lambert" the host sets
  // specular, wrap and darkening to 0.
  int surface_light;                          // 1: diffuse light and self-shadow by W Eq. 2-5; 0: by S Eq. 6
  int self_shadow;                            // SHADOW_DARKENING, ...: the scene key shading.self_shadow
  int two_sided;                              // 1: normals that face away from the eye are reversed for lighting
  float shadow;                               // K_shadow
  float specular[3];                          // K_s
  float exponent;                             // p, the exponent of the highlight
  // If the exponent p of the highlight is an integer from 1 to 1024 and surface_light is 0, whole_exponent is p, else
  // 0. If surface_light is 1, the exponent of a fragment also depends on the wetness.
  int whole_exponent;
  float ambient, wrap;
  float occlusion, darkening, wet_specular;   // sigma_occ, sigma_wet, sigma_spec
  int tangent;                                // TANGENT_PAPER, ...: the reading of W Eq. 4 (scene key shading.tangent)
  int lights;
  union {                                     // unit vectors towards the lights
    // rusticl (Mesa 22.3) uses a wrong size for the array light[2][3]: it takes 2, the first dimension, as the number
    // of elements. The flat array is the first member of the union, so that rusticl uses the correct size.
    float lights_flat[6];
    float light[2][3];
  };
  float intensity[2];
  float skin[3], background[3];
} RasterParams;

// Triangles of the layers that are drawn, in the order of the values of the scene key blend.faces.
enum { FACES_ALL, FACES_FRONT, FACES_BACK_THEN_FRONT };
// The fourth number of a triangle's row in the table `corners`: the reach (reach.clh), plus FACES_AWAY if the base of the
// triangle faces away from the eye and blend.faces is not "all".
#define REACH_BITS 0xffff
#define FOOTPRINTS 4            // sizes of a pixel for which footprint_reach.clh computes the reach of a triangle
#define REPEAT_WORDS(mask_size) ((mask_size) / 32 + 4)  // words of a row of mask_repeats (footprint_reach.clh)
#define FACES_AWAY 0x10000

// Readings of S Eq. 5, in the order of the values of the scene key clump.scale.
enum { CLUMP_LITERAL, CLUMP_DISTANCE, CLUMP_CONVERGE };
// Borders of clumps, in the order of the values of the scene key clump.cells.
enum { CELLS_SEPARATE, CELLS_LITERAL, CELLS_CONSISTENT };
// Readings of W Eq. 4, in the order of the values of the scene key shading.tangent.
enum { TANGENT_PAPER, TANGENT_DRAWN, TANGENT_STRAND, TANGENT_PRINTED };
// How the fur shadows itself, in the order of the values of the scene key shading.self_shadow.
enum { SHADOW_DARKENING, SHADOW_OFF, SHADOW_TRACED };
#define TRACED_LAYERS 16        // SHADOW_TRACED: most layers whose fur is sampled between a fragment and the light
// Greatest rho f(h) with CLUMP_CONVERGE. Strands with rho f(h) = 1 would meet in one point.
#define CLOSEST 0.98f

// CELLS_SEPARATE: two texels of the mask belong to the same clump if the centres of their clumps are in the same cell of a
// grid with this many cells per side of a texel. Where many droplets overlap, the centres of two clumps may differ by less
// than rounding errors.
#define CELLS_PER_TEXEL 64.0f

// Columns of the layer table: h, cos(omega h), sin(omega h), ln h, and the power of h in B Eq. 4. Only the host
// computes these values, so that all devices use the same bits.
enum { LAYER_H, LAYER_COS, LAYER_SIN, LAYER_CURVE, LAYER_POWER, LAYER_COLUMNS };

// Columns of the vertex array. VERTEX: the position. ROOT: the vector A of docs/shells.md, section 3. With `fur.binding`
// "shared", A is the weighted mean, over the triangles around the vertex, of the fur's length L0 times the normal n of
// the triangle. CURL_U and CURL_V: the two axes of the curl.
enum { VERTEX_X, VERTEX_Y, VERTEX_Z, ROOT_X, ROOT_Y, ROOT_Z, CURL_UX, CURL_UY, CURL_UZ, CURL_VX, CURL_VY, CURL_VZ,
       VERTEX_COLUMNS };

// Number of floats in a vertex's row of an attribute buffer. There are three buffers. A row of the first buffer holds
// the texture coordinates u and v and the vectors A and B. A row of the second buffer holds the tangents dX/du and
// dX/dv. A row of the third buffer holds the two axes of the curl (docs/shells.md, section 3). The last two floats of
// the second and third buffer's rows are unused.
#define RECORD 8

// Width and height of a tile in pixels: multiples of 4, at most 32. tuning.toml lists other values, which `pelage tune`
// times.
#ifndef TILE_W
#define TILE_W 32
#endif
#ifndef TILE_H
#define TILE_H 32
#endif

#define SUBPIXEL 256            // screen coordinates are rounded to 1/256 pixel
#define GUARD 16384.0f          // triangles are clipped at this distance from the image centre, in pixels
#define OPAQUE 0.001953125f     // 1/512; a pixel whose transmittance is at most OPAQUE receives no more fragments

#endif
