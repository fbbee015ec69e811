// Draws strands, one tile per work-item at a time. The strands of a tile are drawn from front to back. put_vertices() computes
// the vertices of LANES strands, and segments_of() their segments (segments.clh). find_strand() then finds the fragments of one
// strand after the other, LANES rows of its segments at once, and appends them to a list. blend_strand() computes the colours
// of these fragments and blends them in their order.
#if LANES == 16 && !defined(__AVX512F__)
#undef LANES
#define LANES 8
#endif
#include "strands/draw/pixel.clh"
#include "strands/draw/segments.clh"

#define TILE_PIXELS (STRAND_TILE * STRAND_TILE)
// The kernel looks for closed blocks after each CHECK_EVERY strands.
#define CHECK_EVERY 128

// The list is emptied when it has more than LIST_FULL fragments. find_rows() appends at most LIST_MORE fragments between two tests.
#define LIST_FULL 1024
#define LIST_MORE (LANES * STRAND_TILE + LANES)

// Fragments that wait for blending: the pixel's number in the tile with the number of the segment in the upper 16 bits, the
// coverage of the pixel, and s (docs/strands.md).
typedef struct {
  int used;
  int place[LIST_FULL + LIST_MORE] ALIGNED;
  int coverage[LIST_FULL + LIST_MORE] ALIGNED, s[LIST_FULL + LIST_MORE] ALIGNED;     // bits of floats
} Fragments;

typedef struct {
  float pixel[4 * TILE_PIXELS] ALIGNED;             // red, green, blue and transmittance of each pixel
#if STRAND_SKIN
  float skin[TILE_PIXELS] ALIGNED;                  // view depth of the skin at each pixel
#endif
  int width, height;                                // size of the part of the tile that lies within the picture
  Closed closed;
  uchar open[TILE_BLOCKS * TILE_BLOCKS];            // a pixel of each block that was not opaque when it was last tested
} Tile;

// The value of a column of the vertices at the start of the segments of a strand, and its change to their end.
typedef struct { real at, step; } Change;

INLINE Change changes_of(const Vertices *vertices, int column, int strand) {
  const float *first = vertices->column[column] + strand * VERTICES;
  Change c;
  c.at = fill_real(first);
  c.step = fill_real(first + 1) - c.at;
  return c;
}
INLINE real value_at(Change c, whole segment, real s) { return fma(s, eights(c.step, segment), eights(c.at, segment)); }

// `volatile` makes the compiler load the transmittance as a number of its own: loading and broadcasting it is one instruction.
INLINE void blend(float *pixel, float4 fragment) {
  float transmittance = ((volatile float *)pixel)[3];
  vstore4(blended(vload4(0, pixel), transmittance, fragment), 0, pixel);
}

// Blends the fragments `begin` to `end` - 1 of the list, which belong to one strand.
INLINE void blend_strand(const Vertices *vertices, int strand, const Fragments *f, int begin, int end, Tile *tile) {
  Change alpha = changes_of(vertices, ALPHA, strand), red = changes_of(vertices, RED, strand);
  Change green = changes_of(vertices, GREEN, strand), blue = changes_of(vertices, BLUE, strand);
#if STRAND_SKIN
  Change depth = changes_of(vertices, DEPTH, strand);
#endif
  for (int i = begin; i < end; i += LANES) {
    whole segment = fill_whole(f->place + i) >> 16;
    real s = bits_as_real(fill_whole(f->s + i)), coverage = bits_as_real(fill_whole(f->coverage + i));
    // The lanes behind the last fragment belong to other strands or were never written, so s may be no number there. The coverage
    // 0 makes their fragments change nothing.
    truth own = lane_numbers() + i < WHOLE(end);
    coverage = own ? coverage : REAL(0.0f);
    s = own ? s : REAL(0.0f);
    real through = coverage * value_at(alpha, segment, s);
#if STRAND_SKIN
    float skin[LANES] ALIGNED;
    UNROLL for (int k = 0; k < LANES; ++k) skin[k] = tile->skin[f->place[i + k] & 0xffff];
    through = through * before_skin(value_at(depth, segment, s), fill_real(skin));
#endif
#if STRAND_MAP
    real minus_depth = value_at(red, segment, s);
    real4 v = {coverage > REAL(0.0f) ? -minus_depth : REAL(NO_DEPTH), through * minus_depth, -through, through};
#else
    real4 v = {through * value_at(red, segment, s), through * value_at(green, segment, s), through * value_at(blue, segment, s), through};
#endif
    float fragment[4 * LANES] ALIGNED;
    spill_rows(v, fragment);
    UNROLL for (int k = 0; k < LANES; ++k) blend(tile->pixel + 4 * (f->place[i + k] & 0xffff), vload4(k, fragment));
  }
}

