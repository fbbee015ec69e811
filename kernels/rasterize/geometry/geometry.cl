// Computes the vertices of a frame: the strands' tips at the vertices, the screen positions of the vertices in all
// layers, and for each vertex and layer batch the bounding box of the screen positions. bin.clh reads these boxes. A
// work-item computes LANES vertices. PoCL takes 25 ms to preprocess each program, even if its cache contains the
// compiled program. To save this time, the kernels of bin.clh are part of this program.
#if CONTACT
#include "common/contact.clh"
#endif
#include "rasterize/coverage/fan.clh"
#include "rasterize/geometry/bin.clh"
#include "rasterize/geometry/transform.clh"

// Computes the tip B of each vertex: the sum of weight * q over the strands around it, where q is a strand's tip minus
// its root. The vertices are divided into blocks of LANES vertices. Each vertex has a list of strands, padded to
// the length of the longest list in its block. Entry e of the list of vertex i of a block is at
// (slice[block] + e) * LANES + i. Padding entries have weight 0. tips: columns q_x, q_y, q_z of length strand_stride.
__kernel void vertex_tips(RasterParams s, TABLE(int) slice, TABLE(int) strand, TABLE(float) weight, TABLE(float) tips,
                          int strand_stride, __global float *tip) {
  int block = (int)get_global_id(0);
  if (block * LANES >= s.vertices) return;
  real3 b = vec3(REAL(0.0f), REAL(0.0f), REAL(0.0f));
  for (int e = slice[block]; e < slice[block + 1]; ++e) {
    whole f = load_whole(strand, e);
    real w = load_real(weight, e);
    b = along3(b, w, vec3(gather(tips, f), gather(tips + strand_stride, f), gather(tips + 2 * (size_t)strand_stride, f)));
  }
  store_real(b.x, tip, block);
  store_real(b.y, tip + s.vertices, block);
  store_real(b.z, tip + 2 * (size_t)s.vertices, block);
}

static inline Corner corner(const RasterParams *s, TABLE(float) vertex, TABLE(float) tip, TABLE(float) dry, TABLE(float) table,
                            int block) {
  Corner c;
  c.position = column3(vertex, VERTEX_X, s->vertices, block);
  c.a = column3(vertex, ROOT_X, s->vertices, block);
  c.b = column3(tip, 0, s->vertices, block);
  c.u = column3(vertex, CURL_UX, s->vertices, block);
  c.v = column3(vertex, CURL_VX, s->vertices, block);
  c.curl_share = load_real(dry, block);
#if TURNS_MAP
  c.turn = load_real(table + s->turn_points, block);
#endif
  return c;
}

// The bounding boxes of LANES vertices. The box of a vertex contains its screen positions in one layer or in several
// layers. The unit is one pixel, and the origin is the image's top left corner. The box contains pixel centres only, so
// left and top are rounded up, and right and bottom are rounded down. most, least: greatest and least 1/w of the vertex in these layers.
typedef struct { whole left, top, right, bottom; real most, least; } Bounds;

static inline Bounds nothing(void) {
  Bounds b = {WHOLE(32767), WHOLE(32767), WHOLE(-32768), WHOLE(-32768), REAL(0.0f), REAL(INFINITY)};
  return b;
}

static inline Bounds both(Bounds a, Bounds b) {
  Bounds c = {min(a.left, b.left), min(a.top, b.top), max(a.right, b.right), max(a.bottom, b.bottom), fmax(a.most, b.most), fmin(a.least, b.least)};
  return c;
}

// Returns the box of one position. A vertex that needs clipping may be anywhere, so it gets an unlimited box.
static inline Bounds bounds_of(const RasterParams *s, Screen v) {
  truth clipped = v.iw == REAL(0.0f);
  whole x = v.x + WHOLE(128 * s->width - 128), y = v.y + WHOLE(128 * s->height - 128);
  Bounds b;
  b.left = clipped ? WHOLE(-32768) : (x + WHOLE(SUBPIXEL - 1)) >> 8;
  b.top = clipped ? WHOLE(-32768) : (y + WHOLE(SUBPIXEL - 1)) >> 8;
  b.right = clipped ? WHOLE(32767) : x >> 8;
  b.bottom = clipped ? WHOLE(32767) : y >> 8;
  b.most = clipped ? REAL(INFINITY) : v.iw;
  b.least = v.iw;
  return b;
}

