// The fast form on CPUs: a work-item owns a tile, sets LANES triangles up at once, queues covered fragments and shades
// LANES of them at once. Layers run from the tips down and triangles backwards, compositing front to back: layers write
// no depth, so 'under' in reverse order is exactly the paper's 'over', and a pixel stops when nothing more can be seen.
#include "rasterize/fragment.clh"
#include "rasterize/tile_fragments.clh"

typedef struct {
  TABLE(float) records;
  TABLE(float) tangents;
  Textures textures;
} Attributes;

#if LANES == 16
// Columns of sixteen rows of eight.
static inline void columns_of(const float8 *row, real out[RECORD]) {
  float16 r0 = (float16)(row[0], row[1]), r1 = (float16)(row[2], row[3]), r2 = (float16)(row[4], row[5]);
  float16 r3 = (float16)(row[6], row[7]), r4 = (float16)(row[8], row[9]), r5 = (float16)(row[10], row[11]);
  float16 r6 = (float16)(row[12], row[13]), r7 = (float16)(row[14], row[15]);
#define COLUMN(c, d) (float16)(r0.s##c, r0.s##d, r1.s##c, r1.s##d, r2.s##c, r2.s##d, r3.s##c, r3.s##d, \
                               r4.s##c, r4.s##d, r5.s##c, r5.s##d, r6.s##c, r6.s##d, r7.s##c, r7.s##d)
  out[0] = COLUMN(0, 8);
  out[1] = COLUMN(1, 9);
  out[2] = COLUMN(2, a);
  out[3] = COLUMN(3, b);
  out[4] = COLUMN(4, c);
  out[5] = COLUMN(5, d);
  out[6] = COLUMN(6, e);
  out[7] = COLUMN(7, f);
#undef COLUMN
}
#else
static inline void columns_of(const float8 *row, real out[RECORD]) { vstore8(*row, 0, out); }
#endif

static inline Surface surface_of(const RasterParams *s, const Queue *q, const Place *place) {
  real c[RECORD];
  columns_of(q->record, c);
  Surface p;
  p.uv = vec2(c[0], c[1]);
  p.a = vec3(c[2], c[3], c[4]);
  p.b = vec3(c[5], c[6], c[7]);
  p.along_u = p.a;
  p.along_v = p.a;
  if (s->wet_model) {
    columns_of(q->surface, c);
    p.along_u = vec3(c[0], c[1], c[2]);
    p.along_v = vec3(c[3], c[4], c[5]);
  }
  p.w = fill_real(q->w);
  whole pixel = fill_whole(q->pixel);
  p.x = to_real(pixel % TILE_W + place->first_x) + (0.5f - 0.5f * (float)s->width);
  p.y = to_real(pixel / TILE_W + place->first_y) + (0.5f - 0.5f * (float)s->height);
  return p;
}

static inline float8 interpolated(TABLE(float) table, int v0, int v1, int v2, float b1, float b2) {
  float8 r0 = vload8(v0, table), r1 = vload8(v1, table), r2 = vload8(v2, table);
  return fma((float8)(b2), r2 - r0, fma((float8)(b1), r1 - r0, r0));
}

// The free lanes repeat a real fragment: nothing odd to compute.
static inline void fill_up(Queue *q) {
  for (int k = q->count; k < LANES; ++k) {
    q->pixel[k] = q->pixel[0];
    q->w[k] = q->w[0];
    q->record[k] = q->record[0];
    q->surface[k] = q->surface[0];
    q->fur[k] = q->fur[0];
  }
}

// Lights the fragments that hold fur and blends them in their order; returns how many pixels became opaque.
static int light(const RasterParams *s, const Attributes *from, const Layer *l, int n, const Place *place, Queue *q, Tile *tile) {
  int count = q->count, opaque = 0;
  if (count == 0) return 0;
  fill_up(q);
  q->count = 0;
  real c[RECORD];
  columns_of(q->fur, c);
  Fur f;
  f.uv = vec2(c[0], c[1]);
  f.coverage = c[2];
  f.detail = c[3];
  f.rho = c[4];
  f.pull = vec2(c[5], c[6]);
  real3 colour = fur_colour(s, from->textures, *l, n, surface_of(s, q, place), f);
  float red[LANES], green[LANES], blue[LANES];
  spill_real(colour.x, red);
  spill_real(colour.y, green);
  spill_real(colour.z, blue);
  for (int k = 0; k < count; ++k) {
    float4 front = tile->colour[q->pixel[k]];
    if (front.w <= OPAQUE) continue;
    float weight = front.w * q->fur[k].s2;
    front += (float4)(weight * red[k], weight * green[k], weight * blue[k], -weight);
    tile->colour[q->pixel[k]] = front;
    opaque += front.w <= OPAQUE;
  }
  return opaque;
}

