// The plain mapping, a cross-check on every device: a work-item per pixel walks its tile's list and shades each fragment
// as it comes. The same equations on one lane; nothing queued, nothing skipped but what cannot be seen.
#include "rasterize/coverage/fan.clh"
#include "rasterize/shading/surface.clh"

// The centre of the pixel at the origin of the setup's coordinates.
static Hit hit_at(Setup t) {
  Hit h;
  h.covered = t.live && t.edge[0].at >= 0 && t.edge[1].at >= 0 && t.edge[2].at >= 0;
  float dx = (float)(-t.x), dy = (float)(-t.y);
  float b1 = fma(t.slope[0].right, dx, t.slope[0].down * dy);
  float b2 = fma(t.slope[1].right, dx, t.slope[1].down * dy);
  h.iw = fma(b2, t.iw2 - t.iw, fma(b1, t.iw1 - t.iw, t.iw));
  float w = 1.0f / h.iw;
  h.b1 = b1 * t.iw1 * w;
  h.b2 = b2 * t.iw2 * w;
  if (t.swapped) {
    float b = h.b1;
    h.b1 = h.b2;
    h.b2 = b;
  }
  return h;
}

// A triangle of layer n at the pixel whose centre is the origin, clipped where it must be.
static Hit triangle_hit(const RasterParams *s, Geometry m, Layer l, int n, int triangle, int origin_x, int origin_y, int *vertex) {
  Triangles b = triangles_at(s, m, n, gather_rows(m.corners, triangle), origin_x, origin_y);
  for (int c = 0; c < 3; ++c) vertex[c] = b.vertex[c];
  if (!needs_clip(b)) return hit_at(set_up(b.corner[0], b.corner[1], b.corner[2], 1, 1));
  Cut polygon[POLYGON];
  int corners = clipped_triangle(s, m, l, vertex[0], vertex[1], vertex[2], polygon);
  Hit none;
  none.covered = false;
  for (int i = 1; i + 1 < corners; ++i) {
    Hit h = hit_at(set_up(cut_on_screen(polygon[0], origin_x, origin_y), cut_on_screen(polygon[i], origin_x, origin_y),
                          cut_on_screen(polygon[i + 1], origin_x, origin_y), 1, 1));
    if (!h.covered) continue;
    float b0 = 1.0f - h.b1 - h.b2, b1 = h.b1, b2 = h.b2;
    h.b1 = b0 * polygon[0].b1 + b1 * polygon[i].b1 + b2 * polygon[i + 1].b1;
    h.b2 = b0 * polygon[0].b2 + b1 * polygon[i].b2 + b2 * polygon[i + 1].b2;
    return h;
  }
  return none;
}

__kernel void pixel_shells(RasterParams s, TABLE(float) table, TABLE(float) corners, TABLE(float) screen,
                           TABLE(float) vertex, TABLE(float) tip, TABLE(float) dry,
                           TABLE(int) list_start, TABLE(int) list, TABLE(float) records, TABLE(float) tangents, TABLE(float) curls,
                           TABLE(int) fur, TABLE(int) coat, TABLE(float) mask, __global float4 *image, __global uint *covered) {
  int i = (int)get_global_id(0), j = (int)get_global_id(1);
  if (i >= s.width || j >= s.height) return;
#ifdef TALLY
  // One pixel in TALLY, spread at random.
  uint pick = (uint)i * 0x9e3779b1u ^ (uint)j * 0x85ebca77u;
  pick = (pick ^ pick >> 15) * 0x2c1b3c6du;
  if ((pick ^ pick >> 12) % TALLY != 0) return;
#endif
  Geometry m = {corners, screen, vertex, tip, dry, table};
  Textures textures = {fur, coat, mask};
  Attributes from = {records, tangents, curls};
  int tile = (j / TILE_H) * s.tiles_x + i / TILE_W;
  int origin_x = SUBPIXEL * i + 128 - 128 * s.width, origin_y = SUBPIXEL * j + 128 - 128 * s.height;
  float x = (float)i + (0.5f - 0.5f * (float)s.width), y = (float)j + (0.5f - 0.5f * (float)s.height);

  Layer base = layer_at(&s, table, -1);
  Hit nearest;
  nearest.covered = false;
  nearest.iw = 0.0f;
  int vertices[3], nearest_vertices[3];
  for (int k = list_start[tile]; k < list_start[tile + 1]; ++k) {
    Hit h = triangle_hit(&s, m, base, -1, list[k], origin_x, origin_y, vertices);
    if (!h.covered || h.iw <= nearest.iw) continue;
    // Not nearest = h: rusticl (Mesa 22.3) copies a struct whole on those lanes too that went on.
    nearest.covered = true;
    nearest.iw = h.iw;
    nearest.b1 = h.b1;
    nearest.b2 = h.b2;
    for (int c = 0; c < 3; ++c) nearest_vertices[c] = vertices[c];
  }

  size_t at = (size_t)j * s.width + i;
  bool resumed = s.end_layer < s.layers;
  float4 front = resumed ? image[at] : (float4)(0.0f, 0.0f, 0.0f, 1.0f);
  uint fragments = 0, shaded = 0, blended = 0;
  for (int n = s.end_layer - 1; n >= s.first_layer; --n) {
    Layer l = layer_at(&s, table, n);
    for (int k = list_start[tile + 1] - 1; k >= list_start[tile]; --k) {
      Hit h = triangle_hit(&s, m, l, n, list[k], origin_x, origin_y, vertices);
      if (!h.covered) continue;
      ++fragments;
      int reach = as_int(corners[4 * (size_t)list[k] + 3]);
      if (h.iw < nearest.iw || front.w <= OPAQUE || n >= reach) continue;
      ++shaded;
      Surface p = surface_at(&s, from, h, vertices, x, y);
      Fur f = fur_fragment(&s, textures, l, slice_of(&s, n), p);
      if (f.coverage <= 0.0f) continue;
      ++blended;
      real3 c = fur_colour(&s, textures, l, p, f);
      float weight = front.w * f.coverage;
      front = fma((float4)(weight), (float4)(c.x, c.y, c.z, -1.0f), front);
    }
  }
#ifdef TALLY
  covered[3 * at] += fragments;
  covered[3 * at + 1] += shaded;
  covered[3 * at + 2] += blended;
#else
  covered[at] = fragments + (resumed ? covered[at] : 0);
#endif
  if (s.first_layer > 0) {
    image[at] = front;
    return;
  }
#ifndef TALLY
  float4 behind = (float4)(s.background[0], s.background[1], s.background[2], 0.0f);
  if (nearest.covered) {
    real3 c = skin_colour(&s, textures, base, surface_at(&s, from, nearest, nearest_vertices, x, y));
    behind = (float4)(c.x, c.y, c.z, 1.0f);
  }
  image[at] = (float4)(front.x + front.w * behind.x, front.y + front.w * behind.y, front.z + front.w * behind.z,
                       1.0f - front.w * (1.0f - behind.w));
#endif
}
