// Makes the triangle lists that the kernel in workgroup.cl draws. Layer batch 0 is the base surface, and
// every other layer batch consists of consecutive layers. Each pair of a layer batch and a tile
// (TILE_W x TILE_H pixels) has one list. The list contains the triangles that may touch the tile in this layer batch,
// in the mesh's order. The first kernel counts the tiles that each triangle may touch. A prefix sum of the
// counts gives the positions at which the second kernel writes pairs (list number, triangle number). A stable
// sort (common/radix_sort.cl) groups the pairs by list number. No capacity is fixed in advance, so the number
// of triangles is not limited.
#include "rasterize/geometry/boxes.clh"

typedef struct { int left, top, right, bottom; } Span;

// Returns the tiles that triangle t may touch in layer batch g. In the result, right < left if t covers no pixel centre
// in this batch.
static Span tiles_of(const RasterParams *s, TABLE(float) corners, TABLE(float) box, int g, int t) {
  Box b = box_of(s, load_rows(corners, t), box, g);
  Span tiles = {b.left / TILE_W, b.top / TILE_H, b.live ? b.right / TILE_W : -1, b.live ? b.bottom / TILE_H : -1};
  return tiles;
}

// Counts the tiles that each triangle may touch in each layer batch. The result for triangle t in layer batch g is
// stored in count[g * triangles + t].
__kernel void group_count(RasterParams s, TABLE(float) corners, TABLE(float) box, __global int *count) {
  FOR_EACH(i, s.layer_batches * s.triangles) {
    Span tiles = tiles_of(&s, corners, box, i / s.triangles, i % s.triangles);
    count[i] = max(tiles.right - tiles.left + 1, 0) * max(tiles.bottom - tiles.top + 1, 0);
  }
}

// For each layer batch and each triangle, writes one pair (list number, triangle number) per tile that the triangle may
// touch. The list of layer batch g for the tile in column x and row y has the number (g * tiles_y + y) * tiles_x + x.
//   start     prefix sums of the counts that the kernel group_count has written
//   key       receives the list number of each pair
//   triangle  receives the triangle number of each pair
__kernel void group_emit(RasterParams s, TABLE(float) corners, TABLE(float) box, TABLE(int) start, __global int *key,
                         __global int *triangle) {
  FOR_EACH(i, s.layer_batches * s.triangles) {
    int g = i / s.triangles, t = i % s.triangles, at = start[i];
    Span tiles = tiles_of(&s, corners, box, g, t);
    for (int y = tiles.top; y <= tiles.bottom; ++y)
      for (int x = tiles.left; x <= tiles.right; ++x, ++at) {
        key[at] = (g * s.tiles_y + y) * s.tiles_x + x;
        triangle[at] = t;
      }
  }
}

// Finds the first pair of each list. key: the list numbers of the `count` sorted pairs. list_start receives one entry
// per list, and after them one more entry, which is the end of the last list.
__kernel void group_starts(RasterParams s, int count, TABLE(int) key, __global int *list_start) {
  int lists = s.layer_batches * s.tiles_x * s.tiles_y;
  FOR_EACH(i, count + 1) {
    int from = i == 0 ? 0 : key[i - 1] + 1, to = i == count ? lists : key[i];
    for (int list = from; list <= to; ++list) list_start[list] = i;
  }
}
