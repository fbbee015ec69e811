// Draws strands, one tile per work-item at a time. The strands of a tile are drawn from front to back. put_vertices() and
// segments_of() compute the segments (segments.clh). draw_strand() then finds the fragments of one strand after the other,
// LANES rows of its segments at once, and appends them to a queue. drain() blends the fragments of the queue in their order.
// The kernel always has 16 lanes.
#undef LANES
#define LANES 16
#include "strands/draw/segments.clh"

#define TILE_PIXELS (STRAND_TILE * STRAND_TILE)
// The kernel looks for closed blocks after each CHECK_EVERY times LANES strands.
#define CHECK_EVERY (128 / LANES)

// drain() is called when the queue has more than QUEUE_FULL fragments. draw_strand() appends at most QUEUE_MORE fragments
// between two tests.
#define QUEUE_FULL 256
#define QUEUE_MORE (LANES * STRAND_TILE + LANES)

// Fragments that wait for blending: the pixel's number in the tile, alpha times colour, and alpha with the opposite sign.
typedef struct {
  int used;
  int pixel[QUEUE_FULL + QUEUE_MORE] ALIGNED;
  int red[QUEUE_FULL + QUEUE_MORE] ALIGNED, green[QUEUE_FULL + QUEUE_MORE] ALIGNED, blue[QUEUE_FULL + QUEUE_MORE] ALIGNED;
  int through[QUEUE_FULL + QUEUE_MORE] ALIGNED;     // bits of floats, like the colours
} Queue;

typedef struct {
  // Red, green, blue and transmittance of each pixel. One more pixel receives the fragments that fill up the queue.
  float pixel[4 * (TILE_PIXELS + 1)] ALIGNED;
  ulong closed;                                     // bit i: block i receives no more fragments
} Tile;

// Adds a fragment behind those that the pixel has: colour += T a C and T -= T a. fragment: a C and -a.
INLINE void blend(float *pixel, float4 fragment) {
  float4 d = vload4(0, pixel);
  vstore4(fma((float4)(d.w), fragment, d), 0, pixel);
}

static void drain(Queue *q, Tile *tile) {
  for (int i = 0; i < LANES; ++i) q->pixel[q->used + i] = TILE_PIXELS;    // fills up the last LANES fragments
  for (int i = 0; i < q->used; i += LANES) {
    real4 v = {bits_as_real(fill_whole(q->red + i)), bits_as_real(fill_whole(q->green + i)), bits_as_real(fill_whole(q->blue + i)),
               bits_as_real(fill_whole(q->through + i))};
    float fragment[4 * LANES] ALIGNED;
    spill_rows(v, fragment);
    UNROLL for (int k = 0; k < LANES; ++k) blend(tile->pixel + 4 * q->pixel[i + k], vload4(k, fragment));
  }
  q->used = 0;
}

// A list of the rows of a strand: first all rows of the first segment, then all rows of the next segment, and so on. An
// element of this list is called an item. The items of segment order[j] begin with item start[j].
typedef struct {
  int order[LANES] ALIGNED, start[LANES] ALIGNED;
  int segments, items;
  int columns;                  // largest number of pixels in a row
} Items;

// Lists the items of the segments `first` to `first` + VERTICES - 1 of g.
INLINE void list_items(const Segments *g, int first, Items *out) {
  int used = 0, items = 0, columns = 0;
  UNROLL for (int k = first; k < first + VERTICES; ++k) {
    int rows = g->rows[k];
    out->order[used] = k;
    out->start[used] = items;
    items += rows;
    used += rows > 0;
    columns = max(columns, rows > 0 ? g->columns[k] : 0);
  }
  out->segments = used;
  out->items = items;
  out->columns = columns;
}

// The value of a column of the vertices at the start of the segments, and its change to their end.
typedef struct { real at, step; } Change;

// vertices: the column's values, from the first vertex of segment 0 on.
INLINE Change change_of(const float *vertices, whole segment) {
  Change c;
  c.at = permuted(fill_real(vertices), segment);
  c.step = permuted(fill_real(vertices + 1), segment) - c.at;
  return c;
}

INLINE real value_at(Change c, real s) { return fma(s, c.step, c.at); }

