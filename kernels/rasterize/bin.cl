// Which triangles may touch which tile, with the base (list 0) and with any layer (list 1), in the mesh's order and without
// a bound on their number: count per chunk of triangles, sum, fill. A list is [list_start[l tiles + tile], list_start[l tiles
// + tile + 1]).
#include "rasterize/boxes.clh"

// Tiles that a block of LANES triangles may touch with list l; right < left when they cover no pixel centre.
typedef struct { int left[LANES], top[LANES], right[LANES], bottom[LANES]; } Touched;

static inline bool touched(const RasterParams *s, TABLE(float) corners, TABLE(int) box, int l, int block, Touched *out) {
  Box b = box_of(s, load_rows(corners, block), box, l == 0 ? 0 : s->groups);
  spill_whole(b.left / TILE_W, out->left);
  spill_whole(b.top / TILE_H, out->top);
  spill_whole(b.live ? b.right / TILE_W : WHOLE(-1), out->right);
  spill_whole(b.bottom / TILE_H, out->bottom);
  return some(b.live);
}

// corners: per triangle a row of three vertex numbers and its reach, padded by empty ones to a multiple of 16.
// count: [(l chunks + chunk) tiles + tile].
__kernel void bin_count(RasterParams s, TABLE(float) corners, TABLE(int) box, __global int *count) {
  int chunk = (int)get_global_id(0), l = (int)get_global_id(1);
  if (chunk >= s.chunks || l >= LISTS) return;
  int tiles = s.tiles_x * s.tiles_y;
  __global int *mine = count + ((size_t)l * s.chunks + chunk) * tiles;
  for (int t = 0; t < tiles; ++t) mine[t] = 0;
  Touched t;
  for (int first = chunk * s.chunk; first < min((chunk + 1) * s.chunk, s.triangles); first += LANES) {
    if (!touched(&s, corners, box, l, first / LANES, &t)) continue;
    for (int k = 0; k < LANES; ++k)
      if (t.left[k] <= t.right[k])
        for (int y = t.top[k]; y <= t.bottom[k]; ++y)
          for (int x = t.left[k]; x <= t.right[k]; ++x) ++mine[y * s.tiles_x + x];
  }
}

// Each list's length, and where each chunk's part of it begins.
__kernel void bin_sum(RasterParams s, __global int *count, __global int *length) {
  int tile = (int)get_global_id(0), l = (int)get_global_id(1);
  int tiles = s.tiles_x * s.tiles_y;
  if (tile >= tiles || l >= LISTS) return;
  int sum = 0;
  for (int chunk = 0; chunk < s.chunks; ++chunk) {
    __global int *c = count + ((size_t)l * s.chunks + chunk) * tiles + tile;
    int n = *c;
    *c = sum;
    sum += n;
  }
  length[l * tiles + tile] = sum;
}

// One work-item: where each list begins; the last entry is the total, 2^31 - 1 where it would be more. No tile is drawn yet.
__kernel void bin_start(RasterParams s, TABLE(int) length, __global int *list_start, __global int *next_tile) {
  if (get_global_id(0) != 0) return;
  *next_tile = 0;
  int lists = LISTS * s.tiles_x * s.tiles_y, sum = 0;
  for (int i = 0; i < lists; ++i) {
    list_start[i] = sum;
    sum = add_sat(sum, length[i]);
  }
  list_start[lists] = sum;
}

__kernel void bin_fill(RasterParams s, TABLE(float) corners, TABLE(int) box, __global int *count, TABLE(int) list_start,
                       __global int *list) {
  int chunk = (int)get_global_id(0), l = (int)get_global_id(1);
  if (chunk >= s.chunks || l >= LISTS) return;
  int tiles = s.tiles_x * s.tiles_y;
  __global int *mine = count + ((size_t)l * s.chunks + chunk) * tiles;
  TABLE(int) start = list_start + l * tiles;
  Touched t;
  for (int first = chunk * s.chunk; first < min((chunk + 1) * s.chunk, s.triangles); first += LANES) {
    if (!touched(&s, corners, box, l, first / LANES, &t)) continue;
    for (int k = 0; k < LANES; ++k)
      if (t.left[k] <= t.right[k])
        for (int y = t.top[k]; y <= t.bottom[k]; ++y)
          for (int x = t.left[k]; x <= t.right[k]; ++x) {
            int tile = y * s.tiles_x + x;
            list[start[tile] + mine[tile]++] = first + k;
          }
  }
}
