// The fast form on CPUs: a work-item owns a tile, sets LANES triangles up at once, lays them on the pixels they cover and
// shades blocks of LANES neighbouring pixels. Layers run from the tips down and triangles backwards, compositing front to
// back: layers write no depth, so 'under' in reverse order is exactly the paper's 'over', and a pixel stops when nothing
// more can be seen.
#include "rasterize/tile_blocks.clh"

// The fan of the polygon that clipping leaves of a triangle, piece by piece; nothing may be waiting. Returns the number of
// covered fragments.
static int draw_clipped(const Pass *pass, Geometry m, int v0, int v1, int v2, Batch *batch, Drawn *d, Tile *tile) {
  const Place *place = &pass->place;
  Cut polygon[POLYGON];
  int corners = clipped_triangle(pass->s, m, pass->layer, v0, v1, v2, polygon);
  int covered = 0;
  for (int i = 1; i + 1 < corners; ++i) {
    // One piece on all lanes: rare enough that the others may idle.
    Triangles b;
    int index[3] = {0, i, i + 1};
    for (int c = 0; c < 3; ++c) b.corner[c] = cut_on_screen(polygon[index[c]], place->origin_x, place->origin_y);
    for (int c = 0; c < 3; ++c) b.vertex[c] = WHOLE(c);
    if (!keep(set_up(b.corner[0], b.corner[1], b.corner[2], place->width, place->height), b, d, batch)) continue;
    Piece piece;
    for (int c = 0; c < 3; ++c) {
      int drawn_corner = index[as_int(d->vertex[1 + c])];
      piece.b1[c] = polygon[drawn_corner].b1;
      piece.b2[c] = polygon[drawn_corner].b2;
    }
    d->vertex[1] = as_float(v0);
    d->vertex[2] = as_float(v1);
    d->vertex[3] = as_float(v2);
    covered += cover_pixels(batch, 0, 0, d);
    flush(pass, &piece, d, tile);
  }
  return covered;
}

// A batch with triangles that need clipping, rare: triangle by triangle, so that the order holds.
static int draw_with_clipping(const Pass *pass, Geometry m, Triangles b, int count, Batch *batch, Drawn *d, Tile *tile) {
  flush(pass, 0, d, tile);
  truth outside = needs_clip(b);
  Setup t = set_up(b.corner[0], b.corner[1], b.corner[2], pass->place.width, pass->place.height);
  t.live = t.live && !outside;
  int clipped[LANES], corner[3][LANES];
  spill_whole(outside ? WHOLE(1) : WHOLE(0), clipped);
  for (int c = 0; c < 3; ++c) spill_whole(b.vertex[c], corner[c]);
  int covered = 0;
  for (int k = 0; k < count; ++k) {
    int lane = pass->n < 0 ? k : count - 1 - k;
    if (clipped[lane]) {
      covered += draw_clipped(pass, m, corner[0][lane], corner[1][lane], corner[2][lane], batch, d, tile);
    } else if (keep(t, b, d, batch) && batch->covering[lane]) {
      covered += cover_pixels(batch, lane, lane, d);
      flush(pass, 0, d, tile);
    }
  }
  return covered;
}

// LANES entries of a bin list, which is padded at its end; those from `count` on repeat the first.
static inline whole load_entries(TABLE(int) list, int count) {
  whole entry = load_whole(list, 0);
  return lane_numbers() < WHOLE(count) ? entry : WHOLE(list[0]);
}

