// Prefix sums, and a stable radix sort made of them. n: below 2^31, as all sums; a sum beyond stays at 2^31 - 1.
#include "opencl.clh"

// The host says the same (harness/shells/opencl/group_bins.hpp).
#ifndef SCAN_ITEMS
#define SCAN_ITEMS 64                           // work-items of a block of prefix sums ...
#define SCAN_EACH 16                            // ... and values for each
#define SORT_BITS 4                             // of a key, per pass
#define SORT_RUN 32                             // keys that a work-item moves, in their order
#endif
#define SORT_DIGITS (1 << SORT_BITS)
#define SORT_ITEMS 64

// In each block of SCAN_ITEMS SCAN_EACH values, the sum of those before; total: of the whole block.
__kernel __attribute__((reqd_work_group_size(SCAN_ITEMS, 1, 1)))
void scan_blocks(int n, __global int *value, __global int *total) {
  __local int sum[SCAN_ITEMS];
  int item = (int)get_local_id(0), block = (int)get_group_id(0);
  long first = ((long)block * SCAN_ITEMS + item) * SCAN_EACH;
  int own = 0;
  for (int k = 0; k < SCAN_EACH; ++k) own = add_sat(own, first + k < n ? value[first + k] : 0);
  sum[item] = own;
  for (int step = 1; step < SCAN_ITEMS; step *= 2) {
    barrier(CLK_LOCAL_MEM_FENCE);
    int before = item >= step ? sum[item - step] : 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    sum[item] = add_sat(sum[item], before);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  int before = item > 0 ? sum[item - 1] : 0;
  if (item == SCAN_ITEMS - 1) total[block] = sum[item];
  for (int k = 0; k < SCAN_EACH && first + k < n; ++k) {
    int here = value[first + k];
    value[first + k] = before;
    before = add_sat(before, here);
  }
}

// To each block's values the sum of the blocks before.
__kernel void scan_add(int n, TABLE(int) before, __global int *value) {
  int i = (int)get_global_id(0);
  if (i < n) value[i] = add_sat(value[i], before[i / (SCAN_ITEMS * SCAN_EACH)]);
}

static inline int digit_of(int key, int shift) { return key >> shift & (SORT_DIGITS - 1); }

// How often each digit stands in each run: count[digit runs + run].
__kernel __attribute__((reqd_work_group_size(SORT_ITEMS, 1, 1)))
void sort_count(int n, int shift, TABLE(int) key, __global int *count) {
  __local int mine[SORT_DIGITS][SORT_ITEMS];    // a column per work-item
  int item = (int)get_local_id(0), run = (int)get_global_id(0), runs = (n + SORT_RUN - 1) / SORT_RUN;
  if (run >= runs) return;
  for (int d = 0; d < SORT_DIGITS; ++d) mine[d][item] = 0;
  int last = min((run + 1) * SORT_RUN, n);
  for (int i = run * SORT_RUN; i < last; ++i) ++mine[digit_of(key[i], shift)][item];
  for (int d = 0; d < SORT_DIGITS; ++d) count[(size_t)d * runs + run] = mine[d][item];
}

// start: the counts' prefix sum.
__kernel __attribute__((reqd_work_group_size(SORT_ITEMS, 1, 1)))
void sort_move(int n, int shift, TABLE(int) start, TABLE(int) key, TABLE(int) value, __global int *key_out,
               __global int *value_out) {
  __local int next[SORT_DIGITS][SORT_ITEMS];
  int item = (int)get_local_id(0), run = (int)get_global_id(0), runs = (n + SORT_RUN - 1) / SORT_RUN;
  if (run >= runs) return;
  for (int d = 0; d < SORT_DIGITS; ++d) next[d][item] = start[(size_t)d * runs + run];
  int last = min((run + 1) * SORT_RUN, n);
  for (int i = run * SORT_RUN; i < last; ++i) {
    int to = next[digit_of(key[i], shift)][item]++;
    key_out[to] = key[i];
    value_out[to] = value[i];
  }
}