// Writes bounds in the format that box_of() in boxes.clh reads.
static inline void store_bounds(Bounds b, __global float *box, int block) {
  real4 row = {bits_as_real((b.left & 0xffff) | (b.top << 16)), bits_as_real((b.right & 0xffff) | (b.bottom << 16)), b.most,
               b.least};
  store_rows(row, box, block);
}

// Computes the vertices of the base and of the pass's layers. A pass draws a range of the layers (params.h).
// screen: one row for each layer and vertex, which holds x, y and 1/w. x and y are integers, stored as the bits of
// floats. Their unit is 1/256 pixel, and their origin is the image centre. The rows of layer n start at screen_row(n).
// box: one row for each layer batch and vertex. The row holds the bounding box of the vertex's screen positions in the
// layers of the batch, and the greatest and the least 1/w of these positions. The row of vertex i in batch g starts at
// 4 * (g * vertices + i). Batch 0 is the base, and each of the batches 1 to layer_batches - 1 consists of adjacent
// layers. One more batch, with the index layer_batches, contains the base and all layers of the pass.
// With CONTACT, the colliders of the table `contact` at the time number `time` push the vertices towards their roots, and the
// fourth number of a row is the share of the displacement that remains.
// If a vertex needs clipping, its 1/w in `screen` is 0, and in `box` its greatest 1/w is infinite and its least 1/w is 0.
CALLED void vertices_of_block(const RasterParams *restrict s, TABLE(float) vertex, TABLE(float) tip, TABLE(float) dry,
                              TABLE(float) table, TABLE(float) contact, TABLE(float) field, int time,
                              __global float *screen, __global float *box, int block) {
  Corner c = corner(s, vertex, tip, dry, table, block);
#if CONTACT
  Colliders colliders = colliders_at(contact, field, time);
#endif
  Bounds all = nothing();
  for (int g = 0; g < s->layer_batches; ++g) {
    int first = g == 0 ? -1 : s->first_layer + (g - 1) * s->layer_batch;
    int last = g == 0 ? 0 : min(first + s->layer_batch, s->end_layer);
    Bounds bounds = nothing();
    for (int n = first; n < last; ++n) {
      Layer l = layer_at(s, table, n);
      real kept = REAL(0.0f);
#if CONTACT
      c.share = n < 0 ? REAL(1.0f) : kept_share(colliders, c.position, displacement(s, l, c));
      kept = c.share;
#endif
      Screen v = to_screen(s, to_clip(s, l, c));
      real4 row = {bits_as_real(v.x), bits_as_real(v.y), v.iw, kept};
      store_rows(row, screen + 4 * screen_row(s, n), block);
      bounds = both(bounds, bounds_of(s, v));
    }
    store_bounds(bounds, box + (size_t)g * s->vertices * 4, block);
    all = both(all, bounds);
  }
  store_bounds(all, box + (size_t)s->layer_batches * s->vertices * 4, block);
}
__kernel void layer_vertices(RasterParams s, TABLE(float) vertex, TABLE(float) tip, TABLE(float) dry, TABLE(float) table,
                             __global float *screen, __global float *box
#if CONTACT
                             , TABLE(float) contact, TABLE(float) field, int time
#endif
) {
  int block = (int)get_global_id(0);
  if (block * LANES >= s.vertices) return;
#if !CONTACT
  TABLE(float) contact = 0;
  TABLE(float) field = 0;
  int time = 0;
#endif
  vertices_of_block(&s, vertex, tip, dry, table, contact, field, time, screen, box, block);
}

// Returns whether the polygon that is left of a clipped triangle of the base faces away from the eye. The polygon is
// convex, so all triangles of its fan have the same winding.
CALLED bool clipped_away(const RasterParams *s, Geometry m, int v0, int v1, int v2) {
  Cut polygon[POLYGON];
  int corners = clipped_triangle(s, m, layer_at(s, m.layer_table, -1), v0, v1, v2, polygon);
  long sum = 0;
  for (int i = 0; i < corners; ++i) {
    int lanes[4][LANES];
    Screen p = cut_on_screen(polygon[i], 0, 0), q = cut_on_screen(polygon[i + 1 == corners ? 0 : i + 1], 0, 0);
    spill_whole(p.x, lanes[0]);
    spill_whole(p.y, lanes[1]);
    spill_whole(q.x, lanes[2]);
    spill_whole(q.y, lanes[3]);
    sum += (long)lanes[0][0] * lanes[3][0] - (long)lanes[2][0] * lanes[1][0];
  }
  return sum > 0;
}

