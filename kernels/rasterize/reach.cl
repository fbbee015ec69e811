// How many layers, from the base, a triangle can be seen in: where clumps part, Algorithm 2 discards the outer layers of
// whole triangles, and drawing them would change nothing. Once per wetness mask.
#include "rasterize/layers.clh"
#include "rasterize/textures.clh"

#define MANY 64            // texels a side beyond which nothing is looked at: every layer
#define MARGIN 1e-5f       // of UV: more than rounding moves a fragment; 1/400 of a texel of 256

typedef struct { float2 low, high; } Box;                   // of UV
typedef struct { int left, top, right, bottom; } Texels;    // inclusive, not wrapped

static Texels texels_of(const RasterParams *s, Box b) {
  float size = (float)s->mask_size;
  Texels t = {(int)floor(b.low.x * size), (int)floor(b.low.y * size), (int)floor(b.high.x * size), (int)floor(b.high.y * size)};
  return t;
}

static bool too_many(Texels t) { return t.right - t.left >= MANY || t.bottom - t.top >= MANY; }

static int wrapped(int i, int size) {
  int r = i % size;
  return r < 0 ? r + size : r;
}

static float4 texel_at(const RasterParams *s, TABLE(float) mask, int x, int y) {
  return vload4(wrapped(y, s->mask_size) * s->mask_size + wrapped(x, s->mask_size), mask);
}

// Whether a fragment that lands in the box may stay in its clump.
static bool stays(const RasterParams *s, TABLE(float) mask, Box b, float2 centre) {
  Texels t = texels_of(s, b);
  if (too_many(t)) return true;
  for (int y = t.top; y <= t.bottom; ++y)
    for (int x = t.left; x <= t.right; ++x) {
      float4 there = texel_at(s, mask, x, y);
      if (there.w != 0.0f && (!s->clump_separate || (there.x == centre.x && there.y == centre.y))) return true;
    }
  return false;
}

// The outermost of the layers below `layers` in which fragments of the box, all in the texel of `clump` (c_u, c_v, r, rho),
// may survive, plus 1; at least `known`. See clumped() in fragment.clh.
static int reach_of(const RasterParams *s, TABLE(float) table, TABLE(float) mask, float4 clump, Box b, int known) {
  if (!(clump.w > 0.0f)) return s->layers;
  float2 away = fmax(fmax(b.low - clump.xy, clump.xy - b.high), (float2)(0.0f));
  if (sqrt(fma(away.y, away.y, away.x * away.x)) > clump.z + MARGIN) return known;
  float scale = clump.w * (s->clump_literal ? clump.z : s->clump_gain);
  for (int n = s->layers - 1; n >= known; --n) {
    // Eq. 5 is linear in p: what the corners land on bounds what lies between.
    float rate = layer_at(s, table, n).rate * scale;
    Box there = {b.low + rate * (b.low - clump.xy) - MARGIN, b.high + rate * (b.high - clump.xy) + MARGIN};
    if (stays(s, mask, there, clump.xy)) return n + 1;
  }
  return known;
}

// The fourth of each triangle's corner row: its reach, one more than there are layers where it is dry all over.
__kernel void triangle_reach(RasterParams s, TABLE(float) table, TABLE(float) uv, TABLE(float) mask, __global int *corners) {
  int t = (int)get_global_id(0);
  if (t >= s.triangles) return;
  int4 row = vload4(t, corners);
  float2 p0 = vload2(row.x, uv), p1 = vload2(row.y, uv), p2 = vload2(row.z, uv);
  Box all = {fmin(p0, fmin(p1, p2)), fmax(p0, fmax(p1, p2))};
  // Outside the unit square p - c is not what it is inside.
  bool within = all.low.x >= 0.0f && all.low.y >= 0.0f && all.high.x <= 1.0f && all.high.y <= 1.0f;
  all.low -= MARGIN;
  all.high += MARGIN;
  Texels texels = texels_of(&s, all);
  int reach = s.layers;
  if (within && !too_many(texels)) {
    reach = 0;
    bool wet = false;
    float size = 1.0f / (float)s.mask_size;
    for (int y = texels.top; y <= texels.bottom && !(wet && reach == s.layers); ++y)
      for (int x = texels.left; x <= texels.right && !(wet && reach == s.layers); ++x) {
        float4 clump = texel_at(&s, mask, x, y);
        wet = wet || clump.w > 0.0f;
        float2 corner = (float2)((float)x, (float)y) * size;
        Box b = {fmax(all.low, corner - MARGIN), fmin(all.high, corner + size + MARGIN)};
        if (reach < s.layers) reach = reach_of(&s, table, mask, clump, b, reach);
      }
    if (!wet) reach = s.layers + 1;
  }
  corners[4 * t + 3] = reach;
}
