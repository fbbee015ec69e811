// Simulates strands: a work-item computes all substeps of some units of LANES strands.
#include "common/slices.clh"
#include "strands/chain/step.clh"

INLINE Chain load_chain(TABLE(scalar) states, int u) {
  Chain c;
  c.u = load3(states, u, CHAIN_COLUMNS, CHAIN_FIRST);
  c.w = load3(states, u, CHAIN_COLUMNS, CHAIN_SECOND);
  c.a = load3(states, u, CHAIN_COLUMNS, CHAIN_FIRST_RATE);
  c.b = load3(states, u, CHAIN_COLUMNS, CHAIN_SECOND_RATE);
  UNROLL for (int i = 0; i < STOPS; ++i) c.stop[i] = load_real(states, column_of(u, CHAIN_COLUMNS, CHAIN_STOP + i));
  return c;
}

INLINE void store_chain(Chain c, __global scalar *states, int u) {
  store3(c.u, states, u, CHAIN_COLUMNS, CHAIN_FIRST);
  store3(c.w, states, u, CHAIN_COLUMNS, CHAIN_SECOND);
  store3(c.a, states, u, CHAIN_COLUMNS, CHAIN_FIRST_RATE);
  store3(c.b, states, u, CHAIN_COLUMNS, CHAIN_SECOND_RATE);
  UNROLL for (int i = 0; i < STOPS; ++i) store_real(c.stop[i], states, column_of(u, CHAIN_COLUMNS, CHAIN_STOP + i));
}

INLINE real strand_value(TABLE(scalar) strands, int u, int column) {
  return load_real(strands, column_of(u, STRAND_COLUMNS, column));
}

__kernel void chain_frame(ChainParams p, TABLE(ChainMoment) moments, TABLE(scalar) strands, __global scalar *states) {
  int first = (int)get_global_id(0) * p.units_per_item, last = first + p.units_per_item;
  int units = p.slices * UNITS;
  for (int u = first; u < (last < units ? last : units); ++u) {
    real3 rest = load3(strands, u, STRAND_COLUMNS, STRAND_REST);
    real3 normal = load3(strands, u, STRAND_COLUMNS, STRAND_NORMAL);
    Hold s;
    s.stiff_first = strand_value(strands, u, STRAND_STIFF_FIRST);
    s.stiff_second = strand_value(strands, u, STRAND_STIFF_SECOND);
    s.limit_first = strand_value(strands, u, STRAND_LIMIT_FIRST);
    s.limit_second = strand_value(strands, u, STRAND_LIMIT_SECOND);
    s = with_theta(p, s);
    Chain c = load_chain(states, u);
    for (int i = 0; i < p.substeps; ++i) {
      ChainMoment t = moments[p.first_moment + i];
      s.rest = in_world(t, rest);
      s.normal = in_world(t, normal);
      Pull g = pull_on(p, t, load3(strands, u, STRAND_COLUMNS, STRAND_ROOT), strand_value(strands, u, STRAND_SHORTNESS),
                       strand_value(strands, u, STRAND_PHASE_COS), strand_value(strands, u, STRAND_PHASE_SIN));
      c = stepped(p, s, g, c);
    }
    store_chain(c, states, u);
  }
}
