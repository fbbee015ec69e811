// Draws the skin below the strands: the colour and the view depth of the nearest triangle at each pixel. docs/strands.md,
// section Skin, defines the operations. skin_vertices computes the vertices. skin_depth finds the least depth of each pixel.
// skin_owner finds the triangle with this depth, and of equal depths the one with the lowest number, so that the picture does
// not depend on the order of the work-items. skin_colours writes the pixels.
//
// A work-item processes `per_item` groups. A group has LANES vertices, triangles or pixels. Each array that the kernels write has
// room for a multiple of 16 elements.
#include "strands/draw/curve.clh"
#include "strands/draw/fills.clh"
#include "strands/draw/shadow.clh"

// Number of floats of a vertex. In this order they are: X, Y and W; the column and the row in the picture, in pixels from the
// centre of the first pixel; red, green and blue.
#define VERTEX_RECORD 8
#define NO_OWNER 0x7fffffff

// Visits the elements of work-item `item`, LANES elements at a time. `first` is the number of the first of these elements.
#define FOR_EACH_GROUP(first, count) \
  for (int first = item * per_item * LANES, end_ = min(first + per_item * LANES, count); first < end_; first += LANES)

INLINE real3 gather3(TABLE(float) vectors, whole i) {
  return vec3(gather(vectors, 3 * i), gather(vectors, 3 * i + 1), gather(vectors, 3 * i + 2));
}

// Returns the dot product of v and the first three numbers of a row of the camera matrix.
INLINE real turned(const float *row, real3 v) { return fma(v.z, REAL(row[2]), fma(v.y, REAL(row[1]), v.x * REAL(row[0]))); }

// position, normal, colour: three floats per vertex. map: the opacity map of the key light.
CALLED void skin_vertices_of(const DrawParams *restrict p, int item, int per_item, int vertices, TABLE(float) position,
                             TABLE(float) normal, TABLE(float) colour, TABLE(float) map, __global float *vertex) {
  FOR_EACH_GROUP(first, vertices) {
    whole v = min(lane_numbers() + first, WHOLE(vertices - 1));
    real3 n = gather3(normal, v), c = gather3(colour, v), view = in_view(p, gather3(position, v));
    // The normal in camera axes, as p->light.
    real3 facing = vec3(p->pixel * turned(p->row_x, n), p->pixel * turned(p->row_y, n), turned(p->row_w, n));
    real key = p->intensity * greater(dot3(facing, uniform3(p->light[0], p->light[1], p->light[2])), REAL(0.0f));
#if STRAND_SHADOW != SHADOW_NONE
    key = key * key_light(p, map, view);
#endif
    real light = p->ambient + key;
#if STRAND_LIGHTS
    scalar bright = 1.0f - p->skin_shadow;
    c = vec3(bright * c.x * (light + fill_light(p->fill, n)), bright * c.y * (light + fill_light(p->fill + 9, n)),
             bright * c.z * (light + fill_light(p->fill + 18, n)));
#else
    c = scale3(light, c);
#endif
    real column = view.x / view.z + 0.5f * (float)(p->width - 1), row = view.y / view.z + 0.5f * (float)(p->height - 1);
    real4 part[2] = {{view.x, view.y, view.z, column}, {row, c.x, c.y, c.z}};
    for (int i = 0; i < 2; ++i) store_rows_apart(part[i], vertex + (size_t)VERTEX_RECORD * first + 4 * i, VERTEX_RECORD);
  }
}
__kernel void skin_vertices(DrawParams p, int per_item, int vertices, TABLE(float) position, TABLE(float) normal, TABLE(float) colour,
                            TABLE(float) map, __global float *vertex) {
  skin_vertices_of(&p, (int)get_global_id(0), per_item, vertices, position, normal, colour, map, vertex);
}

// A triangle's vertices in view coordinates.
typedef struct { real3 a, b, c; } Triangle;

// The pixels that a triangle may touch.
typedef struct { whole left, top, right, bottom; } Bounds;

// The vertices of a triangle as skin_vertices stored them: X, Y, W, column; row, red, green, blue.
typedef struct { real4 a, b, c, a2, b2, c2; } Corners;

INLINE Corners load_corners(TABLE(int) index, TABLE(float) vertex, whole t) {
  whole a = gather_whole(index, 3 * t), b = gather_whole(index, 3 * t + 1), c = gather_whole(index, 3 * t + 2);
  Corners out = {gather_rows(vertex, 2 * a), gather_rows(vertex, 2 * b), gather_rows(vertex, 2 * c),
                 gather_rows(vertex, 2 * a + 1), gather_rows(vertex, 2 * b + 1), gather_rows(vertex, 2 * c + 1)};
  return out;
}

