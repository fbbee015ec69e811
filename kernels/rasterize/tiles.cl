// The fast form on CPUs: a work-item owns a tile, sets LANES triangles up at once, lays them on the pixels they cover and
// shades blocks of LANES neighbouring pixels. Layers run from the tips down and triangles backwards, compositing front to
// back: layers write no depth, so 'under' in reverse order is exactly the paper's 'over', and a pixel stops when nothing
// more can be seen.
#include "rasterize/fragment.clh"
#include "rasterize/tile_fragments.clh"

typedef struct {
  TABLE(float) records;
  TABLE(float) tangents;
  TABLE(float) curls;
  Textures textures;
} Attributes;

typedef struct {
  float depth[TILE_PIXELS];              // 1/w of the base, 0 where there is none
  float red[TILE_PIXELS], green[TILE_PIXELS], blue[TILE_PIXELS];    // gathered colour
  float through[TILE_PIXELS];            // transmittance of what was gathered; 0 outside the picture
  int base_vertex[3][TILE_PIXELS];
  float base_b1[TILE_PIXELS], base_b2[TILE_PIXELS];
} Tile;

// What a layer's triangles are drawn with.
typedef struct {
  const RasterParams *s;
  Attributes from;
  Place place;
  int n;                                 // -1: the base
  Layer layer;
} Pass;

#if LANES == 16
// Columns of sixteen rows of eight.
INLINE void columns_of(const float8 *row, real out[RECORD]) {
  real4 low = columns_of_rows((float16)(row[0].lo, row[4].lo, row[8].lo, row[12].lo), (float16)(row[1].lo, row[5].lo, row[9].lo, row[13].lo),
                              (float16)(row[2].lo, row[6].lo, row[10].lo, row[14].lo), (float16)(row[3].lo, row[7].lo, row[11].lo, row[15].lo));
  real4 high = columns_of_rows((float16)(row[0].hi, row[4].hi, row[8].hi, row[12].hi), (float16)(row[1].hi, row[5].hi, row[9].hi, row[13].hi),
                              (float16)(row[2].hi, row[6].hi, row[10].hi, row[14].hi), (float16)(row[3].hi, row[7].hi, row[11].hi, row[15].hi));
  out[0] = low.x;
  out[1] = low.y;
  out[2] = low.z;
  out[3] = low.w;
  out[4] = high.x;
  out[5] = high.y;
  out[6] = high.z;
  out[7] = high.w;
}
#else
static inline void columns_of(const float8 *row, real out[RECORD]) { vstore8(*row, 0, out); }
#endif

// A row of RECORD attributes at each of LANES points.
INLINE void interpolate(TABLE(float) table, const Points *p, real out[RECORD]) {
  int v0[LANES], v1[LANES], v2[LANES];
  float b1[LANES], b2[LANES];
  spill_whole(p->v0, v0);
  spill_whole(p->v1, v1);
  spill_whole(p->v2, v2);
  spill_real(p->b1, b1);
  spill_real(p->b2, b2);
  float8 row[LANES];
  for (int k = 0; k < LANES; ++k) {
    float8 r0 = vload8(v0[k], table), r1 = vload8(v1[k], table), r2 = vload8(v2[k], table);
    row[k] = fma((float8)(b2[k]), r2 - r0, fma((float8)(b1[k]), r1 - r0, r0));
  }
  columns_of(row, out);
}

INLINE Surface surface_of(const Pass *pass, const Points *q, whole x, whole y) {
  real c[RECORD];
  interpolate(pass->from.records, q, c);
  Surface p;
  p.uv = vec2(c[0], c[1]);
  p.a = vec3(c[2], c[3], c[4]);
  p.b = vec3(c[5], c[6], c[7]);
  p.along_u = p.a;
  p.along_v = p.a;
  p.curl_u = p.a;
  p.curl_v = p.a;
  if (pass->s->wet_model || pass->s->substeps > 1) {
    interpolate(pass->from.tangents, q, c);
    p.along_u = vec3(c[0], c[1], c[2]);
    p.along_v = vec3(c[3], c[4], c[5]);
  }
  if (pass->s->substeps > 1) {
    interpolate(pass->from.curls, q, c);
    p.curl_u = vec3(c[0], c[1], c[2]);
    p.curl_v = vec3(c[3], c[4], c[5]);
  }
  p.w = q->w;
  p.x = to_real(x + pass->place.first_x) + (0.5f - 0.5f * (float)pass->s->width);
  p.y = to_real(y + pass->place.first_y) + (0.5f - 0.5f * (float)pass->s->height);
  return p;
}

// Shades the triangles in `slot` of a layer at a block's pixels, where wanted, and blends them under what is there.
static void shade(const Pass *pass, const Piece *piece, const Drawn *d, Tile *tile, int block, truth wanted, whole slot) {
  whole x = block_x(block), y = block_y(block);
  Points q = points_at(d, slot, x, y);
  int at = block * LANES;
  real through = fill_real(tile->through + at);
  truth seen = wanted && (q.iw >= fill_real(tile->depth + at)) && (through > REAL(OPAQUE));
  if (!some(seen)) return;
  q = only(seen, q);
  if (piece) q = of_piece(q, piece);
  Surface p = surface_of(pass, &q, x, y);
  Fur f = fur_fragment(pass->s, pass->from.textures, pass->layer, pass->n, p);
  real coverage = seen ? f.coverage : REAL(0.0f);
  if (!some(coverage > REAL(0.0f))) return;
  real3 colour = fur_colour(pass->s, pass->from.textures, pass->layer, p, f);
  real weight = through * coverage;
  spill_real(fill_real(tile->red + at) + weight * colour.x, tile->red + at);
  spill_real(fill_real(tile->green + at) + weight * colour.y, tile->green + at);
  spill_real(fill_real(tile->blue + at) + weight * colour.z, tile->blue + at);
  spill_real(through - weight, tile->through + at);
}

