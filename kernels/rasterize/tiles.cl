// The fast form on CPUs: a work-item owns a tile, sets LANES triangles up at once, queues covered fragments and shades
// LANES of them at once. Layers run from the tips down and triangles backwards, compositing front to back: layers write
// no depth, so 'under' in reverse order is exactly the paper's 'over', and a pixel stops when nothing more can be seen.
#include "rasterize/fan.clh"
#include "rasterize/fragment.clh"

#ifndef TILE_W
#define TILE_W 16
#endif
#ifndef TILE_H
#define TILE_H 32
#endif
#define TILE_PIXELS (TILE_W * TILE_H)
#define NOBODY -1

// Triangles that have been set up, a column per lane.
typedef struct {
  int at[3][LANES], right[3][LANES], down[3][LANES];
  float b1_right[LANES], b1_down[LANES], b2_right[LANES], b2_down[LANES];
  float iw[LANES], iw1[LANES], iw2[LANES];
  int x[LANES], y[LANES];
  int from_x[LANES], from_y[LANES], to_x[LANES], to_y[LANES];   // to_x < from_x: nothing covered
  int vertex[3][LANES];
} Batch;

// Fragments that wait for shading, in order.
typedef struct {
  int count;
  int pixel[LANES];
  float w[LANES];
  float record[RECORD][LANES];
  float surface[RECORD][LANES];          // dX/du, dX/dv: the wet model's
} Queue;

typedef struct {
  float depth[TILE_PIXELS];              // 1/w of the base, 0 where there is none
  float4 colour[TILE_PIXELS];            // gathered colour; w: transmittance
  int base_vertex[3][TILE_PIXELS];
  float base_b1[TILE_PIXELS], base_b2[TILE_PIXELS];
} Tile;

typedef struct {
  int first_x, first_y;                  // the tile's first pixel
  int origin_x, origin_y;                // its centre, 1/256 pixel from the image centre
  int width, height;
} Place;

static inline void keep(Setup t, Triangles b, float least_iw, Batch *out) {
  for (int k = 0; k < 3; ++k) {
    spill_whole(t.edge[k].at, out->at[k]);
    spill_whole(t.edge[k].right, out->right[k]);
    spill_whole(t.edge[k].down, out->down[k]);
  }
  spill_real(t.slope[0].right, out->b1_right);
  spill_real(t.slope[0].down, out->b1_down);
  spill_real(t.slope[1].right, out->b2_right);
  spill_real(t.slope[1].down, out->b2_down);
  spill_real(t.iw, out->iw);
  spill_real(t.iw1, out->iw1);
  spill_real(t.iw2, out->iw2);
  spill_whole(t.x, out->x);
  spill_whole(t.y, out->y);
  truth seen = t.live && (fmax(t.iw, fmax(t.iw1, t.iw2)) >= REAL(least_iw));
  spill_whole(t.left, out->from_x);
  spill_whole(t.top, out->from_y);
  spill_whole(seen ? t.right : WHOLE(-1), out->to_x);
  spill_whole(t.bottom, out->to_y);
  spill_whole(b.vertex[0], out->vertex[0]);
  spill_whole(t.swapped ? b.vertex[2] : b.vertex[1], out->vertex[1]);
  spill_whole(t.swapped ? b.vertex[1] : b.vertex[2], out->vertex[2]);
}

// Barycentrics within the drawn triangle to those within the mesh's, for a piece of a clipped one.
typedef struct { float b1[3], b2[3]; } Piece;

// A covered pixel centre: its 1/w, and the perspective-correct barycentrics of vertices 1 and 2.
typedef struct { float iw, b1, b2; } Point;

static inline Point point_at(const Batch *b, int k, int i, int j) {
  float dx = (float)(SUBPIXEL * i - b->x[k]), dy = (float)(SUBPIXEL * j - b->y[k]);
  float b1 = fma(b->b1_right[k], dx, b->b1_down[k] * dy);
  float b2 = fma(b->b2_right[k], dx, b->b2_down[k] * dy);
  Point p;
  p.iw = fma(b2, b->iw2[k] - b->iw[k], fma(b1, b->iw1[k] - b->iw[k], b->iw[k]));
  p.b1 = b1;
  p.b2 = b2;
  return p;
}

