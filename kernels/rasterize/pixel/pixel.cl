// The pixel mapping: one work-item draws one pixel. For every layer, the work-item reads the triangle list of
// the tile that contains the pixel, and shades each fragment immediately. The pixel mapping is the simplest
// implementation of the equations: it computes one fragment at a time, without vectors. Tests compare the
// other mappings with the pixel mapping on every device.
//
//   triangles_at reads a triangle's vertices in the layer (coverage/fan.clh).
//   triangle_hit tests coverage and locates the pixel on the triangle (this file, coverage/).
//   surface_at interpolates the attributes at the pixel (shading/one_pixel.clh).
//   fur_fragment computes the clump and samples the fur texture (shading/fragment.clh).
//   fur_colour computes the light (shading/fragment.clh).
//   over_base adds the base surface or the background (shading/one_pixel.clh).
#include "rasterize/buffers.clh"
#include "rasterize/coverage/perspective.clh"
#include "rasterize/shading/one_pixel.clh"

typedef struct { bool covered; Perspective at; } Hit;

// Tests whether the triangle t covers a pixel, and locates the pixel on the triangle. The pixel's centre is the origin
// of the coordinates of t.
static Hit hit_at(Setup t) {
  Hit h;
  h.covered = t.live && t.edge[0].at >= 0 && t.edge[1].at >= 0 && t.edge[2].at >= 0;
  h.at = perspective_at(planes_of(t), (float)(-t.x), (float)(-t.y));
  if (t.swapped) {
    float b = h.at.b1;
    h.at.b1 = h.at.b2;
    h.at.b2 = b;
  }
  return h;
}

// Tests whether a triangle of layer n covers a pixel, and locates the pixel on the triangle. (origin_x, origin_y) is
// the pixel's centre in 1/256 pixel, relative to the image centre. If the triangle crosses the near plane or the guard
// band, this function first clips the triangle.
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
    Piece piece = {{polygon[0].b1, polygon[i].b1, polygon[i + 1].b1}, {polygon[0].b2, polygon[i].b2, polygon[i + 1].b2}};
    h.at = within_triangle(h.at, piece);
    return h;
  }
  return none;
}

__kernel void pixel_shells(RasterParams s, RASTER_BUFFERS) {
  int i = (int)get_global_id(0), j = (int)get_global_id(1);
  if (i >= s.width || j >= s.height) return;
#ifdef TALLY
  // If TALLY is defined, only a random sample of the pixels is drawn: on average one pixel in TALLY.
  uint pick = (uint)i * 0x9e3779b1u ^ (uint)j * 0x85ebca77u;
  pick = (pick ^ pick >> 15) * 0x2c1b3c6du;
  if ((pick ^ pick >> 12) % TALLY != 0) return;
#endif
  RasterBuffers of = RASTER_RECORD;
  int tile = (j / TILE_H) * s.tiles_x + i / TILE_W;
  int origin_x = SUBPIXEL * i + 128 - 128 * s.width, origin_y = SUBPIXEL * j + 128 - 128 * s.height;
  float x = (float)i + (0.5f - 0.5f * (float)s.width), y = (float)j + (0.5f - 0.5f * (float)s.height);

  Layer base = layer_at(&s, layer_table, -1);
  Hit nearest;
  nearest.covered = false;
  nearest.at.iw = 0.0f;
  int vertices[3], nearest_vertices[3];
  for (int k = list_start[tile]; k < list_start[tile + 1]; ++k) {
    Hit h = triangle_hit(&s, of.geometry, base, -1, list[k], origin_x, origin_y, vertices);
    if (!h.covered || h.at.iw <= nearest.at.iw) continue;
    // The members are copied one by one, because rusticl (Mesa 22.3) executes the assignment `nearest = h` also in
    // lanes that skip it by `continue`.
    nearest.covered = true;
    nearest.at.iw = h.at.iw;
    nearest.at.w = h.at.w;
    nearest.at.b1 = h.at.b1;
    nearest.at.b2 = h.at.b2;
    for (int c = 0; c < 3; ++c) nearest_vertices[c] = vertices[c];
  }

  size_t at = (size_t)j * s.width + i;
  bool resumed = resumes(&s);
  float4 front = resumed ? image[at] : (float4)(0.0f, 0.0f, 0.0f, 1.0f);
  uint fragments = 0, shaded = 0, blended = 0;
  int layers = s.end_layer - s.first_layer;
  for (int step = layers * s.first_sweep; step < layers * s.end_sweep; ++step) {
    int n = s.end_layer - 1 - step % layers, sweep = step / layers;
    Layer l = layer_at(&s, layer_table, n);
    for (int k = list_start[tile + 1] - 1; k >= list_start[tile]; --k) {
      int word = as_int(corners[4 * (size_t)list[k] + 3]), reach = word & REACH_BITS;
      bool away = (word & FACES_AWAY) != 0;
      if (!in_sweep(&s, away, sweep) || (s.faces == FACES_FRONT && away)) continue;
      Hit h = triangle_hit(&s, of.geometry, l, n, list[k], origin_x, origin_y, vertices);
      if (!h.covered) continue;
      ++fragments;
      if (h.at.iw < nearest.at.iw || front.w <= OPAQUE || n >= reach) continue;
      ++shaded;
      Surface p = surface_at(&s, of.attributes, h.at, vertices, x, y);
      blended += blend_under(&s, of.textures, l, slice_of(&s, n), p, &front);
    }
  }
#ifdef TALLY
  covered[3 * at] += fragments;
  covered[3 * at + 1] += shaded;
  covered[3 * at + 2] += blended;
#else
  covered[at] = fragments + (resumed ? covered[at] : 0);
#endif
  if (suspends(&s)) {
    image[at] = front;
    return;
  }
#ifndef TALLY
  image[at] = over_base(&s, of.attributes, of.textures, base, nearest.covered, nearest.at, nearest_vertices, x, y, front);
#endif
}