// Keeps the nearest base triangle at a block's pixels; the first drawn among equals.
static void keep_nearest(const Piece *piece, const Drawn *d, Tile *tile, int block, truth wanted, whole slot) {
  Points q = points_at(d, slot, block_x(block), block_y(block));
  int at = block * LANES;
  real depth = fill_real(tile->depth + at);
  truth nearer = wanted && (q.iw > depth);
  if (!some(nearer)) return;
  spill_real(nearer ? q.iw : depth, tile->depth + at);
  if (piece) q = of_piece(q, piece);
  spill_real(nearer ? q.b1 : fill_real(tile->base_b1 + at), tile->base_b1 + at);
  spill_real(nearer ? q.b2 : fill_real(tile->base_b2 + at), tile->base_b2 + at);
  spill_whole(nearer ? q.v0 : fill_whole(tile->base_vertex[0] + at), tile->base_vertex[0] + at);
  spill_whole(nearer ? q.v1 : fill_whole(tile->base_vertex[1] + at), tile->base_vertex[1] + at);
  spill_whole(nearer ? q.v2 : fill_whole(tile->base_vertex[2] + at), tile->base_vertex[2] + at);
}

// Draws what has been laid on the pixels, and clears them.
static void flush(const Pass *pass, const Piece *piece, Drawn *d, Tile *tile) {
  if (d->deepest == 0) {
    d->used = 0;
    return;
  }
  for (int block = 0; block < BLOCKS; ++block) {
    int at = block * LANES;
    whole count = fill_whole(d->count + at);
    for (int k = 0; k < d->deepest; ++k) {
      truth wanted = count > WHOLE(k);
      if (!some(wanted)) break;
      whole slot = wanted ? fill_whole(d->slot[k] + at) : WHOLE(0);
#ifdef COUNT_FRAGMENTS
      if (pass->n >= 0) continue;
#endif
      if (pass->n >= 0) shade(pass, piece, d, tile, block, wanted, slot);
      else keep_nearest(piece, d, tile, block, wanted, slot);
    }
    spill_whole(WHOLE(0), d->count + at);
  }
  d->used = 0;
  d->deepest = 0;
}

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
    if (!keep(set_up(b.corner[0], b.corner[1], b.corner[2], place->width, place->height), b, 0.0f, d, batch)) continue;
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
static int draw_with_clipping(const Pass *pass, Geometry m, Triangles b, int count, float least_iw, Batch *batch, Drawn *d,
                              Tile *tile) {
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
    } else if (keep(t, b, least_iw, d, batch) && batch->covering[lane]) {
      covered += cover_pixels(batch, lane, lane, d);
      flush(pass, 0, d, tile);
    }
  }
  return covered;
}

// The base's colour over the background, or the background, behind what the layers left.
static void resolve(const Pass *base, const Tile *tile, __global float4 *image) {
  const RasterParams *s = base->s;
  const Place *place = &base->place;
  for (int block = 0; block < BLOCKS; ++block) {
    int at = block * LANES;
    whole x = block_x(block), y = block_y(block);
    real depth = fill_real(tile->depth + at);
    truth covered = depth > REAL(0.0f);
    Points q;
    q.v0 = covered ? fill_whole(tile->base_vertex[0] + at) : WHOLE(0);
    q.v1 = covered ? fill_whole(tile->base_vertex[1] + at) : WHOLE(0);
    q.v2 = covered ? fill_whole(tile->base_vertex[2] + at) : WHOLE(0);
    q.b1 = fill_real(tile->base_b1 + at);
    q.b2 = fill_real(tile->base_b2 + at);
    q.w = 1.0f / depth;
    q = only(covered, q);
    real3 skin = skin_colour(s, base->from.textures, base->layer, surface_of(base, &q, x, y));
    real through = fill_real(tile->through + at);
    real behind = covered ? REAL(1.0f) : REAL(0.0f);
    float red[LANES], green[LANES], blue[LANES], coverage[LANES];
    spill_real(fill_real(tile->red + at) + through * (covered ? skin.x : REAL(s->background[0])), red);
    spill_real(fill_real(tile->green + at) + through * (covered ? skin.y : REAL(s->background[1])), green);
    spill_real(fill_real(tile->blue + at) + through * (covered ? skin.z : REAL(s->background[2])), blue);
    spill_real(1.0f - through * (1.0f - behind), coverage);
    int left = block % BLOCKS_ACROSS * BLOCK, top = block / BLOCKS_ACROSS * BLOCK;
    for (int k = 0; k < LANES; ++k) {
      int i = left + (k & (BLOCK - 1)), j = top + (k >> BLOCK_LOG);
      if (i >= place->width || j >= place->height) continue;
      image[(size_t)(place->first_y + j) * s->width + place->first_x + i] = (float4)(red[k], green[k], blue[k], coverage[k]);
    }
  }
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
        covered_pixels += draw_with_clipping(&pass, m, b, count, least_iw, &batch, &drawn, &tile);
        continue;
      }
      if (!some(fmax(b.corner[0].iw, fmax(b.corner[1].iw, b.corner[2].iw)) >= REAL(least_iw))) continue;
      if (!keep(set_up(b.corner[0], b.corner[1], b.corner[2], place->width, place->height), b, least_iw, &drawn, &batch))
        continue;
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