// Keeps of the queued fragments of layer n those that hold fur; returns how many pixels became opaque.
static int sift(const RasterParams *s, const Attributes *from, const Layer *l, int n, const Place *place, Queue *q, Queue *lit,
                Tile *tile) {
  int count = q->count, opaque = 0;
  if (count == 0) return 0;
  fill_up(q);
  q->count = 0;
  Fur f = fur_fragment(s, from->textures, *l, n, surface_of(s, q, place));
  if (!some(f.coverage > REAL(0.0f))) return 0;
  float coverage[LANES], u[LANES], v[LANES], detail[LANES], rho[LANES], pull_u[LANES], pull_v[LANES];
  spill_real(f.coverage, coverage);
  spill_real(f.uv.x, u);
  spill_real(f.uv.y, v);
  spill_real(f.detail, detail);
  spill_real(f.rho, rho);
  spill_real(f.pull.x, pull_u);
  spill_real(f.pull.y, pull_v);
  for (int k = 0; k < count; ++k) {
    if (coverage[k] <= 0.0f) continue;
    int at = lit->count++;
    lit->pixel[at] = q->pixel[k];
    lit->w[at] = q->w[k];
    lit->record[at] = q->record[k];
    if (s->wet_model) lit->surface[at] = q->surface[k];
    lit->fur[at] = (float8)(u[k], v[k], coverage[k], detail[k], rho[k], pull_u[k], pull_v[k], 0.0f);
    if (lit->count == LANES) opaque += light(s, from, l, n, place, lit, tile);
  }
  return opaque;
}

// Takes the listed fragments that may be seen on to the queue; returns how many pixels became opaque.
static int queue_fragments(const RasterParams *s, const Attributes *from, const Layer *l, int n, const Place *place,
                           const Piece *piece, Drawn *d, Queue *q, Queue *lit, Tile *tile) {
  int opaque = 0;
  for (int first = 0; first < d->count; first += LANES) {
    Points p = points_at(d, first, d->count);
    truth seen = (p.iw >= own_gather(tile->depth, p.pixel)) &&
                 (own_gather((const float *)tile->colour, p.pixel * 4 + 3) > REAL(OPAQUE));
    if (!some(seen)) continue;
    if (piece) p = of_piece(p, piece);
    int wanted[LANES], pixel[LANES], v0[LANES], v1[LANES], v2[LANES];
    float w[LANES], b1[LANES], b2[LANES];
    spill_whole(seen ? WHOLE(1) : WHOLE(0), wanted);
    spill_whole(p.pixel, pixel);
    spill_whole(p.v0, v0);
    spill_whole(p.v1, v1);
    spill_whole(p.v2, v2);
    spill_real(1.0f / p.iw, w);
    spill_real(p.b1, b1);
    spill_real(p.b2, b2);
    int count = min(d->count - first, LANES);
    for (int k = 0; k < count; ++k) {
      if (!wanted[k]) continue;
      int at = q->count++;
      q->pixel[at] = pixel[k];
      q->w[at] = w[k];
      q->record[at] = interpolated(from->records, v0[k], v1[k], v2[k], b1[k], b2[k]);
      if (s->wet_model) q->surface[at] = interpolated(from->tangents, v0[k], v1[k], v2[k], b1[k], b2[k]);
      if (q->count == LANES) opaque += sift(s, from, l, n, place, q, lit, tile);
    }
  }
  d->count = 0;
  d->used = 0;
  return opaque;
}

// The nearest base triangle at each listed fragment; the first drawn among equals.
static void base_fragments(const Piece *piece, Drawn *d, Tile *tile) {
  for (int first = 0; first < d->count; first += LANES) {
    Points p = points_at(d, first, d->count);
    float iw[LANES], b1[LANES], b2[LANES];
    int pixel[LANES], vertex[3][LANES];
    spill_real(p.iw, iw);
    if (piece) p = of_piece(p, piece);
    spill_real(p.b1, b1);
    spill_real(p.b2, b2);
    spill_whole(p.pixel, pixel);
    spill_whole(p.v0, vertex[0]);
    spill_whole(p.v1, vertex[1]);
    spill_whole(p.v2, vertex[2]);
    int count = min(d->count - first, LANES);
    for (int k = 0; k < count; ++k) {
      int at = pixel[k];
      if (iw[k] <= tile->depth[at]) continue;
      tile->depth[at] = iw[k];
      tile->base_b1[at] = b1[k];
      tile->base_b2[at] = b2[k];
      for (int c = 0; c < 3; ++c) tile->base_vertex[c][at] = vertex[c][k];
    }
  }
  d->count = 0;
  d->used = 0;
}

