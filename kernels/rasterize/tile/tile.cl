// Draws the fur by a method that is fast on CPUs: a work-item draws one tile (TILE_W x TILE_H pixels) at a
// time. The work-item sets up LANES triangles at once. It adds each triangle to the lists of the blocks
// (LANES pixels each) that the triangle covers. It shades LANES pixels at once. Silva et al. 2010 (Curling and
// Clumping Fur, section 4) draw the layers from the innermost to the outermost with the 'over' operator. This
// file uses the 'under' operator. It draws the layers from the outermost to the innermost, and the triangles
// of each layer from the last to the first. Both orders blend the same fragments, because layers write no
// depth. Therefore both operators give the same result. A pixel is complete when its transmittance is at most
// OPAQUE. With blend.faces "back-then-front", two such sweeps draw first the triangles that face the eye
// and then the others. If the data of all layers need too much memory, several passes draw the layers. w is the view
// depth. These functions draw a tile:
//
//   draw_layer() sets up the triangles of a layer (this file, coverage/).
//   keep() and cover_pixels() add each triangle to the lists of the blocks that the triangle covers (fragments.clh).
//   find_next() selects the next triangle of each pixel (lists.clh).
//   points_at() computes the barycentric coordinates of each pixel on its triangle (points.clh,
//   coverage/perspective.clh).
//   shade() and flush() compute attributes, clump, fur and light, and blend the fragments (blocks.clh, shading/).
//   find_hidden() runs after the base is drawn. It computes the bounds of 1/w below which the base hides a fragment
//   (hidden.clh).
//   may_be_seen() selects the triangles that may be visible in a layer batch, which consists of consecutive
//   layers (hidden.clh).
//   resolve() adds the base surface or the background (blocks.clh).
#include "rasterize/buffers.clh"
#include "rasterize/coverage/cells.clh"
#include "rasterize/coverage/perspective.clh"
#include "rasterize/geometry/boxes.clh"
#include "rasterize/shading/fragment.clh"
#include "rasterize/tile/fragments.clh"
#include "rasterize/tile/lists.clh"
#include "rasterize/tile/points.clh"
#include "rasterize/tile/blocks.clh"
#include "rasterize/tile/hidden.clh"

// Draws LANES triangles of which some need clipping. The triangles are drawn one by one to keep their order. Of a clipped
// triangle, the fan of triangles of the remaining polygon is drawn. This case is rare, so its speed does not matter.
CALLED int draw_with_clipping(const Pass *pass, Geometry m, Triangles b, int count, Batch *batch, Drawn *d, Tile *tile) {
  const Place *place = &pass->place;
  flush(pass, 0, d, tile);
  truth outside = needs_clip(b);
  int clipped[LANES], vertex[3][LANES];
  spill_whole(outside ? WHOLE(1) : WHOLE(0), clipped);
  for (int c = 0; c < 3; ++c) spill_whole(b.vertex[c], vertex[c]);
  int covered = 0;
  for (int k = 0; k < count; ++k) {
    int lane = pass->n < 0 ? k : count - 1 - k, slot = clipped[lane] ? 0 : lane, corners = 3;
    Cut polygon[POLYGON];
    if (clipped[lane]) corners = clipped_triangle(pass->s, m, pass->layer, vertex[0][lane], vertex[1][lane], vertex[2][lane], polygon);
    for (int i = 1; i + 1 < corners; ++i) {
      Triangles now = b;
      int index[3] = {0, i, i + 1};
      if (clipped[lane]) {               // all lanes set up the same triangle of the fan
        for (int c = 0; c < 3; ++c) now.corner[c] = cut_on_screen(polygon[index[c]], place->origin_x, place->origin_y);
        for (int c = 0; c < 3; ++c) now.vertex[c] = WHOLE(c);
        now.is_dry = false;
      }
      Setup t = set_up(now.corner[0], now.corner[1], now.corner[2], place->width, place->height);
      if (!clipped[lane]) t.live = t.live && !outside;
      if (!(keep(t, now, nearest_of(now), d, batch) >> slot & 1)) continue;
      Piece piece;
      if (clipped[lane])
        for (int c = 0; c < 3; ++c) {
          Cut corner = polygon[index[as_int(d->triangle[9 + c]) / RECORD]];
          piece.b1[c] = corner.b1;
          piece.b2[c] = corner.b2;
          d->triangle[9 + c] = as_float(RECORD * vertex[c][lane]);
        }
      covered += cover_pixels(batch, slot, slot, &pass->hidden, d);
      flush(pass, clipped[lane] ? &piece : 0, d, tile);
    }
  }
  return covered;
}