// Returns true if a strand turns by more than 90 degrees. first: the lane that has the strand's first segment.
INLINE bool is_sharp(const Segments *g, int first) { return (g->sharp >> first & 0xff) != 0; }

// Searches LANES rows of a strand, from row `base` on and before row `end`, and appends their fragments to the list. The rows
// of a strand are numbered segment by segment, beginning at the root. first: the lane that has the strand's first segment.
// radius: half of the strip's width at the vertices.
INLINE void find_rows(const Segments *g, int first, Change radius, int base, int end, Fragments *f) {
#define OF(name) permuted(g->name, segment)
  whole row = lane_numbers() + base, segment = WHOLE(first);
  UNROLL for (int k = 1; k < VERTICES - 1; ++k) segment = segment - (row >= WHOLE(g->start[first + k]));
  real major = OF(first_row) + to_real(row);
  real minor = greater(-floor_real(-fma(major, OF(slope), OF(run))), REAL(0.0f));
  minor = row < WHOLE(end) ? minor : REAL((float)STRAND_TILE);
  real e_major = OF(e_major), e_minor = OF(e_minor), along_row = fma(major, e_major, OF(along)), across_row = fma(-major, e_minor, OF(across));
  real a_row = major * OF(a_major), a_minor = OF(a_minor), a_offset = OF(a_offset);
  real b_row = major * OF(b_major), b_minor = OF(b_minor), b_offset = OF(b_offset);
  real per_length = OF(per_length), stride_major = OF(stride_major), stride_minor = (STRAND_TILE + 1.0f) - stride_major;
  real radius_a = eights(radius.at, segment), radius_step = eights(radius.step, segment);
  whole place = to_whole(fma(minor, stride_minor, major * stride_major)) | ((segment - first) << 16), stride = to_whole(stride_minor);
  bool sharp = is_sharp(g, first);
  int used = f->used;
  for (int pixels = g->pixels[first]; pixels > 0; --pixels) {
    // The two segments of a vertex have the same line there with the same operations, so no pixel belongs to both. The products
    // are rounded before they are added: then the sum does not depend on which axis is the major one.
    real from_line_a = (a_row + minor * a_minor) + a_offset, from_line_b = (b_row + minor * b_minor) + b_offset;
    real across = fma(minor, e_major, across_row), part = fma(minor, e_minor, along_row) * per_length;
    real s = lesser(greater(part, REAL(0.0f)), REAL(1.0f)), wide = fma(s, radius_step, radius_a);
    real coverage = lesser(across + wide, REAL(0.5f)) - greater(across - wide, REAL(-0.5f));
    // The pixel is inside if from_line_b is negative and the following numbers are not.
    whole outside = bits_as_whole(from_line_a) | bits_as_whole(coverage) | bits_as_whole((STRAND_TILE - 0.5f) - minor);
    if (sharp) {
      real reach = OF(reach);
      outside = outside | bits_as_whole(part + reach) | bits_as_whole((1.0f + reach) - part);
    }
    Chosen inside = chosen((bits_as_whole(from_line_b) & ~outside) < WHOLE(0));
    put_chosen(place, inside, f->place + used);
    put_chosen(bits_as_whole(coverage), inside, f->coverage + used);
    put_chosen(bits_as_whole(s), inside, f->s + used);
    used += chosen_lanes(inside);
    minor = minor + 1.0f;
    place = place + stride;
  }
  f->used = used;
#undef OF
}

// Empties the list: blends its fragments. Those of the strands 0 to `count` - 1 end at end[0], end[1], ...
INLINE void blend_all(const Vertices *vertices, const int *end, int count, Fragments *f, Tile *tile) {
  spill_whole(WHOLE(0), f->place + f->used);     // blend_strand() reads these places
  for (int strand = 0; strand < count; ++strand) blend_strand(vertices, strand, f, strand > 0 ? end[strand - 1] : 0, end[strand], tile);
  f->used = 0;
}

