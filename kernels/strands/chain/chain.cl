// Simulates strands: a work-item computes all substeps of some units of LANES strands.
#include "common/slices.clh"
#include "strands/chain/body.clh"
#include "strands/chain/step.clh"

// If COLLECTS is 1, the kernel first computes all strands of a unit as if there were no stops. It collects the strands that
// touch a stop, and computes sixteen of them again with the stops. Without this, one such strand in a unit would make the
// whole unit compute the stops. The results are the same. With one lane, each strand branches separately.
#define COLLECTS (LANES > 1)

// The tables of the strands, in slices of 16 strands. params.h lists their columns.
typedef struct {
  TABLE(scalar) strands;
  __global scalar *states;
#if CHAIN_BODY
  __global scalar *body;
#endif
#if CHAIN_SKIN
  TABLE(scalar) from;        // the skin at the start of the frame
  TABLE(scalar) to;          // the skin at the end of the frame
#endif
} Tables;

// Room for one slice per work-item in each of the tables.
typedef struct {
  __global scalar *strands, *states;
#if CHAIN_BODY
  __global scalar *body;
#endif
#if CHAIN_SKIN
  __global scalar *from, *to;
#endif
} Room;

INLINE Chain load_chain(Tables t, int u) {
  Chain c;
  c.u = load3(t.states, u, CHAIN_COLUMNS, CHAIN_FIRST);
  c.w = load3(t.states, u, CHAIN_COLUMNS, CHAIN_SECOND);
  c.a = load3(t.states, u, CHAIN_COLUMNS, CHAIN_FIRST_RATE);
  c.b = load3(t.states, u, CHAIN_COLUMNS, CHAIN_SECOND_RATE);
  UNROLL for (int i = 0; i < PLANE_STOPS; ++i) c.stop[i] = load_real(t.states, column_of(u, CHAIN_COLUMNS, CHAIN_STOP + i));
#if CHAIN_BODY
  UNROLL for (int i = 0; i < 2; ++i) c.stop[PLANE_STOPS + i] = load_real(t.body, column_of(u, BODY_COLUMNS, BODY_STOP + i));
#endif
  return c;
}

INLINE void store_motion(Chain c, Tables t, int u) {
  store3(c.u, t.states, u, CHAIN_COLUMNS, CHAIN_FIRST);
  store3(c.w, t.states, u, CHAIN_COLUMNS, CHAIN_SECOND);
  store3(c.a, t.states, u, CHAIN_COLUMNS, CHAIN_FIRST_RATE);
  store3(c.b, t.states, u, CHAIN_COLUMNS, CHAIN_SECOND_RATE);
}

INLINE void store_chain(Chain c, Tables t, int u) {
  store_motion(c, t, u);
  UNROLL for (int i = 0; i < PLANE_STOPS; ++i) store_real(c.stop[i], t.states, column_of(u, CHAIN_COLUMNS, CHAIN_STOP + i));
#if CHAIN_BODY
  UNROLL for (int i = 0; i < 2; ++i) store_real(c.stop[PLANE_STOPS + i], t.body, column_of(u, BODY_COLUMNS, BODY_STOP + i));
#endif
}

// The constants of a unit's strands, in the object's frame.
typedef struct {
  real3 root, rest, normal;
  real shortness, drag, phase_cos, phase_sin;    // drag: shortness times the strand's factor of the drag
  Hold hold;  // without the members that change from step to step
} Strand;

INLINE real strand_value(TABLE(scalar) strands, int u, int column) {
  return load_real(strands, column_of(u, STRAND_COLUMNS, column));
}

INLINE Strand load_strand(ChainParams p, TABLE(scalar) strands, int u) {
  Strand s;
  s.root = load3(strands, u, STRAND_COLUMNS, STRAND_ROOT);
  s.rest = load3(strands, u, STRAND_COLUMNS, STRAND_REST);
  s.normal = load3(strands, u, STRAND_COLUMNS, STRAND_NORMAL);
  s.shortness = strand_value(strands, u, STRAND_SHORTNESS);
  s.phase_cos = strand_value(strands, u, STRAND_PHASE_COS);
  s.phase_sin = strand_value(strands, u, STRAND_PHASE_SIN);
  s.hold.stiff_first = strand_value(strands, u, STRAND_STIFF_FIRST);
  s.hold.stiff_second = strand_value(strands, u, STRAND_STIFF_SECOND);
  s.hold.limit_first = strand_value(strands, u, STRAND_LIMIT_FIRST);
  s.hold.limit_second = strand_value(strands, u, STRAND_LIMIT_SECOND);
#if CHAIN_DAMPING
  real drag = strand_value(strands, u, STRAND_DRAG), damping = strand_value(strands, u, STRAND_DAMPING);
  s.drag = s.shortness * drag;
  s.hold.damping_first = fma(drag, REAL(p.drag_first), damping * REAL(p.joint_damping));
  s.hold.damping_second = fma(drag, REAL(p.drag_second), damping * REAL(p.tip_damping));
  s.hold.damping_both = fma(drag, REAL(p.drag_both), -(damping * REAL(p.tip_damping)));
#else
  s.drag = s.shortness;
#endif
  s.hold = with_theta(p, s.hold);
  return s;
}