static inline Point in_perspective(const Batch *b, int k, Point p, const Piece *piece) {
  float w = 1.0f / p.iw;
  float b1 = p.b1 * b->iw1[k] * w, b2 = p.b2 * b->iw2[k] * w;
  if (piece) {
    float b0 = 1.0f - b1 - b2;
    p.b1 = b0 * piece->b1[0] + b1 * piece->b1[1] + b2 * piece->b1[2];
    p.b2 = b0 * piece->b2[0] + b1 * piece->b2[1] + b2 * piece->b2[2];
  } else {
    p.b1 = b1;
    p.b2 = b2;
  }
  return p;
}

typedef struct {
  TABLE(float) records;
  TABLE(float) tangents;
  Textures textures;
} Attributes;

static inline Surface surface_of(const RasterParams *s, const Queue *q, const Place *place) {
  Surface p;
  p.uv = vec2(fill_real(q->record[0]), fill_real(q->record[1]));
  p.a = vec3(fill_real(q->record[2]), fill_real(q->record[3]), fill_real(q->record[4]));
  p.b = vec3(fill_real(q->record[5]), fill_real(q->record[6]), fill_real(q->record[7]));
  p.along_u = p.a;
  p.along_v = p.a;
  if (s->wet_model) {
    p.along_u = vec3(fill_real(q->surface[0]), fill_real(q->surface[1]), fill_real(q->surface[2]));
    p.along_v = vec3(fill_real(q->surface[3]), fill_real(q->surface[4]), fill_real(q->surface[5]));
  }
  p.w = fill_real(q->w);
  whole pixel = fill_whole(q->pixel);
  p.x = to_real(pixel % TILE_W + place->first_x) + (0.5f - 0.5f * (float)s->width);
  p.y = to_real(pixel / TILE_W + place->first_y) + (0.5f - 0.5f * (float)s->height);
  return p;
}

static inline void interpolate_record(TABLE(float) table, int v0, int v1, int v2, float b1, float b2,
                                      float out[RECORD][LANES], int k) {
  float8 r0 = vload8(v0, table), r1 = vload8(v1, table), r2 = vload8(v2, table);
  float8 r = fma((float8)(b2), r2 - r0, fma((float8)(b1), r1 - r0, r0));
  out[0][k] = r.s0;
  out[1][k] = r.s1;
  out[2][k] = r.s2;
  out[3][k] = r.s3;
  out[4][k] = r.s4;
  out[5][k] = r.s5;
  out[6][k] = r.s6;
  out[7][k] = r.s7;
}

// Shades the queued fragments of layer n and blends them in their order; returns how many pixels became opaque.
static int flush(const RasterParams *s, const Attributes *from, Layer l, int n, const Place *place, Queue *q, Tile *tile) {
  int count = q->count, opaque = 0;
  if (count == 0) return 0;
  q->count = 0;
  for (int k = count; k < LANES; ++k) {    // the free lanes repeat a real fragment: nothing odd to compute
    q->pixel[k] = q->pixel[0];
    q->w[k] = q->w[0];
    for (int c = 0; c < RECORD; ++c) {
      q->record[c][k] = q->record[c][0];
      q->surface[c][k] = q->surface[c][0];
    }
  }
  Surface p = surface_of(s, q, place);
  Fur f = fur_fragment(s, from->textures, l, n, p);
  if (!some(f.coverage > REAL(0.0f))) return 0;
  real3 c = fur_colour(s, from->textures, l, p, f);
  float alpha[LANES], red[LANES], green[LANES], blue[LANES];
  spill_real(f.coverage, alpha);
  spill_real(c.x, red);
  spill_real(c.y, green);
  spill_real(c.z, blue);
  for (int k = 0; k < count; ++k) {
    float4 behind = tile->colour[q->pixel[k]];
    if (alpha[k] <= 0.0f || behind.w <= OPAQUE) continue;
    float weight = behind.w * alpha[k];
    behind += (float4)(weight * red[k], weight * green[k], weight * blue[k], -weight);
    tile->colour[q->pixel[k]] = behind;
    opaque += behind.w <= OPAQUE;
  }
  return opaque;
}