// Draws the strands 0 to `count` - 1 of `vertices`.
INLINE void draw_block(const DrawParams *p, const Vertices *vertices, int count, Fragments *f, Tile *tile) {
  int end[LANES];
  for (int strand = 0; strand < count; strand += TOGETHER) {
    Segments g;
    segments_of(p, vertices, strand, &tile->closed, &g);
    UNROLL for (int other = 0; other < TOGETHER; ++other) {
      int here = strand + other, first = other * VERTICES;
      if (here >= count) break;
      Change radius = changes_of(vertices, RADIUS, here);
      // A strand that turns back may cover a pixel with several segments. find_rows() keeps the order of the fragments of a
      // pixel only if they belong to different calls, so each call then finds the fragments of one segment.
      for (int k = is_sharp(&g, first) ? 0 : VERTICES - 2; k < VERTICES - 1; ++k) {
        int stop = g.start[first + k + 1];
        for (int base = is_sharp(&g, first) ? g.start[first + k] : 0; base < stop; base += LANES) {
          find_rows(&g, first, radius, base, stop, f);
          end[here] = f->used;
          if (f->used > LIST_FULL) {
            blend_all(vertices, end, here + 1, f, tile);
            for (int i = 0; i <= here; ++i) end[i] = 0;
          }
        }
      }
      end[here] = f->used;
    }
  }
  blend_all(vertices, end, count, f, tile);
}

// Loads the next LANES elements of a list of strands, or of their blocks. The arrays have LANES elements more than the lists.
INLINE whole load_list(TABLE(int) list) { return load_whole(list, 0); }
INLINE whole load_spots(TABLE(ushort) spot) {
#if LANES == 16
  return convert_int16(vload16(0, spot));
#else
  return convert_int8(vload8(0, spot));
#endif
}

#define ALL_BLOCKS ((1u << TILE_BLOCKS) - 1)     // all blocks of a row

// Returns true if a strand may touch a block that is not closed. spot: left, top, right and bottom block, 4 bits each (bins.cl).
INLINE truth is_open(const Tile *tile, whole spot) {
  return some_open(&tile->closed, spot & 15, (spot >> 4) & 15, (spot >> 8) & 15, (spot >> 12) & 15);
}

// Returns true if all blocks are closed.
INLINE bool is_finished(const Tile *tile) {
  uint all = ALL_BLOCKS;
  for (int y = 0; y < TILE_BLOCKS; ++y) all &= (uint)tile->closed.row[y];
  return all == ALL_BLOCKS;
}

// Returns the first pixel of row y of a block.
INLINE const float *row_of_block(const Tile *tile, int block, int y) {
  return tile->pixel + 4 * ((block / TILE_BLOCKS * BLOCK_SIDE + y) * STRAND_TILE + block % TILE_BLOCKS * BLOCK_SIDE);
}

INLINE void close(Tile *tile, int block) {
  tile->closed.row[block / TILE_BLOCKS] |= 1 << block % TILE_BLOCKS;
  tile->closed.any = 1;
}

// A part of a block: the pixels within the picture.
typedef struct { int width, height; } Extent;

INLINE Extent extent_of(const Tile *tile, int block) {
  Extent e = {clamp(tile->width - block % TILE_BLOCKS * BLOCK_SIDE, 0, BLOCK_SIDE),
              clamp(tile->height - block / TILE_BLOCKS * BLOCK_SIDE, 0, BLOCK_SIDE)};
  return e;
}

// Returns the number of a pixel of a block that is within the picture and not opaque, or -1. Pixels are counted row by row.
static int open_pixel(const Tile *tile, int block) {
  Extent e = extent_of(tile, block);
  for (int y = 0; y < e.height; ++y)
    for (int x = 0; x < e.width; ++x)
      if (!IS_OPAQUE(row_of_block(tile, block, y)[4 * x + 3])) return y * BLOCK_SIDE + x;
  return -1;
}

