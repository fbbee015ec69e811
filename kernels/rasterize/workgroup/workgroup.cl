// Draws the fur by a method for GPUs: a work-group draws a tile, and a work-item draws a pixel. The triangles
// of a tile are processed in batches. A batch has as many triangles as the work-group has work-items. First,
// each work-item sets up one triangle of the batch and computes a mask of the pixels that this triangle
// covers. Triangles that cover no pixel are dropped. Then each work-item draws all triangles of the batch
// that cover its pixel. The kernel draws the layers from the outermost to the innermost, and the triangles of
// each layer from the last to the first, with the 'under' operator. Silva et al. 2010 (Curling and Clumping
// Fur, section 4) draw the layers from the innermost to the outermost with the 'over' operator. Layers write
// no depth, so both methods give the same picture. If the data of all layers need too much memory, several
// passes draw the layers. With blend.order "depth" (DEPTH_ORDER), a work-item sorts the fragments of its pixel
// (shading/by_depth.clh); all layers are drawn again for each round. w is the view depth.
//
//   put_triangle() sets up one triangle and the mask of its pixels (batch.clh, coverage/).
//   draw_clipped() draws a triangle that needs clipping (this file, coverage/fan.clh).
//   perspective_in() computes depth and barycentrics of a pixel on a triangle (batch.clh, coverage/perspective.clh).
//   draw() keeps the nearest triangle of the base, or shades and blends a fragment of a layer (this file).
//   blend_under() computes clump, fur texture and light of a fragment, and blends the fragment (shading/one_pixel.clh).
//   over_base() adds the base surface or the background (shading/one_pixel.clh).
#include "rasterize/buffers.clh"
#include "rasterize/coverage/perspective.clh"
#include "rasterize/shading/by_depth.clh"
#include "rasterize/workgroup/batch.clh"

#if DEPTH_ORDER && !defined COUNT_FRAGMENTS
#define BY_DEPTH 1
#endif

// The parameters with which the triangles of one layer are drawn.
typedef struct {
  const RasterParams *s;
  Attributes from;
  Textures textures;
  int n;                                     // number of the layer, -1 for the base surface
  Layer layer;
} Pass;

typedef struct {
  int x, y;                                  // position of the pixel in the tile
  float from_centre_x, from_centre_y;        // position of the pixel's centre, in pixels from the image centre
  float depth;                               // 1/w of the base, 0 where no base triangle covers the pixel
  Perspective base;
  int vertex[3];                             // vertices of the base triangle
  float4 front;                              // accumulated colour and transmittance
  uint fragments;                            // number of layer fragments that cover the pixel, visible or not
#if BY_DEPTH
  Nearest nearest;
#endif
} Pixel;

// Draws the triangle in slot number `slot` at a pixel that it covers.
INLINE void draw(const Pass *pass, const __local Drawn *d, int slot, Perspective h, Pixel *p) {
  int vertex[3] = {d->v0[slot], d->v1[slot], d->v2[slot]};
  if (pass->n < 0) {
    if (h.iw <= p->depth) return;
    p->depth = h.iw;
    p->base = h;
    for (int c = 0; c < 3; ++c) p->vertex[c] = vertex[c];
    return;
  }
#ifndef COUNT_FRAGMENTS
  if (h.iw < p->depth || p->front.w <= OPAQUE) return;
#if BY_DEPTH
  offer(&p->nearest, h, vertex, pass->n);
#else
  Surface at = surface_at(pass->s, pass->from, h, vertex, p->from_centre_x, p->from_centre_y);
  blend_under(pass->s, pass->textures, pass->layer, slice_of(pass->s, pass->n), at, &p->front);
#endif
#endif
}

