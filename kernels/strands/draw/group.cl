// Draws strands by a method for GPUs: a work-group draws a tile, and a work-item draws a pixel. The strands of a tile are
// processed in batches, from front to back. The work-items first compute the vertices and segments of a batch together.
// Then each work-item blends the fragments of its pixel.
#include "strands/draw/pixel.clh"
#include "strands/draw/row.clh"

#define GROUP_ITEMS (STRAND_TILE * STRAND_TILE)
#define BATCH 32              // strands per batch

// The strands of a batch. x and y are in pixels from the centre of the tile's first pixel. mitre: normal of the line that
// separates two segments at their common vertex. e: direction of a segment; it is 0 if the segment is not drawn.
typedef struct {
  float x[MOST_SEGMENTS + 1][BATCH], y[MOST_SEGMENTS + 1][BATCH], radius[MOST_SEGMENTS + 1][BATCH], alpha[MOST_SEGMENTS + 1][BATCH];
  float red[MOST_SEGMENTS + 1][BATCH], green[MOST_SEGMENTS + 1][BATCH], blue[MOST_SEGMENTS + 1][BATCH];
#if STRAND_SKIN
  float depth[MOST_SEGMENTS + 1][BATCH];
#endif
  float mitre_x[MOST_SEGMENTS + 1][BATCH], mitre_y[MOST_SEGMENTS + 1][BATCH];
  float e_x[MOST_SEGMENTS][BATCH], e_y[MOST_SEGMENTS][BATCH], length[MOST_SEGMENTS][BATCH];
  int finished;               // number of pixels that receive no more fragments
} Batch;

// Computes vertex k of strand s.
INLINE void put_vertex(const DrawParams *p, TABLE(int) film, TABLE(float) map, Row r, int k, int s, float origin_x, float origin_y, __local Batch *b) {
  int segments = segments_of_strip(p, r);
  Part part = visible_part(p, r, segments);
  float t = k < segments ? fma(part.to - part.from, (float)k / (float)segments, part.from) : part.to;
  Vertex v = vertex_at(p, film, map, r, towards_joint(p, r), t);
  b->x[k][s] = v.x - origin_x;
  b->y[k][s] = v.y - origin_y;
  b->radius[k][s] = v.radius;
  b->alpha[k][s] = part.drawn ? v.alpha : 0.0f;
  b->red[k][s] = v.colour.x;
  b->green[k][s] = v.colour.y;
  b->blue[k][s] = v.colour.z;
#if STRAND_SKIN
  b->depth[k][s] = v.depth;
#endif
}

// Computes the direction of segment k of strand s.
INLINE void put_direction(int k, int s, __local Batch *b) {
  float x = b->x[k + 1][s] - b->x[k][s], y = b->y[k + 1][s] - b->y[k][s], length = sqrt(fma(x, x, y * y));
  bool drawn = length >= 1.0f / 1024.0f;
  b->e_x[k][s] = drawn ? x / length : 0.0f;
  b->e_y[k][s] = drawn ? y / length : 0.0f;
  b->length[k][s] = drawn ? length : 0.0f;
}

INLINE void put_mitre(int k, int s, int segments, __local Batch *b) {
  float x = 0.0f, y = 0.0f;
  if (k > 0) { x = b->e_x[k - 1][s]; y = b->e_y[k - 1][s]; }
  if (k < segments) { x += b->e_x[k][s]; y += b->e_y[k][s]; }
  bool fold = k > 0 && fma(x, x, y * y) < 1.0f / 1048576.0f;
  b->mitre_x[k][s] = fold ? -b->e_y[k - 1][s] : x;
  b->mitre_y[k][s] = fold ? b->e_x[k - 1][s] : y;
}