INLINE Triangle triangle_of(Corners v) {
  Triangle t = {vec3(v.a.x, v.a.y, v.a.z), vec3(v.b.x, v.b.y, v.b.z), vec3(v.c.x, v.c.y, v.c.z)};
  return t;
}

INLINE real least3(real a, real b, real c) { return lesser(a, lesser(b, c)); }
INLINE real most3(real a, real b, real c) { return greater(a, greater(b, c)); }
INLINE whole limited(real place, scalar least, scalar most) {
  return to_whole(lesser(greater(place, REAL(least)), REAL(most)));
}

// Returns empty bounds where `exists` is false. A triangle with a vertex that is nearer than the near plane may touch all pixels.
INLINE Bounds bounds_of(const DrawParams *p, Corners v, truth exists) {
  truth whole_picture = least3(v.a.z, v.b.z, v.c.z) < REAL(p->near_depth);
  // Pixel centres have integer coordinates here. The margin contains the rounding errors.
  const scalar margin = 1.0f / 64.0f;
  scalar width = (float)p->width, height = (float)p->height;
  Bounds b;
  b.left = limited(-floor_real(margin - least3(v.a.w, v.b.w, v.c.w)), 0.0f, width);
  b.right = limited(floor_real(most3(v.a.w, v.b.w, v.c.w) + margin), -1.0f, width - 1.0f);
  b.top = limited(-floor_real(margin - least3(v.a2.x, v.b2.x, v.c2.x)), 0.0f, height);
  b.bottom = limited(floor_real(most3(v.a2.x, v.b2.x, v.c2.x) + margin), -1.0f, height - 1.0f);
  b.left = whole_picture ? WHOLE(0) : b.left;
  b.top = whole_picture ? WHOLE(0) : b.top;
  b.right = whole_picture ? WHOLE(p->width - 1) : b.right;
  b.bottom = whole_picture ? WHOLE(p->height - 1) : b.bottom;
  b.bottom = exists && (b.left <= b.right) ? b.bottom : WHOLE(-1);
  return b;
}

// A point in the plane of a triangle: its barycentric weights, its view depth, and whether it is in the triangle and not
// nearer than the near plane.
typedef struct {
  real a, b, c, depth;
  truth inside;
} Place;

// Returns twice the area of the triangle (origin, a, b). The products are rounded before the subtraction, so that the two
// triangles of an edge compute opposite numbers.
INLINE real area(real ax, real ay, real bx, real by) { return ax * by - bx * ay; }

// Returns the point of the triangle's plane that the pixel (x, y) shows.
INLINE Place place_at(const DrawParams *p, Triangle t, whole x, whole y) {
  real px = to_real(x) - 0.5f * (float)(p->width - 1), py = to_real(y) - 0.5f * (float)(p->height - 1);
  real ax = fma(-px, t.a.z, t.a.x), ay = fma(-py, t.a.z, t.a.y);
  real bx = fma(-px, t.b.z, t.b.x), by = fma(-py, t.b.z, t.b.y);
  real cx = fma(-px, t.c.z, t.c.x), cy = fma(-py, t.c.z, t.c.y);
  real a = area(bx, by, cx, cy), b = area(cx, cy, ax, ay), c = area(ax, ay, bx, by), sum = a + b + c, none = REAL(0.0f);
  truth meets = (least3(a, b, c) >= none && sum > none) || (most3(a, b, c) <= none && sum < none);
  real scale = 1.0f / (meets ? sum : REAL(1.0f));
  Place out;
  out.a = a * scale;
  out.b = b * scale;
  out.c = c * scale;
  out.depth = fma(out.a, t.a.z, fma(out.b, t.b.z, out.c * t.c.z));
  out.inside = meets && out.depth >= REAL(p->near_depth);
  return out;
}

// One number per pixel; no pixel has a triangle yet.
__kernel void skin_clear(int per_item, int pixels, __global uint *depth, __global int *owner) {
  int item = (int)get_global_id(0);
  FOR_EACH_GROUP(first, pixels) {
    for (int i = first; i < min(first + LANES, pixels); ++i) {
      depth[i] = as_uint(NO_DEPTH);
      owner[i] = NO_OWNER;
    }
  }
}