// Clips the triangle in `slot`, and draws the fan of triangles into which the remaining polygon is divided. One
// work-item clips the triangle. Each of a few work-items sets up one triangle of the fan. All work-items draw the fan.
// All work-items of the group must call this function together.
INLINE void draw_clipped(const Pass *pass, Geometry m, __local Work *w, int slot, int item, int origin_x, int origin_y,
                         int width, int height, Pixel *p) {
  barrier(CLK_LOCAL_MEM_FENCE);              // waits until the previous clipped triangle has been drawn
  if (item == 0) {
    Cut polygon[POLYGON];
    int corners = clipped_triangle(pass->s, m, pass->layer, w->drawn.v0[slot], w->drawn.v1[slot], w->drawn.v2[slot], polygon);
    for (int i = 0; i < corners; ++i) w->polygon[i] = polygon[i];
    w->corners = corners;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  int pieces = max(w->corners - 2, 0);
  if (item < pieces) put_piece(w, item, slot, origin_x, origin_y, width, height);
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int i = 0; i < pieces; ++i) {
    if (!(w->drawn.covered[GROUP_ITEMS + i] >> item & 1)) continue;
    if (pass->n >= 0) ++p->fragments;
    Perspective at = perspective_in(&w->drawn, GROUP_ITEMS + i, p->x, p->y);
    draw(pass, &w->drawn, GROUP_ITEMS + i, within_triangle(at, w->piece[i]), p);
  }
}

#if BY_DEPTH
// Blends the fragments that the round has kept. Returns true if any pixel of the tile has more fragments, which need
// another round. All work-items of the group must call this function together.
INLINE bool another_round(const Pass *pass, TABLE(float) layer_table, __local Work *w, int item, bool inside, Pixel *p) {
  uint shaded = 0, blended = 0;
  bool more = inside && blend_nearest(pass->s, pass->from, pass->textures, layer_table, &p->nearest, p->from_centre_x,
                                      p->from_centre_y, &p->front, &shaded, &blended);
  if (item == 0) w->more = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (more) atomic_or(&w->more, 1);
  barrier(CLK_LOCAL_MEM_FENCE);
  return w->more != 0;
}
#endif

