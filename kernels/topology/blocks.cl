// Sticks, separable sticks and separable prisms: a work-item takes LANES blocks at a time through all substeps.
#include "topology/block.clh"
#include "topology/places.clh"

static inline Block load_block(TopologyParams p, TABLE(scalar) sites, TABLE(scalar) push, TABLE(scalar) sides, int u) {
  Block block;
  UNROLL for (int c = 0; c < CORNERS; ++c) {
    block.site[c] = load_site(p, sites, push, place_of(u, CORNERS, c), EDGES);
    block.rest[c] = REAL(0.0f);
#if EDGES
    block.rest[c] = load_real(sides, column_of(u, 3, c));
#else
    (void)sides;
#endif
  }
  return block;
}

// moments: at the start of substep i in entry 2 i, in its middle in 2 i + 1. offset, speed: the state, q and v.
#define FRAME(name, stepped)                                                                                   \
  __kernel void name(TopologyParams p, TABLE(Moment) moments, TABLE(scalar) sites, TABLE(scalar) push,         \
                     TABLE(scalar) sides, __global scalar *offset, __global scalar *speed,                     \
                     __global int *diverged_at, __global int *first) {                                         \
    int item = (int)get_global_id(0);                                                                          \
    for (int u = first_unit(p, item); u < last_unit(p, item); ++u) {                                           \
      Block block = load_block(p, sites, push, sides, u);                                                      \
      Tops a;                                                                                                  \
      whole lost[CORNERS];                                                                                     \
      UNROLL for (int c = 0; c < CORNERS; ++c) {                                                               \
        a.top[c].q = load3(offset, place_of(u, CORNERS, c), 3, 0);                                             \
        a.top[c].v = load3(speed, place_of(u, CORNERS, c), 3, 0);                                              \
        lost[c] = WHOLE(NEVER);                                                                                \
      }                                                                                                        \
      for (int i = 0; i < p.substeps; ++i) {                                                                   \
        a = stepped;                                                                                           \
        UNROLL for (int c = 0; c < CORNERS; ++c)                                                               \
          lost[c] = diverged(p, a.top[c]) && lost[c] == WHOLE(NEVER) ? WHOLE(p.first_step + i) : lost[c];      \
      }                                                                                                        \
      UNROLL for (int c = 0; c < CORNERS; ++c) {                                                               \
        int place = place_of(u, CORNERS, c);                                                                   \
        store3(a.top[c].q, offset, place, 3, 0);                                                               \
        store3(a.top[c].v, speed, place, 3, 0);                                                                \
        note_diverged(lost[c], place, diverged_at, first);                                                     \
      }                                                                                                        \
    }                                                                                                          \
  }

FRAME(explicit_euler_frame, explicit_euler(p, moments[2 * i], block, a))
FRAME(semi_implicit_euler_frame, semi_implicit_euler(p, moments[2 * i], block, a))
FRAME(rk4_frame, rk4(p, moments[2 * i], moments[2 * i + 1], moments[2 * i + 2], block, a))
FRAME(backward_euler_frame, backward_euler(p, moments[2 * i + 2], block, a))