// Appends the fragments of the items `base` to `base` + LANES - 1 to the queue. strand: number of the first strand whose segments g holds.
INLINE void draw_items(const Strips *strips, int strand, const Segments *g, const Items *items, int base, Queue *q) {
  whole item = lane_numbers() + base, nth = WHOLE(0);
  for (int j = 1; j < items->segments; ++j) nth = nth + (item >= WHOLE(items->start[j]) ? WHOLE(1) : WHOLE(0));
  whole segment = permuted_whole(fill_whole(items->order), nth);
#define COLUMN(name) permuted(fill_real(g->column[name]), segment)
  truth exists = item < WHOLE(items->items);
  real a_major = COLUMN(A_MAJOR), a_minor = COLUMN(A_MINOR), e_major = COLUMN(E_MAJOR), e_minor = COLUMN(E_MINOR);
  real major = COLUMN(FIRST_ROW) + to_real(item - permuted_whole(fill_whole(items->start), nth)), from_a = major - a_major;
  real minor = greater(-floor_real(COLUMN(REACH) - fma(from_a, COLUMN(SLOPE), a_minor)), REAL(0.0f));
  real along_row = from_a * e_major, across_row = -(from_a * e_minor);
  real mitre_a_minor = COLUMN(MITRE_A_MINOR), mitre_b_minor = COLUMN(MITRE_B_MINOR), b_minor = COLUMN(B_MINOR);
  real mitre_a_row = from_a * COLUMN(MITRE_A_MAJOR), mitre_b_row = (major - COLUMN(B_MAJOR)) * COLUMN(MITRE_B_MAJOR);
  real stride_major = COLUMN(STRIDE_MAJOR), stride_minor = (STRAND_TILE + 1.0f) - stride_major, place_row = major * stride_major;
  real per_length = COLUMN(PER_LENGTH), before = COLUMN(BEFORE), behind = COLUMN(BEHIND);
#undef COLUMN
#define CHANGE(name) change_of(strips->column[name] + strand * VERTICES, segment)
  Change radius = CHANGE(RADIUS), alpha = CHANGE(ALPHA), red = CHANGE(RED), green = CHANGE(GREEN), blue = CHANGE(BLUE);
#undef CHANGE
  int used = q->used;
  for (int column = 0; column < items->columns; ++column) {
    real from = minor - a_minor;
    // The two tests of a common vertex have the same operations in both segments, so no pixel belongs to both. The products
    // are rounded before they are added: then the sum does not depend on which axis is the major one.
    truth inside = exists && (minor < REAL((float)STRAND_TILE)) && (from * mitre_a_minor + mitre_a_row >= REAL(0.0f)) &&
                   ((minor - b_minor) * mitre_b_minor + mitre_b_row < REAL(0.0f));
    real along = fma(from, e_minor, along_row), across = fma(from, e_major, across_row);
    inside = inside && (along >= before) && (along <= behind);
    real s = lesser(greater(along * per_length, REAL(0.0f)), REAL(1.0f));
    real wide = value_at(radius, s);
    real coverage = lesser(across + wide, REAL(0.5f)) - greater(across - wide, REAL(-0.5f));
    inside = inside && (coverage > REAL(0.0f));
    real a = coverage * value_at(alpha, s);
    squeeze(bits_as_whole(a * value_at(red, s)), inside, q->red + used);
    squeeze(bits_as_whole(a * value_at(green, s)), inside, q->green + used);
    squeeze(bits_as_whole(a * value_at(blue, s)), inside, q->blue + used);
    squeeze(bits_as_whole(-a), inside, q->through + used);
    used += squeeze(to_whole(fma(minor, stride_minor, place_row)), inside, q->pixel + used);
    minor = minor + 1.0f;
  }
  q->used = used;
}

// Appends the fragments of one strand to the queue. g holds the segments of two strands. `strand` is the number of the first
// of the two. `first` selects one of them: 0 is the first strand, VERTICES the second.
INLINE void draw_strand(const Strips *strips, int strand, const Segments *g, int first, Queue *q, Tile *tile) {
  Items items;
  list_items(g, first, &items);
  for (int base = 0; base < items.items; base += LANES) {
    draw_items(strips, strand, g, &items, base, q);
    if (q->used > QUEUE_FULL) drain(q, tile);
  }
}

// Returns the mask of the blocks of a strand. spot: left, top, right and bottom block, 4 bits each (bins.cl).
INLINE ulong blocks_of_spot(ushort spot) {
  int left = spot & 15, top = (spot >> 4) & 15, right = (spot >> 8) & 15, bottom = spot >> 12;
  ulong row = ((2ul << right) - 1) & ~((1ul << left) - 1), mask = 0;
  for (int y = top; y <= bottom; ++y) mask |= row << (y * TILE_BLOCKS);
  return mask;
}

