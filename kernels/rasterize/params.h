// What the host tells the rasterizer; read by OpenCL C and by C++. Four-byte members only.
#ifndef PELAGE_RASTERIZE_PARAMS_H
#define PELAGE_RASTERIZE_PARAMS_H

typedef struct {
  // Picture and camera (docs/frame.md, 4).
  int width, height;
  float row_x[4], row_y[4], row_w[4];         // dot with (p, 1): pixels from the image centre times w; view depth w
  float ray[3], ray_dx[3], ray_dy[3];         // view ray through the centre, its change per pixel
  float near_depth;                           // R
  // Geometry.
  int vertices;                               // columns' length: corners or copies, rounded up to a multiple of 16
  int triangles;
  int layers;                                 // N
  int uniform_spacing;                        // 0: t = h; 1: t = 1 - sqrt(1 - h)
  int sticks;                                 // 1: layers lie by B Eq. 4, not on the Bezier curve
  float length;                               // L0, R
  float curl_radius;                          // K_alpha, R
  // Tiles and the triangles in them.
  int tiles_x, tiles_y;
  int layer_batch;                            // layers of which a tile decides together what it leaves out
  int layer_batches;                          // one for the base, then ceil((end_layer - first_layer) / layer_batch)
  int first_layer, end_layer;                 // what a pass draws: all of 0 .. N - 1, or a part where all at once need too much memory
  int chunk;                                  // triangles counted together
  int chunks;
  int every_layer;                            // 1: draw triangles in layers that their clumps do not reach, too
  // Clumps (S Eq. 5, Algorithm 2).
  int mask_size;
  float clump_shape;                          // w
  float clump_gain;
  int clump_literal;                          // scale by r_mask instead of the gain
  int clump_separate;                         // discard where the centre at p + d is another clump's
  float log_layers;                           // k = ln N
  // Textures.
  int fur_size, fur_levels;
  float fur_scale[2];                         // repeats per unit of u and v
  float footprint;                            // of a pixel at view depth 1, texels of level 0 times 2^bias
  int substeps;                               // looks into a fragment's layer: 1, 2, 4 or 8
  int coat_size;
  // Light (S Eq. 6; W Eq. 2-5).
  // The models of shading (harness/scene/shading_models.cpp). "curling": surface_light 0. "wet": surface_light 1.
  // "lambert": surface_light 1, and the host sets specular, wrap and darkening to 0.
  int surface_light;                          // 1: diffuse light and shadow of the surface, W Eq. 2-5; 0: of the strand, S Eq. 6
  int two_sided;                              // 1: normals that face away from the eye are reversed before light
  float shadow;                               // K_shadow
  float specular[3];                          // K_s
  float exponent;                             // p
  int whole_exponent;                         // p where it is whole and the same everywhere, else 0
  float ambient, wrap;
  float occlusion, darkening, wet_specular;   // sigma_occ, sigma_wet, sigma_spec
  float drawn;                                // +1: W Eq. 4 as printed; -1: the strand leans as drawn
  int lights;
  union {                                     // unit, towards the light
    float lights_flat[6];                     // first: of arrays of arrays rusticl (Mesa 22.3) takes the outer length for the size
    float light[2][3];
  };
  float intensity[2];
  float skin[3], background[3];
} RasterParams;

// A layer's numbers that only the host computes, so that every device sees the same bits.
enum { LAYER_H, LAYER_COS, LAYER_SIN, LAYER_LOG, LAYER_POWER, LAYER_COLUMNS };

// Columns of the vertex array: position, A = sum weight L0 normal, the curl frame, and 1 - rho.
enum { VERTEX_X, VERTEX_Y, VERTEX_Z, ROOT_X, ROOT_Y, ROOT_Z, CURL_UX, CURL_UY, CURL_UZ, CURL_VX, CURL_VY, CURL_VZ,
       VERTEX_COLUMNS };

// One attribute record per vertex: u, v, A, B; and, for the wet model, dX/du and dX/dv.
#define RECORD 8

// A tile's pixels: multiples of 4, at most 32 (tuning axes).
#ifndef TILE_W
#define TILE_W 32
#endif
#ifndef TILE_H
#define TILE_H 32
#endif

#define SUBPIXEL 256            // screen coordinates are rounded to 1/256 pixel
#define GUARD 16384.0f          // pixels from the image centre; beyond it triangles are clipped
#define OPAQUE 0.001953125f     // a pixel stops once its transmittance is at most 1/512

#endif