// Runs BODY once for each fragment k of the triangles of work-item `item`. pixel[k] is the number of the fragment's pixel,
// bits[k] the bits of its depth, and number[k] the number of its triangle. Depths are positive. Of two positive floats, the
// larger one has the larger bits.
#define FOR_EACH_FRAGMENT(BODY) \
  FOR_EACH_GROUP(first, triangles) { \
    whole t = lane_numbers() + first; \
    truth exists = t < WHOLE(triangles); \
    Corners corners = load_corners(index, vertex, exists ? t : WHOLE(first)); \
    Triangle triangle = triangle_of(corners); \
    Bounds bounds = bounds_of(p, corners, exists); \
    for (whole y = bounds.top; some(y <= bounds.bottom); y = y + 1) \
      for (whole x = bounds.left; some((x <= bounds.right) && (y <= bounds.bottom)); x = x + 1) { \
        Place here = place_at(p, triangle, x, y); \
        truth inside = here.inside && (x <= bounds.right) && (y <= bounds.bottom); \
        if (!some(inside)) continue; \
        int pixel[LANES], bits[LANES], number[LANES]; \
        int count = squeeze(y * p->width + x, inside, pixel); \
        squeeze(bits_as_whole(here.depth), inside, bits); \
        squeeze(t, inside, number); \
        for (int k = 0; k < count; ++k) { BODY } \
      } \
  }

// depth: bits of the depth. It only decreases, so the test before the atomic operation leaves out no triangle.
CALLED void skin_depths_of(const DrawParams *restrict p, int item, int per_item, int triangles, TABLE(int) index,
                           TABLE(float) vertex, volatile __global uint *depth) {
  FOR_EACH_FRAGMENT(if ((uint)bits[k] < depth[pixel[k]]) atomic_min(depth + pixel[k], (uint)bits[k]);)
}
__kernel void skin_depth(DrawParams p, int per_item, int triangles, TABLE(int) index, TABLE(float) vertex, volatile __global uint *depth) {
  skin_depths_of(&p, (int)get_global_id(0), per_item, triangles, index, vertex, depth);
}

CALLED void skin_owners_of(const DrawParams *restrict p, int item, int per_item, int triangles, TABLE(int) index,
                           TABLE(float) vertex, TABLE(uint) depth, volatile __global int *owner) {
  FOR_EACH_FRAGMENT(if ((uint)bits[k] == depth[pixel[k]]) atomic_min(owner + pixel[k], number[k]);)
}
__kernel void skin_owner(DrawParams p, int per_item, int triangles, TABLE(int) index, TABLE(float) vertex, TABLE(uint) depth,
                         volatile __global int *owner) {
  skin_owners_of(&p, (int)get_global_id(0), per_item, triangles, index, vertex, depth, owner);
}

// skin: red, green, blue and the view depth of each pixel. The depth is NO_DEPTH where there is no skin.
CALLED void skin_colours_of(const DrawParams *restrict p, int item, int per_item, int pixels, TABLE(int) index,
                            TABLE(float) vertex, TABLE(int) depth, TABLE(int) owner, __global float *skin) {
  FOR_EACH_GROUP(first, pixels) {
    whole pixel = min(lane_numbers() + first, WHOLE(pixels - 1)), t = gather_whole(owner, pixel);
    truth hit = t != WHOLE(NO_OWNER);
    real4 out = {REAL(0.0f), REAL(0.0f), REAL(0.0f), REAL(NO_DEPTH)};
    if (some(hit)) {
      Corners v = load_corners(index, vertex, hit ? t : WHOLE(0));
      whole y = pixel / p->width;
      Place here = place_at(p, triangle_of(v), pixel - y * p->width, y);
#define MEAN(colour) (hit ? fma(here.a, v.a2.colour, fma(here.b, v.b2.colour, here.c * v.c2.colour)) : REAL(0.0f))
      out.x = MEAN(y);
      out.y = MEAN(z);
      out.z = MEAN(w);
#undef MEAN
      out.w = hit ? bits_as_real(gather_whole(depth, pixel)) : REAL(NO_DEPTH);
    }
    store_rows_apart(out, skin + (size_t)4 * first, 4);
  }
}
__kernel void skin_colours(DrawParams p, int per_item, int pixels, TABLE(int) index, TABLE(float) vertex, TABLE(int) depth,
                           TABLE(int) owner, __global float *skin) {
  skin_colours_of(&p, (int)get_global_id(0), per_item, pixels, index, vertex, depth, owner, skin);
}
