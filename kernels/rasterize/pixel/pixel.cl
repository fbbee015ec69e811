// The pixel mapping: one work-item draws one pixel, fragment by fragment, from the triangle list of the tile that
// contains the pixel. The pixel mapping is the simplest implementation of the equations: it computes one fragment at a
// time, without vectors. Tests compare the other mappings with the pixel mapping on every device.
//
//   triangle_hit tests coverage and locates the pixel on a triangle (hit.clh, coverage/).
//   blend_by_layer, or blend_by_depth with DEPTH_ORDER, orders the fragments and blends them (order.clh).
//   surface_at interpolates the attributes at the pixel (shading/one_pixel.clh).
//   fur_fragment computes the clump and samples the fur texture (shading/fragment.clh).
//   fur_colour computes the light (shading/fragment.clh).
//   over_base adds the base surface or the background (shading/one_pixel.clh).
#include "rasterize/pixel/order.clh"

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
  Pixel p = {list_start[tile], list_start[tile + 1], SUBPIXEL * i + 128 - 128 * s.width, SUBPIXEL * j + 128 - 128 * s.height,
             (float)i + (0.5f - 0.5f * (float)s.width), (float)j + (0.5f - 0.5f * (float)s.height), 0.0f};

  Layer base = layer_at(&s, layer_table, -1);
  Hit nearest;
  nearest.covered = false;
  nearest.at.iw = 0.0f;
  int vertices[3], nearest_vertices[3];
  for (int k = p.begin; k < p.end; ++k) {
    Hit h = triangle_hit(&s, of.geometry, base, -1, list[k], p, vertices);
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
  p.base = nearest.at.iw;

  size_t at = (size_t)j * s.width + i;
  bool resumed = resumes(&s);
  float4 front = resumed ? image[at] : (float4)(0.0f, 0.0f, 0.0f, 1.0f);
#if DEPTH_ORDER
  Counts counts = blend_by_depth(&s, of, p, &front);
#else
  Counts counts = blend_by_layer(&s, of, p, &front);
#endif
#ifdef TALLY
  covered[3 * at] += counts.covered;
  covered[3 * at + 1] += counts.shaded;
  covered[3 * at + 2] += counts.blended;
#else
  covered[at] = counts.covered + (resumed ? covered[at] : 0);
#endif
  if (suspends(&s)) {
    image[at] = front;
    return;
  }
#ifndef TALLY
  image[at] = over_base(&s, of.attributes, of.textures, base, nearest.covered, nearest.at, nearest_vertices, p.x, p.y, front);
#endif
}