static void clear(const Place *place, Drawn *d, Tile *tile) {
  clear_entries(d);
  for (int block = 0; block < BLOCKS; ++block) {
    int at = block * LANES;
    truth inside = (block_x(block) < WHOLE(place->width)) && (block_y(block) < WHOLE(place->height));
    spill_real(REAL(0.0f), tile->depth + at);
    spill_real(REAL(0.0f), tile->red + at);
    spill_real(REAL(0.0f), tile->green + at);
    spill_real(REAL(0.0f), tile->blue + at);
    spill_real(inside ? REAL(1.0f) : REAL(0.0f), tile->through + at);
  }
}

// Draws the first `entries` triangles of `from` in the layer pass->n. Returns the number of covered fragments
// if COUNT_FRAGMENTS is defined, else 0.
static int draw_layer(const Pass *pass, Geometry m, const Entries *from, int entries, Batch *batch, Drawn *d, Tile *tile) {
  const Place *place = &pass->place;
  int n = pass->n, covered = 0;
  real4 next_corners;                    // rows of m.corners of the next LANES triangles; valid if `fetched`
  bool fetched = false;
  for (int done = 0; done < entries; done += LANES) {
    int begin = n < 0 ? done : (entries - 1) / LANES * LANES - done;
    int count = min(LANES, entries - begin);
    real4 corners = fetched ? next_corners : corners_at(m, from, begin, count);
    Triangles b = triangles_at(pass->s, m, n, corners, place->origin_x, place->origin_y);
    fetched = n >= 0 && begin > 0;
    if (fetched) {
      next_corners = corners_at(m, from, begin - LANES, LANES);
      triangles_soon(pass->s, m, n, next_corners);
    }
    if (some(needs_clip(b))) {
      covered += draw_with_clipping(pass, m, b, count, batch, d, tile);
      continue;
    }
    real nearest = nearest_of(b);
    truth drawn_here = (b.reach > WHOLE(n)) && (nearest >= REAL(pass->hidden.least[WHOLE_TILE]));
    if (!some(drawn_here)) continue;
    Setup t = set_up(b.corner[0], b.corner[1], b.corner[2], place->width, place->height);
    t.live = t.live && drawn_here;
    t.live = t.live && (nearest >= own_gather(pass->hidden.least, t.live ? rectangle(t.left, t.top, t.right, t.bottom) : WHOLE(0)));
    uint covering = keep(t, b, nearest, d, batch) & ((1u << count) - 1);
    if (covering == 0) continue;
    int slot = d->used;
    d->used += LANES;
    // Takes the triangles that may cover a pixel, in drawing order. Appends each triangle to the list of each
    // block that the triangle covers.
    while (covering != 0) {
      int lane = n < 0 ? first_lane(covering) : last_lane(covering);
      covering ^= 1u << lane;
      if (d->most == ENTRIES) {
        flush(pass, 0, d, tile);
        // flush() frees all rows of d->triangle. The rows of the current LANES triangles must stay, because some of
        // these triangles are not drawn yet.
        d->used = slot + LANES;
      }
      covered += cover_pixels(batch, lane, slot + lane, &pass->hidden, d);
    }
    if (d->used + LANES > SLOTS) flush(pass, 0, d, tile);
  }
  flush(pass, 0, d, tile);
  return covered;
}

static bool anything_seen_through(const Tile *tile) {
  bool seen = false;
  for (int block = 0; block < BLOCKS; ++block) seen = seen || some(fill_real(tile->through + block * LANES) > REAL(OPAQUE));
  return seen;
}

// Reads the colour and transmittance that the previous passes accumulated. The image stores them between passes.
static void resume(const RasterParams *s, const Place *place, Tile *tile, __global const float4 *image) {
  for (int j = 0; j < place->height; ++j)
    for (int i = 0; i < place->width; ++i) {
      float4 front = image[(size_t)(place->first_y + j) * s->width + place->first_x + i];
      int pixel = column_number(i) + row_number(j);
      tile->red[pixel] = front.x;
      tile->green[pixel] = front.y;
      tile->blue[pixel] = front.z;
      tile->through[pixel] = front.w;
    }
}