// Finds the blocks in which all pixels have at most the transmittance STRAND_OPAQUE.
static void find_closed(Tile *tile) {
  for (int block = 0; block < TILE_BLOCKS * TILE_BLOCKS; ++block) {
    if (tile->closed >> block & 1) continue;
    const float *first = tile->pixel + 4 * (block / TILE_BLOCKS * BLOCK_SIDE * STRAND_TILE + block % TILE_BLOCKS * BLOCK_SIDE);
    bool open = false;
    for (int y = 0; y < BLOCK_SIDE && !open; ++y)
      for (int x = 0; x < BLOCK_SIDE; ++x) open |= first[4 * (y * STRAND_TILE + x) + 3] > STRAND_OPAQUE;
    if (!open) tile->closed |= 1ul << block;
  }
}

// The pixels of a tile beyond the edges of the picture receive no fragments.
static void clear(Tile *tile, int width, int height) {
  for (int i = 0; i < TILE_PIXELS; ++i) {
    bool seen = i % STRAND_TILE < width && i / STRAND_TILE < height;
    vstore4((float4)(0.0f, 0.0f, 0.0f, seen ? 1.0f : 0.0f), i, tile->pixel);
  }
  tile->closed = 0;
}

// Draws the strands of a tile. list, spot: the tile's list of strands, and their blocks; count: its length.
static void draw_strands(const DrawParams *p, TABLE(float) rows, TABLE(int) film, TABLE(int) list, TABLE(ushort) spot, int count, float origin_x,
                         float origin_y, Tile *tile, Queue *q) {
  const ulong all = ~0ul >> (64 - TILE_BLOCKS * TILE_BLOCKS);
  Strips strips;
  int next = 0, until_check = 0;
  while (next < count && tile->closed != all) {
    int strand[LANES] ALIGNED, taken = 0;
    for (; taken < LANES && next < count; ++next) {
      strand[taken] = list[next];
      taken += tile->closed == 0 || (blocks_of_spot(spot[next]) & ~tile->closed) != 0;
    }
    if (taken == 0) break;
    for (int i = taken; i < LANES; ++i) strand[i] = strand[0];
    put_vertices(p, film, load_row(rows, fill_whole(strand)), origin_x, origin_y, &strips);
    for (int i = 0; i < taken; i += 2) {
      Segments segments;
      segments_of(p, &strips, i, &segments);
      draw_strand(&strips, i, &segments, 0, q, tile);
      if (i + 1 < taken) draw_strand(&strips, i, &segments, VERTICES, q, tile);
    }
    if (++until_check == CHECK_EVERY) {
      drain(q, tile);
      find_closed(tile);
      until_check = 0;
    }
  }
  drain(q, tile);
}

// Stores a colour that no kernel of this frame reads. A non-temporal store does not first read the memory into the cache.
#if BUILTIN(__builtin_nontemporal_store)
#define STORE(value, place) __builtin_nontemporal_store(value, place)
#else
#define STORE(value, place) (*(place) = (value))
#endif

// Each work-item takes one tile after the other, so that tiles with many strands are distributed over the work-items.
// taken: number of the next tile that no work-item has taken, initially 0. blank[i] is 1 if tile i of the picture has the
// colour of the background everywhere; the kernel does not write such a tile again if it has no strands.
__kernel void strand_tiles(DrawParams p, TABLE(float) rows, TABLE(int) film, TABLE(int) list_start, TABLE(int) list, TABLE(ushort) spot,
                           __global float4 *image, __global int *taken, __global int *blank) {
  Tile tile;
  Queue queue;
  queue.used = 0;
  for (int number = atomic_inc(taken); number < p.tiles_x * p.tiles_y; number = atomic_inc(taken)) {
    int first_x = number % p.tiles_x * STRAND_TILE, first_y = number / p.tiles_x * STRAND_TILE;
    int width = min(STRAND_TILE, p.width - first_x), height = min(STRAND_TILE, p.height - first_y);
    int first = list_start[number], count = list_start[number + 1] - first;
    if (count == 0 && blank[number]) continue;
    blank[number] = count == 0;
    clear(&tile, width, height);
    draw_strands(&p, rows, film, list + first, spot + first, count, (float)first_x + 0.5f - 0.5f * (float)p.width,
                 (float)first_y + 0.5f - 0.5f * (float)p.height, &tile, &queue);
    float4 background = (float4)(p.background[0], p.background[1], p.background[2], -1.0f);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        float4 d = vload4(y * STRAND_TILE + x, tile.pixel);
        float4 c = fma((float4)(d.w), background, (float4)(d.x, d.y, d.z, 1.0f));
        STORE(c, image + (size_t)(first_y + y) * p.width + first_x + x);
      }
  }
}
