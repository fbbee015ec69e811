// A stable radix sort of pairs (key, value). Each pass sorts by SORT_BITS bits of the key (a digit): it counts how
// often each digit occurs, computes prefix sums, and moves the pairs.
#include "common/prefix_sum.clh"

// harness/cl/radix_sort.cpp defines SORT_BITS and SORT_RUN, with the values below, when it builds the kernels.
#ifndef SORT_BITS
#define SORT_BITS 4                             // bits of the key per pass
#define SORT_RUN 32                             // number of consecutive keys (a run) that one work-item processes
#endif
#define SORT_DIGITS (1 << SORT_BITS)
#define SORT_ITEMS 64

static inline int digit_of(int key, int shift) { return key >> shift & (SORT_DIGITS - 1); }

// Counts how often each digit occurs in each run of SORT_RUN keys. The count of digit d in run r is stored in count[d *
// runs + r].
__kernel __attribute__((reqd_work_group_size(SORT_ITEMS, 1, 1)))
void sort_count(int n, int shift, TABLE(int) key, __global int *count) {
  __local int mine[SORT_DIGITS][SORT_ITEMS];    // one column per work-item
  int item = (int)get_local_id(0), run = (int)get_global_id(0), runs = (n + SORT_RUN - 1) / SORT_RUN;
  if (run >= runs) return;
  for (int d = 0; d < SORT_DIGITS; ++d) mine[d][item] = 0;
  int last = min((run + 1) * SORT_RUN, n);
  for (int i = run * SORT_RUN; i < last; ++i) ++mine[digit_of(key[i], shift)][item];
  for (int d = 0; d < SORT_DIGITS; ++d) count[(size_t)d * runs + run] = mine[d][item];
}

// Writes the pairs (key, value) sorted by the digit that begins at bit `shift` of the key. start: exclusive prefix sums
// of the counts of sort_count().
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
