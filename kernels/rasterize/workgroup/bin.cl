// Bins of the workgroup mapping: which triangles may touch which tile of TILE_W x TILE_H pixels, per batch of layers
// and in the mesh's order. Each triangle counts its tiles, a prefix sum says where its entries go, it writes them as pairs
// of list and triangle, and a stable sort (common/radix_sort.cl) brings the lists together. 5 or 5 million triangles: nothing is
// sized in advance.
#include "rasterize/geometry/boxes.clh"

typedef struct { int left, top, right, bottom; } Span;

// The tiles that triangle t may touch in group g; right < left when it covers no pixel centre there.
static Span tiles_of(const RasterParams *s, TABLE(float) corners, TABLE(float) box, int g, int t) {
  Box b = box_of(s, load_rows(corners, t), box, g);
  Span tiles = {b.left / TILE_W, b.top / TILE_H, b.live ? b.right / TILE_W : -1, b.live ? b.bottom / TILE_H : -1};
  return tiles;
}

// count: [g triangles + t].
__kernel void group_count(RasterParams s, TABLE(float) corners, TABLE(float) box, __global int *count) {
  int i = (int)get_global_id(0);
  if (i >= s.layer_batches * s.triangles) return;
  Span tiles = tiles_of(&s, corners, box, i / s.triangles, i % s.triangles);
  count[i] = max(tiles.right - tiles.left + 1, 0) * max(tiles.bottom - tiles.top + 1, 0);
}

// start: the counts' prefix sum. key: the list, g tiles + tile. triangle: in whose list.
__kernel void group_emit(RasterParams s, TABLE(float) corners, TABLE(float) box, TABLE(int) start, __global int *key,
                         __global int *triangle) {
  int i = (int)get_global_id(0);
  if (i >= s.layer_batches * s.triangles) return;
  int g = i / s.triangles, t = i % s.triangles, at = start[i];
  Span tiles = tiles_of(&s, corners, box, g, t);
  for (int y = tiles.top; y <= tiles.bottom; ++y)
    for (int x = tiles.left; x <= tiles.right; ++x, ++at) {
      key[at] = (g * s.tiles_y + y) * s.tiles_x + x;
      triangle[at] = t;
    }
}

// Where each list begins among `count` sorted keys; the last entry is the end.
__kernel void group_starts(RasterParams s, int count, TABLE(int) key, __global int *list_start) {
  int i = (int)get_global_id(0);
  if (i > count) return;
  int lists = s.layer_batches * s.tiles_x * s.tiles_y;
  int from = i == 0 ? 0 : key[i - 1] + 1, to = i == count ? lists : key[i];
  for (int list = from; list <= to; ++list) list_start[list] = i;
}