// Closes the blocks in which all pixels are opaque. The pixels of a tile do not fit into the processor's first cache, so the
// pixel that was open at the last time is tested first.
static void find_closed(Tile *tile) {
  for (int y = 0; y < TILE_BLOCKS; ++y)
    for (int x = 0; x < TILE_BLOCKS; ++x) {
      int block = y * TILE_BLOCKS + x, last = tile->open[block];
      if (tile->closed.row[y] >> x & 1) continue;
      if (!IS_OPAQUE(row_of_block(tile, block, last / BLOCK_SIDE)[4 * (last % BLOCK_SIDE) + 3])) continue;
      int open = open_pixel(tile, block);
      if (open < 0) close(tile, block);
      else tile->open[block] = (uchar)open;
    }
}

// Begins a tile. All pixels are clear: they have the colour 0 and the transmittance 1.
static void begin(Tile *tile, int width, int height) {
  tile->width = width;
  tile->height = height;
  for (int y = 0; y < 16; ++y) tile->closed.row[y] = 0;
  tile->closed.any = 0;
  for (int block = 0; block < TILE_BLOCKS * TILE_BLOCKS; ++block) {
    Extent e = extent_of(tile, block);
    if (e.width == 0 || e.height == 0) close(tile, block);
    tile->open[block] = 0;
  }
}

// Draws the strands of a tile. list, spot: the tile's list of strands, and their blocks; count: its length.
static void draw_strands(const DrawParams *p, TABLE(float) rows, TABLE(int) film, TABLE(float) map, TABLE(int) list, TABLE(ushort) spot, int count, float origin_x,
                         float origin_y, Tile *tile, Fragments *f) {
  Vertices vertices;
  // The numbers of strands that wait, the first `taken` of the array.
  int strand[2 * LANES] ALIGNED, taken = 0, next = 0, until_check = 0;
  while (true) {
    while (taken < LANES && next < count) {
      whole number = load_list(list + next);
      truth open = lane_numbers() < WHOLE(count - next);
      if (tile->closed.any != 0) open = open && is_open(tile, load_spots(spot + next));
      if (next + LANES <= count) read_soon(rows, ROW_FLOATS * number);
      taken += squeeze(number, open, strand + taken);
      next += LANES;
    }
    if (taken == 0) break;
    for (int i = taken; i < LANES; ++i) strand[i] = strand[0];
    put_vertices(p, film, map, load_row(rows, fill_whole(strand)), origin_x, origin_y, &vertices);
    draw_block(p, &vertices, min(taken, LANES), f, tile);
    spill_whole(fill_whole(strand + LANES), strand);
    taken = max(taken - LANES, 0);
    if (++until_check == CHECK_EVERY / LANES) {
      find_closed(tile);
      if (is_finished(tile)) break;
      until_check = 0;
    }
  }
}

// Stores a colour that no kernel of this frame reads. A non-temporal store does not first read the memory into the cache.
#if BUILTIN(__builtin_nontemporal_store)
#define STORE(value, place) __builtin_nontemporal_store(value, place)
#else
#define STORE(value, place) (*(place) = (value))
#endif

#if STRAND_SKIN
// Copies the depths of the skin. skin: the pixels of the picture.
static void load_skin(const DrawParams *p, TABLE(float4) skin, int first_x, int first_y, Tile *tile) {
  for (int y = 0; y < tile->height; ++y)
    for (int x = 0; x < tile->width; ++x) tile->skin[y * STRAND_TILE + x] = skin[(size_t)(first_y + y) * p->width + first_x + x].w;
}

// Returns true if some pixel of a block has skin.
static bool has_skin(const Tile *tile, int block) {
  Extent e = extent_of(tile, block);
  const float *first = tile->skin + (block / TILE_BLOCKS * STRAND_TILE + block % TILE_BLOCKS) * BLOCK_SIDE;
  for (int y = 0; y < e.height; ++y)
    for (int x = 0; x < e.width; ++x)
      if (first[y * STRAND_TILE + x] < NO_DEPTH) return true;
  return false;
}
#endif