#if CHAIN_SKIN
// Returns three columns of the skin at the given fraction of the time between the frames.
INLINE real3 skin_at(Tables t, int u, int first, scalar fraction) {
  real3 from = load3(t.from, u, STRAND_COLUMNS, first);
  return along3(from, REAL(fraction), sub3(load3(t.to, u, STRAND_COLUMNS, first), from));
}
#endif

// Sets the direction at rest and the normal at the end of substep i, and returns the external forces.
INLINE Pull pull_at(ChainParams p, ChainMoment m, Tables t, int u, int i, Strand *s) {
#if CHAIN_SKIN
  scalar fraction = p.skin_from + (scalar)(i + 1) * p.skin_step;
  s->hold.rest = normalize3(skin_at(t, u, STRAND_REST, fraction));
  s->hold.normal = normalize3(skin_at(t, u, STRAND_NORMAL, fraction));
  real3 air = sub3(air_at(m, s->phase_cos, s->phase_sin), skin_at(t, u, SKIN_VELOCITY, fraction));
  real3 fall = sub3(uniform3(m.fall_x, m.fall_y, m.fall_z), skin_at(t, u, SKIN_ACCELERATION, fraction));
  return pull_of(p, air, fall, s->shortness, s->drag);
#else
  s->hold.rest = in_world(m, s->rest);
  s->hold.normal = in_world(m, s->normal);
  return pull_on(p, m, s->root, s->shortness, s->drag, s->phase_cos, s->phase_sin);
#endif
}

// Computes all substeps of the strands of unit u. For `defer` and `deferred` see stepped(). field: the field of the body.
INLINE Chain last_chain(ChainParams p, TABLE(ChainMoment) moments, Tables tables, TABLE(scalar) field, int u, Chain c,
                        const int defer, truth *deferred) {
  Strand s = load_strand(p, tables.strands, u);
#if CHAIN_BODY
  real allowed[2] = {load_real(tables.body, column_of(u, BODY_COLUMNS, BODY_JOINT_ALLOWED)),
                     load_real(tables.body, column_of(u, BODY_COLUMNS, BODY_TIP_ALLOWED))};
  real3 start[2];
  if (defer) {
    ChainMoment t = moments[p.first_moment];
    s.hold = with_body(p, t, field, s.root, s.shortness, allowed, s.hold, c);
    UNROLL for (int k = 0; k < 2; ++k) {
      start[k] = in_object(t, end_of(p, c, k));
      s.hold.body_clear[k] = s.hold.body_gap[k];
    }
  }
#endif
  for (int i = 0; i < p.substeps; ++i) {
    ChainMoment t = moments[p.first_moment + i];
    Pull g = pull_at(p, t, tables, u, i, &s);
#if CHAIN_BODY
    if (defer) {
      UNROLL for (int k = 0; k < 2; ++k) s.hold.body_from[k] = in_world(t, start[k]);
    } else {
      s.hold = with_escape(p, with_body(p, t, field, s.root, s.shortness, allowed, s.hold, c));
    }
#endif
    c = stepped(p, s.hold, g, c, defer, deferred);
  }
  return c;
}

#if COLLECTS
// Copies sixteen strands of any slices to the slice `to`, or `count` strands back from this slice. `strand` contains the
// numbers of `count` strands, 1 to 16. Unused places of the slice hold the first strand.
INLINE size_t place_of(int strand, int columns) { return (size_t)(strand / 16 * columns * 16 + strand % 16); }
INLINE void copy_in(TABLE(scalar) table, const int columns, __global scalar *to, const int *strand, int count) {
  for (int k = 0; k < 16; ++k) {
    TABLE(scalar) from = table + place_of(strand[k < count ? k : 0], columns);
    UNROLL for (int c = 0; c < columns; ++c) to[c * 16 + k] = from[c * 16];
  }
}
INLINE void copy_out(TABLE(scalar) from, const int columns, __global scalar *table, const int *strand, int count) {
  for (int k = 0; k < count; ++k) {
    __global scalar *to = table + place_of(strand[k], columns);
    UNROLL for (int c = 0; c < columns; ++c) to[c * 16] = from[c * 16 + k];
  }
}