// Blends the fragment of segment k of strand s, if the segment touches the pixel (x, y). skin: view depth of the skin there.
INLINE void draw_segment(const __local Batch *b, int k, int s, float x, float y, float skin, float4 *front) {
  float length = b->length[k][s];
  if (length == 0.0f) return;
  float from_x = x - b->x[k][s], from_y = y - b->y[k][s], to_x = x - b->x[k + 1][s], to_y = y - b->y[k + 1][s];
  float e_x = b->e_x[k][s], e_y = b->e_y[k][s];
  float radius = b->radius[k][s], radius_end = b->radius[k + 1][s], reach = fmax(radius, radius_end) + 0.5f;
  float across = from_x * e_y - from_y * e_x, along = fma(from_x, e_x, from_y * e_y);
  if (fabs(across) >= reach || along < -reach || along > length + reach) return;
  // Both segments of a vertex compute the same bits here, so no pixel belongs to both.
  if (from_x * b->mitre_x[k][s] + from_y * b->mitre_y[k][s] < 0.0f) return;
  if (to_x * b->mitre_x[k + 1][s] + to_y * b->mitre_y[k + 1][s] >= 0.0f) return;
  float t = clamp(along / length, 0.0f, 1.0f), wide = fma(t, radius_end - radius, radius);
  float coverage = fmin(across + wide, 0.5f) - fmax(across - wide, -0.5f);
  if (coverage <= 0.0f) return;
#define VALUE(name) fma(t, b->name[k + 1][s] - b->name[k][s], b->name[k][s])
#if STRAND_MAP
  float depth = VALUE(red), alpha = coverage * VALUE(alpha);
  *front = blended(*front, front->w, (float4)(depth, alpha * depth, alpha, -alpha));
#else
  float alpha = coverage * VALUE(alpha);
#if STRAND_SKIN
  alpha = alpha * before_skin(VALUE(depth), skin);
#endif
  float through = front->w * alpha;
  *front = fma((float4)(through), (float4)(VALUE(red), VALUE(green), VALUE(blue), -1.0f), *front);
#endif
#undef VALUE
}

__kernel __attribute__((reqd_work_group_size(GROUP_ITEMS, 1, 1)))
void strand_group(DrawParams p, TABLE(float) rows, TABLE(int) film, TABLE(float) map, TABLE(int) list_start, TABLE(int) list, TABLE(ushort) spot,
                  TABLE(float4) skin, __global float4 *image, __global int *taken, __global ushort *blank) {
  __local Batch batch;
  int item = (int)get_local_id(0), tile = (int)get_group_id(0);
  int first_x = tile % p.tiles_x * STRAND_TILE, first_y = tile / p.tiles_x * STRAND_TILE;
  int x = item % STRAND_TILE, y = item / STRAND_TILE;
  float origin_x = (float)first_x + 0.5f - 0.5f * (float)p.width, origin_y = (float)first_y + 0.5f - 0.5f * (float)p.height;
  bool inside = first_x + x < p.width && first_y + y < p.height, finished = false;
  float4 front = EMPTY;
  size_t pixel = (size_t)(first_y + y) * p.width + first_x + x;
  float depth = NO_DEPTH;
#if STRAND_SKIN
  if (inside) depth = skin[pixel].w;
#endif
  int begin = list_start[tile], end = list_start[tile + 1];
  if (item == 0) batch.finished = 0;
  for (int first = begin; first < end; first += BATCH) {
    int count = min(BATCH, end - first);
    barrier(CLK_LOCAL_MEM_FENCE);             // waits until the previous batch has been drawn
    if (batch.finished == GROUP_ITEMS) break;
    for (int i = item; i < count * (p.segments + 1); i += GROUP_ITEMS)
      put_vertex(&p, film, map, load_row(rows, list[first + i % count]), i / count, i % count, origin_x, origin_y, &batch);
    barrier(CLK_LOCAL_MEM_FENCE);
    for (int i = item; i < count * p.segments; i += GROUP_ITEMS) put_direction(i / count, i % count, &batch);
    barrier(CLK_LOCAL_MEM_FENCE);
    for (int i = item; i < count * (p.segments + 1); i += GROUP_ITEMS) put_mitre(i / count, i % count, p.segments, &batch);
    barrier(CLK_LOCAL_MEM_FENCE);
    if (finished) continue;
    for (int s = 0; s < count; ++s)
      for (int k = 0; k < p.segments; ++k) draw_segment(&batch, k, s, (float)x, (float)y, depth, &front);
    if (!inside || IS_OPAQUE(front.w)) {
      finished = true;
      atomic_inc(&batch.finished);
    }
  }
  if (!inside) return;
#if STRAND_SKIN
  image[pixel] = stored_over_skin(&p, front, skin[pixel]);
#else
  image[pixel] = stored(&p, front);
#endif
}