// Returns true if all pixels of a block are clear.
static bool is_clear(const Tile *tile, int block) {
  const float16 clear = (float16)(EMPTY_X, 0.0f, 0.0f, 1.0f, EMPTY_X, 0.0f, 0.0f, 1.0f, EMPTY_X, 0.0f, 0.0f, 1.0f, EMPTY_X, 0.0f, 0.0f, 1.0f);
  for (int y = 0; y < BLOCK_SIDE; ++y) {
    const float *row = row_of_block(tile, block, y);
    int16 difference = (int16)(0);
    for (int x = 0; x < BLOCK_SIDE; x += 4) difference |= *(const float16 *)(row + 4 * x) != clear;
    int8 eight = difference.lo | difference.hi;
    int4 four = eight.lo | eight.hi;
    if ((four.x | four.y | four.z | four.w) != 0) return false;
  }
  return true;
}

// Writes a block to the picture, and clears its pixels. image, skin: the first pixel of the tile.
static void write_block(const DrawParams *p, Tile *tile, int block, TABLE(float4) skin, __global float4 *image) {
  Extent e = extent_of(tile, block);
  int left = block % TILE_BLOCKS * BLOCK_SIDE, top = block / TILE_BLOCKS * BLOCK_SIDE;
  for (int y = 0; y < BLOCK_SIDE; ++y) {
    float *row = tile->pixel + 4 * ((top + y) * STRAND_TILE + left);
    size_t first = (size_t)(top + y) * p->width + left;
    __global float4 *out = image + first;
    if (y < e.height)
      for (int x = 0; x < e.width; ++x) {
#if STRAND_SKIN
        float4 c = stored_over_skin(p, vload4(x, row), skin[first + x]);
#else
        float4 c = stored(p, vload4(x, row));
#endif
        STORE(c, out + x);
      }
    for (int x = 0; x < BLOCK_SIDE; ++x) vstore4(EMPTY, x, row);
  }
}

// Each work-item takes one tile after the other, so that tiles with many strands are distributed over the work-items.
// taken: number of the next tile that no work-item has taken, initially 0. blank: one word for each row of blocks of each tile.
// Bit x is set if block x of the row has the colour of the background in the picture everywhere; the kernel does not write such
// a block again if it has no fragments. skin: see skin_colours (skin.cl); kernels with STRAND_SKIN 0 do not read it.
__kernel void strand_tiles(DrawParams p, TABLE(float) rows, TABLE(int) film, TABLE(float) map, TABLE(int) list_start, TABLE(int) list,
                           TABLE(ushort) spot, TABLE(float4) skin, __global float4 *image, __global int *taken, __global ushort *blank) {
  Tile tile;
  Fragments fragments;
  fragments.used = 0;
  bool cleared = false;
  for (int number = atomic_inc(taken); number < p.tiles_x * p.tiles_y; number = atomic_inc(taken)) {
    int first_x = number % p.tiles_x * STRAND_TILE, first_y = number / p.tiles_x * STRAND_TILE;
    int first = list_start[number], count = list_start[number + 1] - first;
    __global ushort *row = blank + number * TILE_BLOCKS;
    uint all_blank = ALL_BLOCKS;
    for (int y = 0; y < TILE_BLOCKS; ++y) all_blank &= row[y];
    if (!STRAND_SKIN && count == 0 && all_blank == ALL_BLOCKS) continue;
    if (!cleared)
      for (int i = 0; i < TILE_PIXELS; ++i) vstore4(EMPTY, i, tile.pixel);
    cleared = true;
    begin(&tile, min(STRAND_TILE, p.width - first_x), min(STRAND_TILE, p.height - first_y));
#if STRAND_SKIN
    load_skin(&p, skin, first_x, first_y, &tile);
#endif
    draw_strands(&p, rows, film, map, list + first, spot + first, count, (float)first_x + 0.5f - 0.5f * (float)p.width,
                 (float)first_y + 0.5f - 0.5f * (float)p.height, &tile, &fragments);
    for (int y = 0; y < TILE_BLOCKS; ++y) {
      uint was_blank = row[y], is_blank = 0;
      for (int x = 0; x < TILE_BLOCKS; ++x) {
        int block = y * TILE_BLOCKS + x;
        bool clear = is_clear(&tile, block);
#if STRAND_SKIN
        clear = clear && !has_skin(&tile, block);
#endif
        size_t first_pixel = (size_t)first_y * p.width + first_x;
        if (!clear || !(was_blank >> x & 1)) write_block(&p, &tile, block, skin + first_pixel, image + first_pixel);
        is_blank |= (uint)clear << x;
      }
      row[y] = (ushort)is_blank;
    }
  }
}