// image: width x height, top row first, rgb and coverage. covered: fragments of all layers in each tile, when counting.
__kernel void tile_shells(RasterParams s, TABLE(float) table, TABLE(float) corners, TABLE(float) screen,
                          TABLE(float) vertex, TABLE(float) tip, TABLE(float) dry,
                          TABLE(int) list_start, TABLE(int) list, TABLE(float) records, TABLE(float) tangents, TABLE(float) curls,
                          TABLE(int) fur, TABLE(int) coat, TABLE(float) mask, __global float4 *image, __global uint *covered) {
  int tile_index = (int)get_global_id(0);
  int tiles = s.tiles_x * s.tiles_y;
  if (tile_index >= tiles) return;
  Geometry m = {corners, screen, vertex, tip, dry, table};
  Pass pass;
  pass.s = &s;
  pass.from.records = records;
  pass.from.tangents = tangents;
  pass.from.curls = curls;
  pass.from.textures.fur = fur;
  pass.from.textures.coat = coat;
  pass.from.textures.mask = mask;
  Place *place = &pass.place;
  place->first_x = tile_index % s.tiles_x * TILE_W;
  place->first_y = tile_index / s.tiles_x * TILE_H;
  place->origin_x = SUBPIXEL * place->first_x + 128 - 128 * s.width;
  place->origin_y = SUBPIXEL * place->first_y + 128 - 128 * s.height;
  place->width = min(TILE_W, s.width - place->first_x);
  place->height = min(TILE_H, s.height - place->first_y);

  Tile tile;
  Batch batch;
  Drawn drawn;
  drawn.used = 0;
  drawn.deepest = 0;
  for (int k = 0; k < AT_ONCE; ++k) drawn.count[TILE_PIXELS + k] = 0;
  for (int block = 0; block < BLOCKS; ++block) {
    int at = block * LANES;
    truth inside = (block_x(block) < WHOLE(place->width)) && (block_y(block) < WHOLE(place->height));
    spill_whole(WHOLE(0), drawn.count + at);
    spill_real(REAL(0.0f), tile.depth + at);
    spill_real(REAL(0.0f), tile.red + at);
    spill_real(REAL(0.0f), tile.green + at);
    spill_real(REAL(0.0f), tile.blue + at);
    spill_real(inside ? REAL(1.0f) : REAL(0.0f), tile.through + at);
  }
  uint fragments = 0;
  float least_iw = 0.0f;
  bool live = true;

  // n = -1, the base, forwards; then the layers from the outermost one, backwards.
  for (int step = -1; step < s.layers && live; ++step) {
    int n = step < 0 ? -1 : s.layers - 1 - step;
    int g = n < 0 ? 0 : 1 + n / s.group;
    int first = list_start[g * tiles + tile_index], last = list_start[g * tiles + tile_index + 1];
    pass.n = n;
    pass.layer = layer_at(&s, table, n);
    int covered_pixels = 0;
    for (int done = 0; first + done < last; done += LANES) {
      int begin = n < 0 ? first + done : max(last - done - LANES, first);
      int end = n < 0 ? min(first + done + LANES, last) : last - done;
      int count = end - begin;
      // Beyond the last entry the first stands in; it is never laid on a pixel.
      whole triangle = load_entries(list + begin, count);
      Triangles b = triangles_at(&s, m, n, triangle, place->origin_x, place->origin_y);
      int next = last - done - 2 * LANES;
      if (n >= 0 && next >= first) triangles_soon(&s, m, n, load_whole(list + next, 0));
      if (some(needs_clip(b))) {
        covered_pixels += draw_with_clipping(&pass, m, b, count, &batch, &drawn, &tile);
        continue;
      }
      truth drawn_here = (b.reach > WHOLE(n)) && (fmax(b.corner[0].iw, fmax(b.corner[1].iw, b.corner[2].iw)) >= REAL(least_iw));
      if (!some(drawn_here)) continue;
      Setup t = set_up(b.corner[0], b.corner[1], b.corner[2], place->width, place->height);
      t.live = t.live && drawn_here;
      if (!keep(t, b, &drawn, &batch)) continue;
      int slot = drawn.used;
      drawn.used += LANES;
      // Those that cover something, in drawing order; collected without a branch.
      int lanes[LANES], covering = 0;
      for (int k = 0; k < count; ++k) {
        int lane = n < 0 ? k : count - 1 - k;
        lanes[covering] = lane;
        covering += batch.covering[lane];
      }
      for (int k = 0; k < covering; ++k) {
        int lane = lanes[k];
        if (drawn.deepest == DEEP) {
          flush(&pass, 0, &drawn, &tile);
          drawn.used = slot + LANES;   // the rest of this batch still stands in its slots
        }
        covered_pixels += cover_pixels(&batch, lane, slot + lane, &drawn);
      }
      if (drawn.used + LANES > SLOTS) flush(&pass, 0, &drawn, &tile);
    }
    flush(&pass, 0, &drawn, &tile);
    if (n < 0) {
      // What lies behind the base everywhere in the tile cannot be seen.
      least_iw = tile.depth[0];
      for (int j = 0; j < place->height; ++j)
        for (int i = 0; i < place->width; ++i) least_iw = fmin(least_iw, tile.depth[column_number(i) + row_number(j)]);
#ifdef COUNT_FRAGMENTS
      least_iw = 0.0f;
#endif
    } else {
      fragments += (uint)covered_pixels;
      live = false;
      for (int block = 0; block < BLOCKS; ++block) live = live || some(fill_real(tile.through + block * LANES) > REAL(OPAQUE));
    }
  }
#ifdef COUNT_FRAGMENTS
  covered[tile_index] = fragments;
#else
  pass.n = -1;
  pass.layer = layer_at(&s, table, -1);
  resolve(&pass, &tile, image);
#endif
}
