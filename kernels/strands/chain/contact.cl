// Colliders push the joints and tips of strands after a time step (docs/colliders.md). A work-item computes a unit of LANES
// strands.
#include "common/contact.clh"
#include "common/slices.clh"
#include "strands/chain/params.h"
#include "strands/chain/pushed.clh"

// contact, field: as common/contact.clh describes. time: number of the step in `contact`.
__kernel void chain_contact(ChainParams p, int time, TABLE(scalar) strands, __global scalar *states, TABLE(scalar) contact,
                            TABLE(scalar) field) {
  int u = (int)get_global_id(0);
  if (u >= p.slices * UNITS) return;
  real3 root = load3(strands, u, STRAND_COLUMNS, STRAND_ROOT), normal = load3(strands, u, STRAND_COLUMNS, STRAND_NORMAL);
  real shortness = load_real(strands, column_of(u, STRAND_COLUMNS, STRAND_SHORTNESS));
  Limbs a;
  a.u = load3(states, u, CHAIN_COLUMNS, CHAIN_FIRST);
  a.w = load3(states, u, CHAIN_COLUMNS, CHAIN_SECOND);
  a.a = load3(states, u, CHAIN_COLUMNS, CHAIN_FIRST_RATE);
  a.b = load3(states, u, CHAIN_COLUMNS, CHAIN_SECOND_RATE);
  a = pushed_limbs(colliders_at(contact, field, time), a, root, normal, shortness, p.first, p.second);
  store3(a.u, states, u, CHAIN_COLUMNS, CHAIN_FIRST);
  store3(a.w, states, u, CHAIN_COLUMNS, CHAIN_SECOND);
  store3(a.a, states, u, CHAIN_COLUMNS, CHAIN_FIRST_RATE);
  store3(a.b, states, u, CHAIN_COLUMNS, CHAIN_SECOND_RATE);
}
