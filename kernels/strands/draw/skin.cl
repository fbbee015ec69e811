// Draws the skin below the strands: the colour and the view depth of the nearest triangle at each pixel. docs/strands.md,
// section Skin, defines the operations. skin_vertices computes the vertices. skin_depth finds the least depth of each pixel.
// skin_owner finds the triangle with this depth, and of equal depths the one with the lowest number, so that the picture does
// not depend on the order of the work-items. skin_colours writes the pixels.
#include "strands/draw/curve.clh"
#include "strands/draw/fills.clh"
#include "strands/draw/shadow.clh"

#define VERTEX_RECORD 6        // floats of a vertex: X, Y and W, then red, green and blue
#define NO_OWNER 0x7fffffff

// position, normal, colour: three floats per vertex. map: the opacity map of the key light.
__kernel void skin_vertices(DrawParams p, int vertices, TABLE(float) position, TABLE(float) normal, TABLE(float) colour,
                            TABLE(float) map, __global float *vertex) {
  int v = (int)get_global_id(0);
  if (v >= vertices) return;
  real3 n = vec3(normal[3 * v], normal[3 * v + 1], normal[3 * v + 2]);
  real3 view = in_view(&p, vec3(position[3 * v], position[3 * v + 1], position[3 * v + 2]));
  // The normal in camera axes, as p.light.
  real3 facing = vec3(p.pixel * fma(n.z, p.row_x[2], fma(n.y, p.row_x[1], n.x * p.row_x[0])),
                      p.pixel * fma(n.z, p.row_y[2], fma(n.y, p.row_y[1], n.x * p.row_y[0])),
                      fma(n.z, p.row_w[2], fma(n.y, p.row_w[1], n.x * p.row_w[0])));
  real key = p.intensity * greater(dot3(facing, uniform3(p.light[0], p.light[1], p.light[2])), 0.0f);
#if STRAND_SHADOW != SHADOW_NONE
  key = key * key_light(&p, map, view);
#endif
  __global float *out = vertex + (size_t)VERTEX_RECORD * v;
  out[0] = view.x;
  out[1] = view.y;
  out[2] = view.z;
  for (int i = 0; i < 3; ++i) {
    real light = p.ambient + key;
#if STRAND_LIGHTS
    light = (1.0f - p.skin_shadow) * (light + fill_light(p.fill + 9 * i, n));
#endif
    out[3 + i] = colour[3 * v + i] * light;
  }
}

// A triangle's vertices in view coordinates, and the pixels that it may touch.
typedef struct {
  real3 a, b, c;
  int left, top, right, bottom;
} Triangle;

INLINE real3 corner(TABLE(float) vertex, int v) {
  TABLE(float) from = vertex + (size_t)VERTEX_RECORD * v;
  return vec3(from[0], from[1], from[2]);
}

INLINE int pixel_below(float place, int pixels) { return (int)clamp(floor(place), 0.0f, (float)(pixels - 1)); }

// A triangle with a vertex that is nearer than the near plane may touch all pixels.
INLINE Triangle load_triangle(const DrawParams *p, TABLE(int) index, TABLE(float) vertex, int t) {
  Triangle tri;
  tri.a = corner(vertex, index[3 * t]);
  tri.b = corner(vertex, index[3 * t + 1]);
  tri.c = corner(vertex, index[3 * t + 2]);
  tri.left = tri.top = 0;
  tri.right = p->width - 1;
  tri.bottom = p->height - 1;
  if (fmin(tri.a.z, fmin(tri.b.z, tri.c.z)) < p->near_depth) return tri;
  float middle_x = 0.5f * (float)p->width, middle_y = 0.5f * (float)p->height;
  float ax = tri.a.x / tri.a.z, bx = tri.b.x / tri.b.z, cx = tri.c.x / tri.c.z;
  float ay = tri.a.y / tri.a.z, by = tri.b.y / tri.b.z, cy = tri.c.y / tri.c.z;
  // The pixel centres x + 1/2 lie between the least and the greatest x. The margin contains the rounding errors.
  const float margin = 1.0f / 64.0f;
  float least_x = fmin(ax, fmin(bx, cx)) + middle_x - margin, most_x = fmax(ax, fmax(bx, cx)) + middle_x + margin;
  float least_y = fmin(ay, fmin(by, cy)) + middle_y - margin, most_y = fmax(ay, fmax(by, cy)) + middle_y + margin;
  if (most_x < 0.0f || least_x > (float)p->width || most_y < 0.0f || least_y > (float)p->height) {
    tri.right = -1;
    return tri;
  }
  tri.left = pixel_below(least_x - 0.5f, p->width);
  tri.right = pixel_below(most_x - 0.5f, p->width);
  tri.top = pixel_below(least_y - 0.5f, p->height);
  tri.bottom = pixel_below(most_y - 0.5f, p->height);
  return tri;
}