static void suspend(const RasterParams *s, const Place *place, const Tile *tile, __global float4 *image) {
  for (int j = 0; j < place->height; ++j)
    for (int i = 0; i < place->width; ++i) {
      int pixel = column_number(i) + row_number(j);
      image[(size_t)(place->first_y + j) * s->width + place->first_x + i] =
          (float4)(tile->red[pixel], tile->green[pixel], tile->blue[pixel], tile->through[pixel]);
    }
}

// Draws the base surface, and then the layers of the pass from the outermost to the innermost. Returns the
// number of covered fragments of the layers if COUNT_FRAGMENTS is defined, else 0.
static uint draw_tile(Pass *pass, Geometry m, int number, TABLE(int) list_start, TABLE(int) list, __global int *shown,
                      __global float4 *image) {
  const RasterParams *s = pass->s;
  Place *place = &pass->place;
  place->first_x = number % s->tiles_x * TILE_W;
  place->first_y = number / s->tiles_x * TILE_H;
  place->origin_x = SUBPIXEL * place->first_x + 128 - 128 * s->width;
  place->origin_y = SUBPIXEL * place->first_y + 128 - 128 * s->height;
  place->width = min(TILE_W, s->width - place->first_x);
  place->height = min(TILE_H, s->height - place->first_y);
  Tile tile;
  Batch batch;
  Drawn drawn;
  clear(place, &drawn, &tile);
  hide_nothing(&pass->hidden);

  pass->n = -1;
  pass->layer = layer_at(s, m.layer_table, -1);
  int first = list_start[number], entries = list_start[number + 1] - first;
  Entries listed = {list + first, 0, 0};
  draw_layer(pass, m, &listed, entries, &batch, &drawn, &tile);
#ifndef COUNT_FRAGMENTS
  find_hidden(&tile, place, &pass->hidden);
  if (resumes(s)) resume(s, place, &tile, image);
#endif

  uint fragments = 0;
  if (entries > 0) find_eyes(pass, &tile);
#ifdef COUNT_FRAGMENTS
  int end_sweep = s->first_sweep + (s->first_sweep == 0);    // the first sweep counts the triangles of all sweeps
#else
  int end_sweep = s->end_sweep;
#endif
  for (int sweep = s->first_sweep; sweep < end_sweep; ++sweep)
    for (int g = s->layer_batches - 1; g > 0 && anything_seen_through(&tile); --g) {
#ifdef COUNT_FRAGMENTS
      Entries drawn_here = listed;
      int count = entries;
#else
      __global int *columns = shown + 4 * ((size_t)first + LANES * (size_t)number);
      Entries drawn_here = {0, columns, entries + LANES};
      int count = may_be_seen(pass, m, g, sweep, listed.list, entries, columns, drawn_here.stride);
#endif
      int inner = s->first_layer + (g - 1) * s->layer_batch;
      for (int n = min(inner + s->layer_batch, s->end_layer) - 1; n >= inner && anything_seen_through(&tile); --n) {
        pass->n = n;
        pass->layer = layer_at(s, m.layer_table, n);
        pass->slice = slice_of(s, n);
        fragments += (uint)draw_layer(pass, m, &drawn_here, count, &batch, &drawn, &tile);
      }
    }
#ifndef COUNT_FRAGMENTS
  pass->n = -1;
  pass->layer = layer_at(s, m.layer_table, -1);
  if (suspends(s))
    suspend(s, place, &tile, image);
  else
    resolve(pass, &tile, image);
#endif
  return fragments;
}

// shown: buffer for the triangles that may_be_seen() selects. It has 4 integers per entry of `list`, and 4 * LANES more
// integers per tile. next: number of the next tile that no work-item has taken, initially 0. Each work-item takes one
// tile at a time, so that tiles with much fur are distributed over the work-items.
__kernel void tile_shells(RasterParams s, RASTER_BUFFERS, __global int *shown, __global int *next) {
  RasterBuffers of = RASTER_RECORD;
  Geometry m = of.geometry;
  Pass pass;
  pass.s = &s;
  pass.from = of.attributes;
  pass.textures = of.textures;
  for (int number = atomic_inc(next); number < s.tiles_x * s.tiles_y; number = atomic_inc(next)) {
    uint fragments = draw_tile(&pass, m, number, list_start, list, shown, image);
#ifdef COUNT_FRAGMENTS
    covered[number] = fragments + (resumes(&s) ? covered[number] : 0);
#endif
  }
}