__kernel __attribute__((reqd_work_group_size(GROUP_ITEMS, 1, 1)))
void group_shells(RasterParams s, RASTER_BUFFERS) {
  __local Work work;
  int item = (int)get_local_id(0), tile = (int)get_group_id(0), tiles = s.tiles_x * s.tiles_y;
  int first_x = tile % s.tiles_x * TILE_W, first_y = tile / s.tiles_x * TILE_H;
  int origin_x = SUBPIXEL * first_x + 128 - 128 * s.width, origin_y = SUBPIXEL * first_y + 128 - 128 * s.height;
  int width = min(TILE_W, s.width - first_x), height = min(TILE_H, s.height - first_y);
  RasterBuffers of = RASTER_RECORD;
  Geometry m = of.geometry;
  Pass pass = {&s, of.attributes, of.textures};

  Pixel p;
  p.x = item % TILE_W;
  p.y = item / TILE_W;
  p.from_centre_x = (float)(first_x + p.x) + (0.5f - 0.5f * (float)s.width);
  p.from_centre_y = (float)(first_y + p.y) + (0.5f - 0.5f * (float)s.height);
  p.depth = 0.0f;
  bool inside = p.x < width && p.y < height, finished = false, resumed = resumes(&s);
  size_t at = (size_t)(first_y + p.y) * s.width + first_x + p.x;
  p.front = (float4)(0.0f, 0.0f, 0.0f, 1.0f);
#ifndef COUNT_FRAGMENTS
  if (resumed && inside) p.front = image[at];
#endif
  p.fragments = 0;
#if BY_DEPTH
  begin_depth(&p.nearest);
#endif
  if (item == 0) {
    clear(&work, 0);
    work.least = INT_MAX;
    work.finished = 0;
  }
  float least_iw = 0.0f;
  int turn = 0;

  // Step -1 draws the base (n = -1) in the mesh's order. The next steps draw the layers of this pass from the
  // outermost to the innermost, and the triangles of each layer from the last to the first, in every sweep.
  int layers = s.end_layer - s.first_layer, steps = layers * (s.end_sweep - s.first_sweep);
  for (int step = -1; step < steps; ++step) {
    int n = step < 0 ? -1 : s.end_layer - 1 - step % layers, sweep = step < 0 ? 0 : s.first_sweep + step / layers;
    int g = n < 0 ? 0 : 1 + (n - s.first_layer) / s.layer_batch;
    int first = list_start[g * tiles + tile], last = list_start[g * tiles + tile + 1];
    pass.n = n;
    pass.layer = layer_at(&s, layer_table, n);
    for (int done = 0; first + done < last; done += GROUP_ITEMS, turn = 1 - turn) {
      // Waits until the previous batch of triangles has been drawn.
      barrier(CLK_LOCAL_MEM_FENCE);
      // Clears the masks of the previous batch, which the next batch will use. No work-item reads the masks any more.
      if (item == 0) clear(&work, 1 - turn);
      if (first + done + item < last) {
        int entry = n < 0 ? first + done + item : last - 1 - done - item;
        put_triangle(&s, &work, turn, item, n, sweep, triangles_at(&s, m, n, gather_rows(m.corners, list[entry]), origin_x, origin_y), width, height, least_iw);
      }
      barrier(CLK_LOCAL_MEM_FENCE);
      ulong fans = raised(work.clipped[turn]), mine = 0;
      for (ulong rest = raised(work.live[turn]); rest; rest &= rest - 1) {
        int slot = lowest_bit(rest);
        mine |= (work.drawn.covered[slot] >> item & 1) << slot;
      }
      if (n >= 0) p.fragments += (uint)popcount(mine);
      // Draws the triangles in the order of their slots. Each iteration first draws the triangles in the
      // slots before the next triangle that needs clipping. It then clips and draws that next triangle.
      for (;;) {
        ulong before = fans ? below_bit(lowest_bit(fans)) : ~(ulong)0;
        for (; mine & before; mine &= mine - 1) {
          int slot = lowest_bit(mine);
          draw(&pass, &work.drawn, slot, perspective_in(&work.drawn, slot, p.x, p.y), &p);
        }
        if (fans == 0) break;
        draw_clipped(&pass, m, &work, lowest_bit(fans), item, origin_x, origin_y, width, height, &p);
        fans &= fans - 1;
      }
    }
#ifndef COUNT_FRAGMENTS
    if (n < 0) {
      // Computes the least 1/w of the base in the tile. The base hides every fragment whose 1/w is smaller.
      barrier(CLK_LOCAL_MEM_FENCE);
      if (inside) atomic_min(&work.least, as_int(p.depth));
      barrier(CLK_LOCAL_MEM_FENCE);
      least_iw = as_float(work.least);
    } else if (first < last) {
      // Tests whether all pixels of the tile are finished. A layer without triangles skips this test for two
      // reasons. First, such a layer changes no pixel. Second, the loop above executes no barrier for such a
      // layer. With the test, a work-item could write work.finished while another work-item still reads
      // work.finished for the previous layer.
      if (!finished && (!inside || p.front.w <= OPAQUE)) {
        finished = true;
        atomic_inc(&work.finished);
      }
      barrier(CLK_LOCAL_MEM_FENCE);
      if (work.finished == GROUP_ITEMS) break;
    }
#endif
#if BY_DEPTH
    if (step == steps - 1 && another_round(&pass, layer_table, &work, item, inside, &p)) step = -1;
#endif
  }
  if (!inside) return;
#ifdef COUNT_FRAGMENTS
  covered[at] = p.fragments + (resumed ? covered[at] : 0);
#else
  if (suspends(&s)) {
    image[at] = p.front;
    return;
  }
  image[at] = over_base(&s, of.attributes, of.textures, layer_at(&s, layer_table, -1), p.depth > 0.0f, p.base, p.vertex,
                        p.from_centre_x, p.from_centre_y, p.front);
#endif
}