// Queues the fragments of triangle k; returns how many pixels became opaque meanwhile.
static int draw(const RasterParams *s, const Attributes *from, Layer l, int n, const Place *place, const Batch *b, int k,
                const Piece *piece, Queue *q, Tile *tile, uint *covered) {
  int opaque = 0;
  for (int j = b->from_y[k]; j <= b->to_y[k]; ++j)
    for (int i = b->from_x[k]; i <= b->to_x[k]; ++i) {
      int e0 = b->at[0][k] + b->right[0][k] * i + b->down[0][k] * j;
      int e1 = b->at[1][k] + b->right[1][k] * i + b->down[1][k] * j;
      int e2 = b->at[2][k] + b->right[2][k] * i + b->down[2][k] * j;
      if ((e0 | e1 | e2) < 0) continue;
#ifdef COUNT_FRAGMENTS
      ++*covered;
      continue;
#endif
      int pixel = j * TILE_W + i;
      Point p = point_at(b, k, i, j);
      if (p.iw < tile->depth[pixel] || tile->colour[pixel].w <= OPAQUE) continue;
      float w = 1.0f / p.iw;
      p = in_perspective(b, k, p, piece);
      int at = q->count++;
      q->pixel[at] = pixel;
      q->w[at] = w;
      int v0 = b->vertex[0][k], v1 = b->vertex[1][k], v2 = b->vertex[2][k];
      interpolate_record(from->records, v0, v1, v2, p.b1, p.b2, q->record, at);
      if (s->wet_model) interpolate_record(from->tangents, v0, v1, v2, p.b1, p.b2, q->surface, at);
      if (q->count == LANES) opaque += flush(s, from, l, n, place, q, tile);
    }
  return opaque;
}

// The nearest base triangle at each pixel; the first drawn among equals.
static void draw_base(const Batch *b, int k, const Piece *piece, Tile *tile) {
  for (int j = b->from_y[k]; j <= b->to_y[k]; ++j)
    for (int i = b->from_x[k]; i <= b->to_x[k]; ++i) {
      int e0 = b->at[0][k] + b->right[0][k] * i + b->down[0][k] * j;
      int e1 = b->at[1][k] + b->right[1][k] * i + b->down[1][k] * j;
      int e2 = b->at[2][k] + b->right[2][k] * i + b->down[2][k] * j;
      if ((e0 | e1 | e2) < 0) continue;
      int pixel = j * TILE_W + i;
      Point p = point_at(b, k, i, j);
      if (p.iw <= tile->depth[pixel]) continue;
      tile->depth[pixel] = p.iw;
      p = in_perspective(b, k, p, piece);
      tile->base_b1[pixel] = p.b1;
      tile->base_b2[pixel] = p.b2;
      for (int c = 0; c < 3; ++c) tile->base_vertex[c][pixel] = b->vertex[c][k];
    }
}