// Everything listed so far, to the base or to the queue; returns how many pixels became opaque.
static int draw(const RasterParams *s, const Attributes *from, const Layer *l, int n, const Place *place, const Piece *piece,
                Drawn *d, Queue *q, Queue *lit, Tile *tile, uint *covered) {
#ifdef COUNT_FRAGMENTS
  if (n >= 0) {
    *covered += (uint)d->count;
    d->count = 0;
    d->used = 0;
    return 0;
  }
#endif
  if (n >= 0) return queue_fragments(s, from, l, n, place, piece, d, q, lit, tile);
  base_fragments(piece, d, tile);
  return 0;
}

// The fan of the polygon that clipping leaves of a triangle, piece by piece; `d` must be empty.
static int draw_clipped(const RasterParams *s, Geometry m, const Attributes *from, const Layer *l, int n, const Place *place,
                        int v0, int v1, int v2, Batch *batch, Drawn *d, Queue *q, Queue *lit, Tile *tile, uint *covered) {
  Cut polygon[POLYGON];
  int corners = clipped_triangle(s, m, *l, v0, v1, v2, polygon);
  int opaque = 0;
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
    list_fragments(batch, 0, 0, d);
    opaque += draw(s, from, l, n, place, &piece, d, q, lit, tile, covered);
  }
  return opaque;
}

// The base's colour over the background, or the background, behind what the layers left.
static void resolve(const RasterParams *s, const Attributes *from, Layer base, const Place *place, Tile *tile, Queue *q,
                    __global float4 *image) {
  for (int first = 0; first < TILE_PIXELS; first += LANES) {
    for (int k = 0; k < LANES; ++k) {
      int pixel = first + k;
      bool covered = tile->depth[pixel] > 0.0f;
      q->pixel[k] = pixel;
      q->w[k] = covered ? 1.0f / tile->depth[pixel] : 1.0f;
      int v0 = covered ? tile->base_vertex[0][pixel] : 0, v1 = covered ? tile->base_vertex[1][pixel] : 0;
      int v2 = covered ? tile->base_vertex[2][pixel] : 0;
      float b1 = covered ? tile->base_b1[pixel] : 0.0f, b2 = covered ? tile->base_b2[pixel] : 0.0f;
      q->record[k] = interpolated(from->records, v0, v1, v2, b1, b2);
      q->surface[k] = q->record[k];
    }
    real3 c = skin_colour(s, from->textures, base, surface_of(s, q, place));
    float red[LANES], green[LANES], blue[LANES];
    spill_real(c.x, red);
    spill_real(c.y, green);
    spill_real(c.z, blue);
    for (int k = 0; k < LANES; ++k) {
      int pixel = first + k, i = pixel % TILE_W, j = pixel / TILE_W;
      if (i >= place->width || j >= place->height) continue;
      bool covered = tile->depth[pixel] > 0.0f;
      float4 front = tile->colour[pixel];
      float4 behind = covered ? (float4)(red[k], green[k], blue[k], 1.0f)
                              : (float4)(s->background[0], s->background[1], s->background[2], 0.0f);
      image[(size_t)(place->first_y + j) * s->width + place->first_x + i] =
          (float4)(front.x + front.w * behind.x, front.y + front.w * behind.y, front.z + front.w * behind.z,
                   1.0f - front.w * (1.0f - behind.w));
    }
  }
  q->count = 0;
}

// LANES entries of a bin list, which is padded at its end; those from `count` on repeat the first.
static inline whole load_entries(TABLE(int) list, int count) {
  whole entry = load_whole(list, 0);
  return lane_numbers() < WHOLE(count) ? entry : WHOLE(list[0]);
}