// Finds the triangles whose base faces away from the eye, after layer_vertices. The corners of a triangle are in
// counter-clockwise order, seen from outside, so their signed area is below 0 in the picture (y down) if the base faces
// the eye. The area is that of the rounded screen positions. A triangle of area 0 counts as facing the eye. Sets or
// clears FACES_AWAY in the fourth number of the triangle's row.
__kernel void triangle_facing(RasterParams s, __global int *corners, TABLE(float) screen, TABLE(float) vertex, TABLE(float) tip,
                              TABLE(float) dry, TABLE(float) table) {
  Geometry m = {0, screen, vertex, tip, dry, table, 0};
  for (int block = (int)get_global_id(0); block * LANES < s.triangles; block += (int)get_global_size(0)) {
    __global int *row = corners + 4 * (size_t)block * LANES;
    int v[3][LANES], away[LANES];
    for (int k = 0; k < LANES; ++k)
      for (int c = 0; c < 3; ++c) v[c][k] = row[4 * k + c];
    real4 a = gather_rows(screen, fill_whole(v[0])), b = gather_rows(screen, fill_whole(v[1])), c = gather_rows(screen, fill_whole(v[2]));
    whole ax = bits_as_whole(a.x), ay = bits_as_whole(a.y);
    wide area = to_wide(bits_as_whole(b.x) - ax) * to_wide(bits_as_whole(c.y) - ay) -
                to_wide(bits_as_whole(c.x) - ax) * to_wide(bits_as_whole(b.y) - ay);
    spill_whole(to_real(area) > REAL(0.0f) ? WHOLE(1) : WHOLE(0), away);
    uint clipped = bits_of(lesser(a.z, lesser(b.z, c.z)) == REAL(0.0f));
    for (int k = 0; k < LANES; ++k) {
      if (clipped >> k & 1) away[k] = clipped_away(&s, m, v[0][k], v[1][k], v[2][k]);
      row[4 * k + 3] = (row[4 * k + 3] & REACH_BITS) | (away[k] ? FACES_AWAY : 0);
    }
  }
}

// Writes the attribute row of each vertex: the texture coordinates u, v, and the vectors A and B of docs/shells.md,
// section 3.
__kernel void vertex_records(RasterParams s, TABLE(float) vertex, TABLE(float) tip, TABLE(float) uv, __global float *record) {
  size_t v = (size_t)s.vertices;
  FOR_EACH(i, s.vertices) {
    __global float *out = record + (size_t)i * RECORD;
    out[0] = uv[2 * i];
    out[1] = uv[2 * i + 1];
    for (int k = 0; k < 3; ++k) {
      out[2 + k] = vertex[(ROOT_X + k) * v + i];
      out[5 + k] = tip[k * v + i];
    }
  }
}

// Writes the two axes of the curl at each vertex, multiplied by the vertex's dryness: (1 - rho) u and (1 - rho) v,
// where rho is the wetness and u and v are unit vectors. With TURNS_MAP, the seventh float is the number of the factor of
// curl.turns. table: the layer table.
__kernel void vertex_curls(RasterParams s, TABLE(float) vertex, TABLE(float) dry, TABLE(float) table, __global float *curls) {
  FOR_EACH(i, s.vertices) {
    __global float *out = curls + (size_t)i * RECORD;
    for (int k = 0; k < 3; ++k) {
      out[k] = dry[i] * vertex[(size_t)(CURL_UX + k) * s.vertices + i];
      out[3 + k] = dry[i] * vertex[(size_t)(CURL_VX + k) * s.vertices + i];
    }
    out[6] = out[7] = 0.0f;
#if TURNS_MAP
    out[6] = table[s.turn_points + i];
#endif
  }
}
