// Draws strands, one tile per work-item at a time. The strands of a tile are drawn from front to back. For LANES strands at
// once, set_up() computes the segments. draw_strand() then finds the fragments of one strand after the other, and appends
// them to a queue. drain() blends the fragments of the queue in their order.
#include "strands/draw/segments.clh"

#define TILE_PIXELS (STRAND_TILE * STRAND_TILE)
#define ALIGNED __attribute__((aligned(64)))

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

#if AT_ONCE == 2
#define COLUMN(name) lane_pairs(&g->column[name][pair][strand][0])
#define LANE_ROW to_real(lane_numbers() >> 1)
#else
#define COLUMN(name) g->column[name][pair][strand][0]
#define LANE_ROW REAL(0.0f)
#endif

// Appends the fragments of a pair of segments to the queue.
INLINE void draw_pair(const Segments *g, int pair, int strand, Queue *q, Tile *tile) {
  int rows = g->rows[pair][strand], columns = g->columns[pair][strand];
  real a_major = COLUMN(A_MAJOR), a_minor = COLUMN(A_MINOR), b_major = COLUMN(B_MAJOR), b_minor = COLUMN(B_MINOR);
  real e_major = COLUMN(E_MAJOR), e_minor = COLUMN(E_MINOR), slope = COLUMN(SLOPE), reach = COLUMN(REACH);
  real mitre_a_major = COLUMN(MITRE_A_MAJOR), mitre_a_minor = COLUMN(MITRE_A_MINOR);
  real mitre_b_major = COLUMN(MITRE_B_MAJOR), mitre_b_minor = COLUMN(MITRE_B_MINOR);
  real per_length = COLUMN(PER_LENGTH), before = COLUMN(BEFORE), behind = COLUMN(BEHIND);
  real radius = COLUMN(HALF), radius_step = COLUMN(HALF_STEP), alpha = COLUMN(ALPHA), alpha_step = COLUMN(ALPHA_STEP);
  real red = COLUMN(RED), red_step = COLUMN(RED_STEP), green = COLUMN(GREEN), green_step = COLUMN(GREEN_STEP);
  real blue = COLUMN(BLUE), blue_step = COLUMN(BLUE_STEP);
  real first_row = COLUMN(FIRST_ROW), rows_here = COLUMN(ROWS), stride_major = COLUMN(STRIDE_MAJOR), stride_minor = COLUMN(STRIDE_MINOR);
  for (int base = 0; base < rows; base += ROWS_AT_ONCE) {
    real row = LANE_ROW + (float)base;
    truth in_row = row < rows_here;
    real major = first_row + row, from_a = major - a_major;
    real minor = greater(-floor_real(reach - fma(from_a, slope, a_minor)), REAL(0.0f));
    real along_row = from_a * e_major, across_row = -(from_a * e_minor);
    real mitre_a_row = from_a * mitre_a_major, mitre_b_row = (major - b_major) * mitre_b_major;
    real place_row = major * stride_major;
    for (int column = 0; column < columns; ++column) {
      real from = minor - a_minor;
      // The two tests of a common vertex have the same operations in both segments, so no pixel belongs to both. The products
      // are rounded before they are added: then the sum does not depend on which axis is the major one.
      truth inside = in_row && (minor < REAL((float)STRAND_TILE)) && (from * mitre_a_minor + mitre_a_row >= REAL(0.0f)) &&
                     ((minor - b_minor) * mitre_b_minor + mitre_b_row < REAL(0.0f));
      real along = fma(from, e_minor, along_row), across = fma(from, e_major, across_row);
      inside = inside && (along >= before) && (along <= behind);
      real s = lesser(greater(along * per_length, REAL(0.0f)), REAL(1.0f));
      real wide = fma(s, radius_step, radius);
      real coverage = lesser(across + wide, REAL(0.5f)) - greater(across - wide, REAL(-0.5f));
      inside = inside && (coverage > REAL(0.0f));
      real a = coverage * fma(s, alpha_step, alpha);
      squeeze(bits_as_whole(a * fma(s, red_step, red)), inside, q->red + q->used);
      squeeze(bits_as_whole(a * fma(s, green_step, green)), inside, q->green + q->used);
      squeeze(bits_as_whole(a * fma(s, blue_step, blue)), inside, q->blue + q->used);
      squeeze(bits_as_whole(-a), inside, q->through + q->used);
      q->used += squeeze(to_whole(fma(minor, stride_minor, place_row)), inside, q->pixel + q->used);
      minor = minor + 1.0f;
    }
    if (q->used > QUEUE_FULL) drain(q, tile);
  }
}
#undef COLUMN
#undef LANE_ROW

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
  Segments segments;
  int next = 0, until_check = 0;
  while (next < count && tile->closed != all) {
    int strand[LANES] ALIGNED, taken = 0;
    for (; taken < LANES && next < count; ++next) {
      strand[taken] = list[next];
      taken += tile->closed == 0 || (blocks_of_spot(spot[next]) & ~tile->closed) != 0;
    }
    if (taken == 0) break;
    for (int i = taken; i < LANES; ++i) strand[i] = strand[0];
    int pairs = set_up(p, film, load_row(rows, fill_whole(strand)), origin_x, origin_y, &segments);
    for (int i = 0; i < taken; ++i)
      for (int pair = 0; pair < pairs; ++pair)
        if (segments.rows[pair][i] > 0) draw_pair(&segments, pair, i, q, tile);
    if (++until_check == CHECK_EVERY) {
      drain(q, tile);
      find_closed(tile);
      until_check = 0;
    }
  }
  drain(q, tile);
}

// Each work-item takes one tile after the other, so that tiles with many strands are distributed over the work-items.
// taken: number of the next tile that no work-item has taken, initially 0.
__kernel void strand_tiles(DrawParams p, TABLE(float) rows, TABLE(int) film, TABLE(int) list_start, TABLE(int) list, TABLE(ushort) spot,
                           __global float4 *image, __global int *taken) {
  Tile tile;
  Queue queue;
  queue.used = 0;
  for (int number = atomic_inc(taken); number < p.tiles_x * p.tiles_y; number = atomic_inc(taken)) {
    int first_x = number % p.tiles_x * STRAND_TILE, first_y = number / p.tiles_x * STRAND_TILE;
    int width = min(STRAND_TILE, p.width - first_x), height = min(STRAND_TILE, p.height - first_y);
    clear(&tile, width, height);
    int first = list_start[number];
    draw_strands(&p, rows, film, list + first, spot + first, list_start[number + 1] - first, (float)first_x + 0.5f - 0.5f * (float)p.width,
                 (float)first_y + 0.5f - 0.5f * (float)p.height, &tile, &queue);
    float4 background = (float4)(p.background[0], p.background[1], p.background[2], -1.0f);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        float4 d = vload4(y * STRAND_TILE + x, tile.pixel);
        float4 c = fma((float4)(d.w), background, (float4)(d.x, d.y, d.z, 1.0f));
        image[(size_t)(first_y + y) * p.width + first_x + x] = c;
      }
  }
}