// image: width x height, top row first, rgb and coverage. covered: fragments of all layers in each tile, when counting.
__kernel void tile_shells(RasterParams s, TABLE(float) table, TABLE(float) corners, TABLE(float) screen,
                          TABLE(float) vertex, TABLE(float) tip, TABLE(float) dry,
                          TABLE(int) list_start, TABLE(int) list, TABLE(float) records, TABLE(float) tangents,
                          TABLE(int) fur, TABLE(int) coat, TABLE(float) mask, __global float4 *image, __global uint *covered) {
  int tile_index = (int)get_global_id(0);
  int tiles = s.tiles_x * s.tiles_y;
  if (tile_index >= tiles) return;
  Geometry m = {corners, screen, vertex, tip, dry, table};
  Attributes from;
  from.records = records;
  from.tangents = tangents;
  from.textures.fur = fur;
  from.textures.coat = coat;
  from.textures.mask = mask;
  Place place;
  place.first_x = tile_index % s.tiles_x * TILE_W;
  place.first_y = tile_index / s.tiles_x * TILE_H;
  place.origin_x = SUBPIXEL * place.first_x + 128 - 128 * s.width;
  place.origin_y = SUBPIXEL * place.first_y + 128 - 128 * s.height;
  place.width = min(TILE_W, s.width - place.first_x);
  place.height = min(TILE_H, s.height - place.first_y);

  Tile tile;
  Queue queue, lit;
  Batch batch;
  Drawn drawn;
  drawn.used = 0;
  drawn.count = 0;
  queue.count = 0;
  lit.count = 0;
  for (int i = 0; i < TILE_PIXELS; ++i) {
    tile.depth[i] = 0.0f;
    tile.colour[i] = (float4)(0.0f, 0.0f, 0.0f, 1.0f);
  }
  int live_pixels = place.width * place.height;
  uint fragments = 0;
  float least_iw = 0.0f;

  // n = -1, the base, forwards; then the layers from the outermost one, backwards.
  for (int step = -1; step < s.layers && live_pixels > 0; ++step) {
    int n = step < 0 ? -1 : s.layers - 1 - step;
    int g = n < 0 ? 0 : 1 + n / s.group;
    int first = list_start[g * tiles + tile_index], last = list_start[g * tiles + tile_index + 1];
    Layer l = layer_at(&s, table, n);
    for (int done = 0; first + done < last && live_pixels > 0; done += LANES) {
      int begin = n < 0 ? first + done : max(last - done - LANES, first);
      int end = n < 0 ? min(first + done + LANES, last) : last - done;
      // Beyond the last entry the first stands in; its fragments are never listed.
      whole triangle = load_entries(list + begin, end - begin);
      Triangles b = triangles_at(&s, m, n, triangle, place.origin_x, place.origin_y);
      truth outside = needs_clip(b);
      if (some(outside)) {
        // Rare: triangle by triangle, so that the order holds.
        live_pixels -= draw(&s, &from, &l, n, &place, 0, &drawn, &queue, &lit, &tile, &fragments);
        int clipped[LANES], corner[3][LANES];
        spill_whole(outside ? WHOLE(1) : WHOLE(0), clipped);
        for (int c = 0; c < 3; ++c) spill_whole(b.vertex[c], corner[c]);
        for (int k = 0; k < end - begin; ++k) {
          int lane = n < 0 ? k : end - begin - 1 - k;
          if (clipped[lane]) {
            live_pixels -= draw_clipped(&s, m, &from, &l, n, &place, corner[0][lane], corner[1][lane], corner[2][lane],
                                        &batch, &drawn, &queue, &lit, &tile, &fragments);
          } else {
            Setup t = set_up(b.corner[0], b.corner[1], b.corner[2], place.width, place.height);
            t.live = t.live && !outside;
            if (keep(t, b, least_iw, &drawn, &batch)) list_fragments(&batch, lane, lane, &drawn);
            live_pixels -= draw(&s, &from, &l, n, &place, 0, &drawn, &queue, &lit, &tile, &fragments);
          }
        }
        continue;
      }
      if (!keep(set_up(b.corner[0], b.corner[1], b.corner[2], place.width, place.height), b, least_iw, &drawn, &batch))
        continue;
      int slot = drawn.used;
      drawn.used += LANES;
      for (int k = 0; k < end - begin; ++k) {
        int lane = n < 0 ? k : end - begin - 1 - k;
        if (batch.to_x[lane] < batch.from_x[lane]) continue;
        if (drawn.count + TILE_PIXELS > FRAGMENTS) {
          live_pixels -= draw(&s, &from, &l, n, &place, 0, &drawn, &queue, &lit, &tile, &fragments);
          drawn.used = slot + LANES;   // the rest of this batch still stands in its slots
        }
        list_fragments(&batch, lane, slot + lane, &drawn);
      }
      if (drawn.used + LANES > SLOTS) live_pixels -= draw(&s, &from, &l, n, &place, 0, &drawn, &queue, &lit, &tile, &fragments);
    }
    live_pixels -= draw(&s, &from, &l, n, &place, 0, &drawn, &queue, &lit, &tile, &fragments);
    if (n < 0) {
      // What lies behind the base everywhere in the tile cannot be seen.
      least_iw = tile.depth[0];
      for (int j = 0; j < place.height; ++j)
        for (int i = 0; i < place.width; ++i) least_iw = fmin(least_iw, tile.depth[j * TILE_W + i]);
#ifdef COUNT_FRAGMENTS
      least_iw = 0.0f;
#endif
    } else {
      live_pixels -= sift(&s, &from, &l, n, &place, &queue, &lit, &tile);
      live_pixels -= light(&s, &from, &l, n, &place, &lit, &tile);
    }
  }
#ifdef COUNT_FRAGMENTS
  covered[tile_index] = fragments;
#else
  resolve(&s, &from, layer_at(&s, table, -1), &place, &tile, &queue, image);
#endif
}