// Computes all substeps of `count` strands, 1 to 16, of any slices. `strand` contains their numbers. item: slice of `room`
// that the function overwrites.
INLINE void chain_batch(ChainParams p, TABLE(ChainMoment) moments, Tables t, TABLE(scalar) field, Room room, int item,
                        const int *strand, int count) {
  Tables some;
  copy_in(t.strands, STRAND_COLUMNS, room.strands += place_of(16 * item, STRAND_COLUMNS), strand, count);
  copy_in(t.states, CHAIN_COLUMNS, room.states += place_of(16 * item, CHAIN_COLUMNS), strand, count);
  some.strands = room.strands, some.states = room.states;
#if CHAIN_BODY
  copy_in(t.body, BODY_COLUMNS, room.body += place_of(16 * item, BODY_COLUMNS), strand, count);
  some.body = room.body;
#endif
#if CHAIN_SKIN
  copy_in(t.from, STRAND_COLUMNS, room.from += place_of(16 * item, STRAND_COLUMNS), strand, count);
  copy_in(t.to, STRAND_COLUMNS, room.to += place_of(16 * item, STRAND_COLUMNS), strand, count);
  some.from = room.from, some.to = room.to;
#endif
  truth none;
  for (int u = 0; u < UNITS; ++u)
    store_chain(last_chain(p, moments, some, field, u, load_chain(some, u), 0, &none), some, u);
  copy_out(some.states, CHAIN_COLUMNS, t.states, strand, count);
#if CHAIN_BODY
  copy_out(some.body, BODY_COLUMNS, t.body, strand, count);
#endif
}
#endif

// Computes all substeps of the strands of work-item `item`.
CALLED void chains_of(ChainParams p, TABLE(ChainMoment) moments, Tables t, TABLE(scalar) field, Room room, int item) {
  int first = item * p.units_per_item, last = first + p.units_per_item;
  int units = p.slices * UNITS;
  last = last < units ? last : units;
#if COLLECTS
  int touching[48], waiting = 0;
  for (int u = first; u < last || waiting > 0; ++u) {
    if (u < last) {
      Chain old = load_chain(t, u);
      truth deferred = held(old);
      Chain c = last_chain(p, moments, t, field, u, old, 1, &deferred);
      if (some(deferred)) {
        c.u = choose3(deferred, old.u, c.u), c.w = choose3(deferred, old.w, c.w);
        c.a = choose3(deferred, old.a, c.a), c.b = choose3(deferred, old.b, c.b);
        waiting += squeeze(lane_numbers() + u * LANES, deferred, touching + waiting);
      }
      store_motion(c, t, u);  // the impulses of strands that are not deferred are 0 before and after the launch
    }
    if (waiting >= 16 || (u >= last && waiting > 0)) {  // the only call, because compilers copy the function to each call
      int count = waiting < 16 ? waiting : 16;
      waiting -= count;
      chain_batch(p, moments, t, field, room, item, touching + waiting, count);
    }
  }
#else
  truth none;
  for (int u = first; u < last; ++u) store_chain(last_chain(p, moments, t, field, u, load_chain(t, u), 0, &none), t, u);
#endif
}

// The arguments whose names begin with some_ are the tables of Room, which the kernel overwrites.
__kernel void chain_frame(ChainParams p, TABLE(ChainMoment) moments, TABLE(scalar) strands, __global scalar *states,
                          __global scalar *some_strands, __global scalar *some_states
#if CHAIN_BODY
                          , TABLE(scalar) field, __global scalar *body, __global scalar *some_body
#endif
#if CHAIN_SKIN
                          , TABLE(scalar) from, TABLE(scalar) to, __global scalar *some_from, __global scalar *some_to
#endif
) {
  Tables t;
  Room room;
  t.strands = strands, t.states = states, room.strands = some_strands, room.states = some_states;
#if CHAIN_BODY
  t.body = body, room.body = some_body;
#else
  TABLE(scalar) field = 0;
#endif
#if CHAIN_SKIN
  t.from = from, t.to = to, room.from = some_from, room.to = some_to;
#endif
  chains_of(p, moments, t, field, room, (int)get_global_id(0));
}
