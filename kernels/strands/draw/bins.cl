// Makes a list for each tile: the strands that may touch the tile, from front to back. The sorted list of all strands is
// divided into chunks. strand_bin_count counts the strands of each chunk for each tile, strand_bin_sum and
// strand_bin_start add the counts, and strand_bin_fill writes the lists. The list of a tile consists of the elements
// list[list_start[tile]] to list[list_start[tile + 1] - 1]. The array `spot` has the blocks of the tile that each strand of
// the list may touch.
#include "dialect.clh"
#include "strands/draw/params.h"

// The part of the sorted list that a work-item processes.
typedef struct { int first, last; } Chunk;

INLINE Chunk chunk_of(int chunk, int chunks, int total) {
  int length = (total + chunks - 1) / chunks;
  Chunk c = {min(chunk * length, total), min((chunk + 1) * length, total)};
  return c;
}

// The loops over a chunk read the blocks of strands in random order. They prefetch the blocks that follow after this number of
// strands.
#define AHEAD 16
#if BUILTIN(__builtin_prefetch)
#define PREFETCH_BLOCKS(i, last) if ((i) + AHEAD < (last)) __builtin_prefetch((const void *)(size_t)(blocks + pair[(i) + AHEAD].y))
#else
#define PREFETCH_BLOCKS(i, last)
#endif

// The blocks that a strand may touch, and the tiles that contain these blocks.
typedef struct { int left, top, right, bottom; } Touched;

INLINE Touched blocks_touched_by(TABLE(uint2) blocks, TABLE(uint2) pair, int i) {
  uint2 packed = blocks[pair[i].y];
  Touched t = {packed.x & 0xffff, packed.x >> 16, packed.y & 0xffff, packed.y >> 16};
  return t;
}
INLINE Touched tiles_of(Touched blocks) {
  Touched t = {blocks.left / TILE_BLOCKS, blocks.top / TILE_BLOCKS, blocks.right / TILE_BLOCKS, blocks.bottom / TILE_BLOCKS};
  return t;
}

// Returns the part of the blocks `b` that lies in tile (x, y): left, top, right and bottom, 4 bits each, the lowest first,
// counted from the first block of the tile.
INLINE ushort blocks_in_tile(Touched b, int x, int y) {
  int last = TILE_BLOCKS - 1;
  int left = max(b.left - x * TILE_BLOCKS, 0), top = max(b.top - y * TILE_BLOCKS, 0);
  int right = min(b.right - x * TILE_BLOCKS, last), bottom = min(b.bottom - y * TILE_BLOCKS, last);
  return (ushort)(left | top << 4 | right << 8 | bottom << 12);
}

// With BACK_LAST, a chunk ends at the first strand that faces away from the eye.
INLINE bool is_end(DrawParams p, TABLE(uint2) pair, int i) { return p.back_facing == BACK_LAST && pair[i].x == LAST_KEY; }

__kernel void strand_bin_count(DrawParams p, TABLE(int) total, TABLE(uint2) blocks, TABLE(uint2) pair,
                               __global int *count) {
  int chunk = (int)get_global_id(0);
  if (chunk >= p.chunks) return;
  __global int *mine = count + (size_t)chunk * (p.tiles_x * p.tiles_y);
  for (int t = 0; t < p.tiles_x * p.tiles_y; ++t) mine[t] = 0;
  Chunk c = chunk_of(chunk, p.chunks, total[0]);
  for (int i = c.first; i < c.last; ++i) {
    PREFETCH_BLOCKS(i, c.last);
    if (is_end(p, pair, i)) break;
    Touched t = tiles_of(blocks_touched_by(blocks, pair, i));
    for (int y = t.top; y <= t.bottom; ++y)
      for (int x = t.left; x <= t.right; ++x) ++mine[y * p.tiles_x + x];
  }
}

// Computes the length of each tile's list. Replaces the count of each chunk and tile by the sum of the counts of the
// earlier chunks.
__kernel void strand_bin_sum(DrawParams p, __global int *count, __global int *length) {
  int tile = (int)get_global_id(0), all = p.tiles_x * p.tiles_y;
  if (tile >= all) return;
  int sum = 0;
  for (int chunk = 0; chunk < p.chunks; ++chunk) {
    int here = count[(size_t)chunk * all + tile];
    count[(size_t)chunk * all + tile] = sum;
    sum = add_sat(sum, here);
  }
  length[tile] = sum;
}

// Computes the start of each tile's list, in a single work-item. The last element of list_start is the total length of all
// lists, at most 2^31 - 1. Sets the counter of tiles that have been taken to 0.
__kernel void strand_bin_start(DrawParams p, TABLE(int) length, __global int *list_start, __global int *taken) {
  if (get_global_id(0) != 0) return;
  int sum = 0;
  for (int tile = 0; tile < p.tiles_x * p.tiles_y; ++tile) {
    list_start[tile] = sum;
    sum = add_sat(sum, length[tile]);
  }
  list_start[p.tiles_x * p.tiles_y] = sum;
  *taken = 0;
}

__kernel void strand_bin_fill(DrawParams p, TABLE(int) total, TABLE(uint2) blocks, TABLE(uint2) pair,
                              TABLE(int) list_start, __global int *count, __global int *list, __global ushort *spot) {
  int chunk = (int)get_global_id(0);
  if (chunk >= p.chunks) return;
  __global int *mine = count + (size_t)chunk * (p.tiles_x * p.tiles_y);
  Chunk c = chunk_of(chunk, p.chunks, total[0]);
  for (int i = c.first; i < c.last; ++i) {
    PREFETCH_BLOCKS(i, c.last);
    if (is_end(p, pair, i)) break;
    Touched b = blocks_touched_by(blocks, pair, i), t = tiles_of(b);
    int strand = (int)pair[i].y;
    for (int y = t.top; y <= t.bottom; ++y)
      for (int x = t.left; x <= t.right; ++x) {
        int tile = y * p.tiles_x + x, at = list_start[tile] + mine[tile]++;
        list[at] = strand;
        spot[at] = blocks_in_tile(b, x, y);
      }
  }
}
