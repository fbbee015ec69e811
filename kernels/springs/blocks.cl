// Simulates sticks, separable sticks and separable prisms: a work-item computes all substeps of one or more units. A
// unit is LANES blocks, and a block is one to three sticks (block.clh).
#include "springs/block.clh"
#include "springs/places.clh"

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

INLINE Tops load_tops(__global const scalar *offset, __global const scalar *speed, int u) {
  Tops a;
  UNROLL for (int c = 0; c < CORNERS; ++c) {
    a.top[c].q = load3(offset, place_of(u, CORNERS, c), 3, 0);
    a.top[c].v = load3(speed, place_of(u, CORNERS, c), 3, 0);
  }
  return a;
}

// Defines the kernel of an integration scheme. `stepped` is an expression for one step of the scheme. `moment` holds
// wind, weight and object motion at successive times: entry 2 i is for the start of substep i, and entry 2 i + 1 is for
// its middle. `offset` and `speed` hold the positions q and the velocities v of the top masses. Every substep tests
// whether a mass diverged. If a mass diverged, the block is computed again to find the substep in which the mass
// diverged. A separate function computes the block again, so that the usual computation needs no additional registers.
#define FRAME(name, stepped)                                                                                          \
  static __attribute__((noinline)) void name##_lost(TopologyParams p, TABLE(Moment) moments, TABLE(scalar) sites,     \
                                                    TABLE(scalar) push, TABLE(scalar) sides,                          \
                                                    __global scalar *offset, __global scalar *speed,                  \
                                                    __global int *diverged_at, __global int *first, int u) {          \
    Block block = load_block(p, sites, push, sides, u);                                                               \
    Tops a = load_tops(offset, speed, u);                                                                             \
    TABLE(Moment) moment = moments + p.first_moment;                                                                  \
    for (int i = 0; i < p.substeps; ++i) {                                                                            \
      a = stepped;                                                                                                    \
      UNROLL for (int c = 0; c < CORNERS; ++c)                                                                        \
        note_diverged(diverged(p, a.top[c]) ? WHOLE(p.first_step + i) : WHOLE(NEVER), place_of(u, CORNERS, c),        \
                      diverged_at, first);                                                                            \
    }                                                                                                                 \
  }                                                                                                                   \
  CALLED void name##_units(TopologyParams p, TABLE(Moment) moments, TABLE(scalar) sites, TABLE(scalar) push,          \
                           TABLE(scalar) sides, __global scalar *offset, __global scalar *speed,                      \
                           __global int *diverged_at, __global int *first, int item) {                                \
    TABLE(Moment) moment = moments + p.first_moment;                                                                  \
    for (int u = first_unit(p, item); u < last_unit(p, item); ++u) {                                                  \
      Block block = load_block(p, sites, push, sides, u);                                                             \
      Tops a = load_tops(offset, speed, u);                                                                           \
      truth lost = WHOLE(0) != WHOLE(0);                                                                              \
      for (int i = 0; i < p.substeps; ++i) {                                                                          \
        a = stepped;                                                                                                  \
        UNROLL for (int c = 0; c < CORNERS; ++c) lost = lost | diverged(p, a.top[c]);                                 \
      }                                                                                                               \
      if (some(lost)) name##_lost(p, moments, sites, push, sides, offset, speed, diverged_at, first, u);              \
      UNROLL for (int c = 0; c < CORNERS; ++c) {                                                                      \
        store3(a.top[c].q, offset, place_of(u, CORNERS, c), 3, 0);                                                    \
        store3(a.top[c].v, speed, place_of(u, CORNERS, c), 3, 0);                                                     \
      }                                                                                                               \
    }                                                                                                                 \
  }                                                                                                                   \
  __kernel void name(TopologyParams p, TABLE(Moment) moments, TABLE(scalar) sites, TABLE(scalar) push,                \
                     TABLE(scalar) sides, __global scalar *offset, __global scalar *speed,                            \
                     __global int *diverged_at, __global int *first) {                                                \
    name##_units(p, moments, sites, push, sides, offset, speed, diverged_at, first, (int)get_global_id(0));           \
  }

FRAME(explicit_euler_frame, explicit_euler(p, moment[2 * i], block, a))
FRAME(semi_implicit_euler_frame, semi_implicit_euler(p, moment[2 * i], block, a))
FRAME(rk4_frame, multistage(p, 4, moment + 2 * i, block, a))
#if !EDGES
FRAME(wind_vectors_frame, wind_vectors(p, moment[2 * i], block, a))
#endif
FRAME(predictor_corrector_frame, multistage(p, 3, moment + 2 * i, block, a))
FRAME(backward_euler_frame, backward_euler(p, moment[2 * i + 2], block, a))
