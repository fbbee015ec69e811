// Writes the records of the key strands (params.h) from the states of simulated chains. A work-item converts LANES chains.
#include "common/slices.clh"
#include "strands/chain/equations.clh"
#include "strands/draw/params.h"

// moment: index in `moments` of the time to which the states belong. units: number of units of LANES chains.
__kernel void chain_keys(int units, int moment, TABLE(ChainMoment) moments, TABLE(scalar) strands, TABLE(scalar) states,
                         __global float *keys) {
  int u = (int)get_global_id(0);
  if (u >= units) return;
  ChainMoment t = moments[moment];
  real3 root = load3(strands, u, STRAND_COLUMNS, STRAND_ROOT), normal = load3(strands, u, STRAND_COLUMNS, STRAND_NORMAL);
  real3 first = in_object(t, load3(states, u, CHAIN_COLUMNS, CHAIN_FIRST));
  real3 second = in_object(t, load3(states, u, CHAIN_COLUMNS, CHAIN_SECOND));
  real3 rest = load3(strands, u, STRAND_COLUMNS, STRAND_REST);
  real4 part[4] = {{root.x, root.y, root.z, normal.x}, {normal.y, normal.z, first.x, first.y}, {first.z, second.x, second.y, second.z},
                   {rest.x, rest.y, rest.z, REAL(0.0f)}};
  for (int i = 0; i < 4; ++i) store_rows_apart(part[i], keys + (size_t)u * (LANES * KEY_RECORD) + 4 * i, KEY_RECORD);
}