// A fan of the polygon that clipping left, as batches; calls draw or draw_base for each piece.
static int draw_clipped(const RasterParams *s, Geometry m, const Attributes *from, Layer l, int n, const Place *place,
                        int v0, int v1, int v2, Batch *pieces, Queue *q, Tile *tile, uint *covered) {
  Cut polygon[POLYGON];
  int corners = clipped_triangle(s, m, l, v0, v1, v2, polygon);
  int opaque = 0;
  for (int i = 1; i + 1 < corners; ++i) {
    // One piece on all lanes: rare enough that the others may idle.
    Triangles b;
    int index[3];
    index[0] = 0;
    index[1] = i;
    index[2] = i + 1;
    for (int c = 0; c < 3; ++c) b.corner[c] = cut_on_screen(polygon[index[c]], place->origin_x, place->origin_y);
    b.vertex[0] = WHOLE(0);
    b.vertex[1] = WHOLE(1);
    b.vertex[2] = WHOLE(2);
    keep(set_up(b.corner[0], b.corner[1], b.corner[2], place->width, place->height), b, 0.0f, pieces);
    Piece piece;
    for (int c = 0; c < 3; ++c) {
      int from_corner = index[pieces->vertex[c][0]];
      piece.b1[c] = polygon[from_corner].b1;
      piece.b2[c] = polygon[from_corner].b2;
    }
    pieces->vertex[0][0] = v0;
    pieces->vertex[1][0] = v1;
    pieces->vertex[2][0] = v2;
    if (n < 0) draw_base(pieces, 0, &piece, tile);
    else opaque += draw(s, from, l, n, place, pieces, 0, &piece, q, tile, covered);
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
      interpolate_record(from->records, v0, v1, v2, b1, b2, q->record, k);
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

// image: width x height, top row first, rgb and coverage. covered: fragments of all layers in each tile, when counting.
__kernel void tile_shells(RasterParams s, TABLE(float) table, TABLE(int) corners, TABLE(int) screen_x, TABLE(int) screen_y,
                          TABLE(float) screen_iw, TABLE(float) vertex, TABLE(float) tip, TABLE(float) dry,
                          TABLE(int) list_start, TABLE(int) list, TABLE(float) records, TABLE(float) tangents,
                          TABLE(int) fur, TABLE(int) coat, TABLE(float) mask, __global float4 *image, __global uint *covered) {
  int tile_index = (int)get_global_id(0);
  int tiles = s.tiles_x * s.tiles_y;
  if (tile_index >= tiles) return;
  Geometry m = {corners, screen_x, screen_y, screen_iw, vertex, tip, dry, table};
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
  Queue queue;
  Batch batch, pieces;
  queue.count = 0;
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
      whole entry = min(WHOLE(begin) + lane_numbers(), WHOLE(end - 1));
      whole triangle = gather_whole(list, entry);
      Triangles b = triangles_at(&s, m, n, triangle, place.origin_x, place.origin_y);
      truth outside = needs_clip(b);
      Setup t = set_up(b.corner[0], b.corner[1], b.corner[2], place.width, place.height);
      t.live = t.live && !outside;
      if (!some(t.live || outside)) continue;
      keep(t, b, least_iw, &batch);
      int clipped[LANES];
      spill_whole(outside ? WHOLE(1) : WHOLE(0), clipped);
      for (int k = 0; k < end - begin; ++k) {
        int lane = n < 0 ? k : end - begin - 1 - k;
        if (clipped[lane])
          live_pixels -= draw_clipped(&s, m, &from, l, n, &place, batch.vertex[0][lane], batch.vertex[1][lane],
                                      batch.vertex[2][lane], &pieces, &queue, &tile, &fragments);
        else if (n < 0)
          draw_base(&batch, lane, 0, &tile);
        else
          live_pixels -= draw(&s, &from, l, n, &place, &batch, lane, 0, &queue, &tile, &fragments);
      }
    }
    if (n < 0) {
      // What lies behind the base everywhere in the tile cannot be seen.
      least_iw = tile.depth[0];
      for (int j = 0; j < place.height; ++j)
        for (int i = 0; i < place.width; ++i) least_iw = fmin(least_iw, tile.depth[j * TILE_W + i]);
#ifdef COUNT_FRAGMENTS
      least_iw = 0.0f;
#endif
    } else {
      live_pixels -= flush(&s, &from, l, n, &place, &queue, &tile);
    }
  }
#ifdef COUNT_FRAGMENTS
  covered[tile_index] = fragments;
#else
  resolve(&s, &from, layer_at(&s, table, -1), &place, &tile, &queue, image);
#endif
}