// The barycentric weights of a point of a triangle, and its view depth.
typedef struct {
  float a, b, c, depth;
  bool inside;
} Place;

// Returns twice the area of the triangle (origin, a, b). The products are rounded before the subtraction, so that the two
// triangles of an edge compute opposite numbers.
INLINE float area(float ax, float ay, float bx, float by) { return ax * by - bx * ay; }

// Returns the point of the triangle's plane that the pixel (x, y) shows.
INLINE Place place_at(const DrawParams *p, const Triangle *t, int x, int y) {
  float px = (float)x + 0.5f - 0.5f * (float)p->width, py = (float)y + 0.5f - 0.5f * (float)p->height;
  float ax = fma(-px, t->a.z, t->a.x), ay = fma(-py, t->a.z, t->a.y);
  float bx = fma(-px, t->b.z, t->b.x), by = fma(-py, t->b.z, t->b.y);
  float cx = fma(-px, t->c.z, t->c.x), cy = fma(-py, t->c.z, t->c.y);
  float a = area(bx, by, cx, cy), b = area(cx, cy, ax, ay), c = area(ax, ay, bx, by), sum = a + b + c;
  Place out;
  out.inside = (a >= 0.0f && b >= 0.0f && c >= 0.0f && sum > 0.0f) || (a <= 0.0f && b <= 0.0f && c <= 0.0f && sum < 0.0f);
  float scale = 1.0f / (sum != 0.0f ? sum : 1.0f);
  out.a = a * scale;
  out.b = b * scale;
  out.c = c * scale;
  out.depth = fma(out.a, t->a.z, fma(out.b, t->b.z, out.c * t->c.z));
  out.inside = out.inside && out.depth >= p->near_depth;
  return out;
}

// One number per pixel; no pixel has a triangle yet.
__kernel void skin_clear(int pixels, __global uint *depth, __global int *owner) {
  int i = (int)get_global_id(0);
  if (i >= pixels) return;
  depth[i] = as_uint(NO_DEPTH);
  owner[i] = NO_OWNER;
}

// depth: bits of the depth. The depths are positive, so that their bits are in the same order as the depths.
__kernel void skin_depth(DrawParams p, int triangles, TABLE(int) index, TABLE(float) vertex, volatile __global uint *depth) {
  int t = (int)get_global_id(0);
  if (t >= triangles) return;
  Triangle tri = load_triangle(&p, index, vertex, t);
  for (int y = tri.top; y <= tri.bottom; ++y)
    for (int x = tri.left; x <= tri.right; ++x) {
      Place here = place_at(&p, &tri, x, y);
      if (here.inside) atomic_min(depth + (size_t)y * p.width + x, as_uint(here.depth));
    }
}

__kernel void skin_owner(DrawParams p, int triangles, TABLE(int) index, TABLE(float) vertex, TABLE(uint) depth,
                         volatile __global int *owner) {
  int t = (int)get_global_id(0);
  if (t >= triangles) return;
  Triangle tri = load_triangle(&p, index, vertex, t);
  for (int y = tri.top; y <= tri.bottom; ++y)
    for (int x = tri.left; x <= tri.right; ++x) {
      Place here = place_at(&p, &tri, x, y);
      size_t pixel = (size_t)y * p.width + x;
      if (here.inside && as_uint(here.depth) == depth[pixel]) atomic_min(owner + pixel, t);
    }
}

// skin: red, green, blue and the view depth of each pixel. The depth is NO_DEPTH where there is no skin.
__kernel void skin_colours(DrawParams p, TABLE(int) index, TABLE(float) vertex, TABLE(uint) depth, TABLE(int) owner,
                           __global float4 *skin) {
  int pixel = (int)get_global_id(0);
  if (pixel >= p.width * p.height) return;
  int t = owner[pixel];
  float4 out = (float4)(0.0f, 0.0f, 0.0f, NO_DEPTH);
  if (t != NO_OWNER) {
    Triangle tri = load_triangle(&p, index, vertex, t);
    Place here = place_at(&p, &tri, pixel % p.width, pixel / p.width);
    TABLE(float) a = vertex + (size_t)VERTEX_RECORD * index[3 * t];
    TABLE(float) b = vertex + (size_t)VERTEX_RECORD * index[3 * t + 1];
    TABLE(float) c = vertex + (size_t)VERTEX_RECORD * index[3 * t + 2];
    out = (float4)(fma(here.a, a[3], fma(here.b, b[3], here.c * c[3])), fma(here.a, a[4], fma(here.b, b[4], here.c * c[4])),
                   fma(here.a, a[5], fma(here.b, b[5], here.c * c[5])), as_float(depth[pixel]));
  }
  skin[pixel] = out;
}
