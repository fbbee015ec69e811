// A stable radix sort of pairs (key, value) by unsigned keys of 32 bits. Each pass sorts by SORT_BITS bits of the key (a
// digit), in two kernels: pair_count counts how often each digit occurs, and pair_move moves the pairs.
//
// A work-item processes one run of consecutive pairs. In the first pass, the pairs may have gaps: run r has live[r] pairs,
// which begin at index r * capacity. This lets the kernels that produce the pairs write each run separately. After the
// first pass, the pairs have no gaps, and all runs except the last have the same length.
#include "common/unroll.clh"
#include "dialect.clh"

// harness/cl/radix_sort.cpp defines these constants when it builds the kernels.
#ifndef SORT_BITS
#define SORT_BITS 8                             // bits of the key per pass
#define SORT_ITEMS 1                            // work-items per work-group
#endif
#define SORT_DIGITS (1 << SORT_BITS)
// pair_count counts in several tables and adds them, because two additions to the same counter in a row must wait for each
// other. On GPUs, other work-items use this time.
#define SORT_TABLES (SORT_ITEMS == 1 ? 4 : 1)

typedef struct { int first, last; } Run;

INLINE int digit_of(uint key, int shift) { return (int)(key >> shift) & (SORT_DIGITS - 1); }

// Returns the pairs of run r: those with the indices first to last - 1. capacity is 0 if the pairs have no gaps.
INLINE Run run_of(int r, int runs, int capacity, TABLE(int) live, TABLE(int) total) {
  Run run;
  if (capacity > 0) {
    run.first = r * capacity;
    run.last = run.first + live[r];
  } else {
    int length = (total[0] + runs - 1) / runs;
    run.first = min(r * length, total[0]);
    run.last = min(run.first + length, total[0]);
  }
  return run;
}

// Writes the number of all pairs.
__kernel void pair_total(int runs, TABLE(int) live, __global int *total) {
  int sum = 0;
  for (int r = 0; r < runs; ++r) sum += live[r];
  total[0] = sum;
}

// Counts how often each digit occurs in each run. The count of digit d in run r is stored in count[d * runs + r].
__kernel __attribute__((reqd_work_group_size(SORT_ITEMS, 1, 1)))
void pair_count(int runs, int capacity, int shift, TABLE(int) live, TABLE(int) total, TABLE(uint2) pair,
                __global int *count) {
  __local int mine[SORT_TABLES][SORT_DIGITS][SORT_ITEMS];     // one column per work-item
  int item = (int)get_local_id(0), r = (int)get_global_id(0);
  if (r >= runs) return;
  for (int t = 0; t < SORT_TABLES; ++t)
    for (int d = 0; d < SORT_DIGITS; ++d) mine[t][d][item] = 0;
  Run run = run_of(r, runs, capacity, live, total);
  int i = run.first;
  for (; i + SORT_TABLES <= run.last; i += SORT_TABLES)
    UNROLL for (int t = 0; t < SORT_TABLES; ++t) ++mine[t][digit_of(pair[i + t].x, shift)][item];
  for (; i < run.last; ++i) ++mine[0][digit_of(pair[i].x, shift)][item];
  for (int d = 0; d < SORT_DIGITS; ++d) {
    int sum = 0;
    UNROLL for (int t = 0; t < SORT_TABLES; ++t) sum += mine[t][d][item];
    count[(size_t)d * runs + r] = sum;
  }
}

// Writes the pairs without gaps, sorted by the digit that begins at bit `shift` of the key. count: the counts of pair_count
// if `summed` is 0, or their exclusive prefix sums if `summed` is 1.
__kernel __attribute__((reqd_work_group_size(SORT_ITEMS, 1, 1)))
void pair_move(int runs, int capacity, int shift, int summed, TABLE(int) live, TABLE(int) total, TABLE(int) count,
               TABLE(uint2) pair, __global uint2 *out) {
  __local int next[SORT_DIGITS][SORT_ITEMS];
  int item = (int)get_local_id(0), r = (int)get_global_id(0);
  if (r >= runs) return;
  int sum = 0;
  for (int d = 0; d < SORT_DIGITS; ++d) {
    int before = 0, all = 0;
    if (summed) {
      before = count[(size_t)d * runs + r];
    } else {
      for (int other = 0; other < runs; ++other) {
        int here = count[d * runs + other];
        before += other < r ? here : 0;
        all += here;
      }
    }
    next[d][item] = sum + before;
    sum += all;
  }
  Run run = run_of(r, runs, capacity, live, total);
  for (int i = run.first; i < run.last; ++i) {
    uint2 here = pair[i];
    out[next[digit_of(here.x, shift)][item]++] = here;
  }
}
