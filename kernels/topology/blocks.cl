// Sticks, separable sticks and separable prisms: a work-item takes LANES blocks at a time through all substeps.
#include "topology/block.clh"
#include "topology/rows.clh"

static inline Block load_block(TopologyParams p, TABLE(float) root, TABLE(float) normal, TABLE(float) push,
                               TABLE(float) rest, int u) {
  Block block;
  for (int c = 0; c < CORNERS; ++c) {
    block.site[c] = load_site(p, root, normal, push, rows_of(u, CORNERS, c));
    block.rest[c] = REAL(0.0f);
  }
#if CORNERS == 3
  real4 sides = load_rows(rest, u);
  block.rest[0] = sides.x;
  block.rest[1] = sides.y;
  block.rest[2] = sides.z;
#else
  (void)rest;
#endif
  return block;
}

// moments: at the start of substep i in entry 2 i, in its middle in 2 i + 1. offset, speed: the state, q and v.
#define FRAME(name, stepped)                                                                                  \
  __kernel void name(TopologyParams p, TABLE(Moment) moments, TABLE(float) root, TABLE(float) normal,         \
                     TABLE(float) push, TABLE(float) rest, __global scalar *offset, __global scalar *speed,   \
                     __global int *diverged_at, __global int *first) {                                        \
    int begin = (int)get_global_id(0) * p.blocks_per_item;                                                    \
    int end = begin + p.blocks_per_item < p.blocks * UNITS ? begin + p.blocks_per_item : p.blocks * UNITS;    \
    for (int u = begin; u < end; ++u) {                                                                       \
      Block block = load_block(p, root, normal, push, rest, u);                                               \
      Tops a;                                                                                                 \
      whole lost[CORNERS];                                                                                    \
      for (int c = 0; c < CORNERS; ++c) {                                                                     \
        a.top[c].q = xyz(load_rows(offset, rows_of(u, CORNERS, c)));                                          \
        a.top[c].v = xyz(load_rows(speed, rows_of(u, CORNERS, c)));                                           \
        lost[c] = WHOLE(NEVER);                                                                               \
      }                                                                                                       \
      for (int i = 0; i < p.substeps; ++i) {                                                                  \
        a = stepped;                                                                                          \
        for (int c = 0; c < CORNERS; ++c)                                                                     \
          lost[c] = diverged(p, a.top[c]) && lost[c] == WHOLE(NEVER) ? WHOLE(p.first_step + i) : lost[c];     \
      }                                                                                                       \
      for (int c = 0; c < CORNERS; ++c) {                                                                     \
        int rows = rows_of(u, CORNERS, c);                                                                    \
        store_rows(row_of(a.top[c].q), offset, rows);                                                         \
        store_rows(row_of(a.top[c].v), speed, rows);                                                          \
        note_diverged(lost[c], rows, diverged_at, first);                                                     \
      }                                                                                                       \
    }                                                                                                         \
  }

FRAME(explicit_euler_frame, explicit_euler(p, moments[2 * i], block, a))
FRAME(semi_implicit_euler_frame, semi_implicit_euler(p, moments[2 * i], block, a))
FRAME(rk4_frame, rk4(p, moments[2 * i], moments[2 * i + 1], moments[2 * i + 2], block, a))
FRAME(backward_euler_frame, backward_euler(p, moments[2 * i + 2], block, a))
