// Simulates shared prisms (triangular prisms whose neighbours share their sticks) by explicit schemes. The force on a
// top mass depends on the states of neighbouring top masses, which other work-items compute. Work-items of different
// work-groups cannot wait for each other within a launch, so each evaluation of the forces needs a separate launch. A
// small model takes one launch of one work-item for all substeps (prism_*_whole), because many launches would take
// longer than the computation. The state of a top mass is its offset q from the stick's base and its velocity v. The
// computation of neighbouring top masses reads v and the position (base + q), so v and the position are stored in rows
// of four floats.
#include "springs/springs.clh"

#define TOPS(u)                                                                                                \
  Site site = load_site(p, sites, push, u, 1);                                                                 \
  Top a;                                                                                                       \
  a.q = load3(offset, u, 3, 0);                                                                                \
  a.v = xyz(load_rows(speed, u));                                                                              \
  real3 f = top_force(p, moments[at], u, site, a, xyz(load_rows(tip, u)), start, neighbour, rest, tip, speed);

// Computes one step of Euler's method. If in_turn is 1, the method is semi-implicit: it updates the positions
// with the new velocities. If in_turn is 0, the method is explicit. at: the index of the step's start in
// `moments` (wind, weight and object motion at successive times). number: the number of the step since the
// start of the simulation.
CALLED void euler_units(TopologyParams p, int begin, int end, int in_turn, int at, int number, TABLE(Moment) moments,
                        TABLE(scalar) sites, TABLE(scalar) push, TABLE(int) start, TABLE(int) neighbour,
                        TABLE(scalar) rest, TABLE(scalar) tip, TABLE(scalar) speed, __global scalar *offset,
                        __global scalar *next_tip, __global scalar *next_speed, __global int *diverged_at,
                        __global int *first) {
  for (int u = begin; u < end; ++u) {
    TOPS(u)
    Top b;
    if (in_turn) b = advanced_in_turn(p, a, p.step, f);
    else b = advanced(p, a, p.step, a.v, f);
    store3(b.q, offset, u, 3, 0);
    store_rows(row_of(b.v), next_speed, u);
    store_rows(row_of(add3(site.root, b.q)), next_tip, u);
    note_step(p, b, u, number, diverged_at, first);
  }
}
__kernel void prism_euler(TopologyParams p, int in_turn, int at, int number, TABLE(Moment) moments,
                          TABLE(scalar) sites, TABLE(scalar) push, TABLE(int) start, TABLE(int) neighbour,
                          TABLE(scalar) rest, TABLE(scalar) tip, TABLE(scalar) speed, __global scalar *offset,
                          __global scalar *next_tip, __global scalar *next_speed, __global int *diverged_at,
                          __global int *first) {
  int item = (int)get_global_id(0);
  euler_units(p, first_unit(p, item), last_unit(p, item), in_turn, at, number, moments, sites, push, start, neighbour, rest,
              tip, speed, offset, next_tip, next_speed, diverged_at, first);
}

// Computes all substeps. After an odd number of substeps the resulting state is in other_tip and other_speed.
__kernel void prism_euler_whole(TopologyParams p, int in_turn, TABLE(Moment) moments, TABLE(scalar) sites,
                                TABLE(scalar) push, TABLE(int) start, TABLE(int) neighbour, TABLE(scalar) rest,
                                __global scalar *tip, __global scalar *speed, __global scalar *offset,
                                __global scalar *other_tip, __global scalar *other_speed, __global int *diverged_at,
                                __global int *first) {
  if (get_global_id(0) != 0) return;
  for (int i = 0; i < p.substeps; ++i) {
    int back = i % 2;
    euler_units(p, 0, p.blocks * UNITS, in_turn, p.first_moment + 2 * i, p.first_step + i, moments, sites, push, start,
                neighbour, rest, back ? other_tip : tip, back ? other_speed : speed, offset, back ? tip : other_tip,
                back ? speed : other_speed, diverged_at, first);
  }
}

// Computes a stage of a scheme (stage_of()). tip, speed, offset: state of this stage. base_*: state at the start of the
// step; after the last stage, state at the end of the step. sum_*: the state at the start of the step, plus the weighted
// derivatives of the stages computed so far. next_*: state of the next stage. at: as in euler_units().
CALLED void stage_units(TopologyParams p, int begin, int end, int stages, int stage, int at, int number, TABLE(Moment) moments,
                      TABLE(scalar) sites, TABLE(scalar) push, TABLE(int) start, TABLE(int) neighbour,
                      TABLE(scalar) rest, TABLE(scalar) tip, TABLE(scalar) speed, TABLE(scalar) offset,
                      __global scalar *base_offset, __global scalar *base_speed, __global scalar *sum_offset,
                      __global scalar *sum_speed, __global scalar *next_tip, __global scalar *next_speed,
                      __global scalar *next_offset, __global int *diverged_at, __global int *first) {
  Stage s = stage_of(stages, stage, p.step);
  bool last = stage == stages - 1;
  for (int u = begin; u < end; ++u) {
    TOPS(u)
    Top base, sum;
    base.q = load3(base_offset, u, 3, 0);
    base.v = xyz(load_rows(base_speed, u));
    sum = base;
    if (stage > 0) {
      sum.q = load3(sum_offset, u, 3, 0);
      sum.v = load3(sum_speed, u, 3, 0);
    }
    Top next = advanced(p, s.corrects ? sum : base, s.reach, a.v, f);
    sum = advanced(p, sum, s.weight, a.v, f);
    if (last) next = sum;
    store_rows(row_of(add3(site.root, next.q)), next_tip, u);
    if (!last) {
      store3(sum.q, sum_offset, u, 3, 0);
      store3(sum.v, sum_speed, u, 3, 0);
      store3(next.q, next_offset, u, 3, 0);
      store_rows(row_of(next.v), next_speed, u);
    } else {
      store3(next.q, base_offset, u, 3, 0);
      store_rows(row_of(next.v), base_speed, u);
      note_step(p, next, u, number, diverged_at, first);
    }
  }
}
__kernel void prism_stage(TopologyParams p, int stages, int stage, int at, int number, TABLE(Moment) moments,
                        TABLE(scalar) sites, TABLE(scalar) push, TABLE(int) start, TABLE(int) neighbour,
                        TABLE(scalar) rest, TABLE(scalar) tip, TABLE(scalar) speed, TABLE(scalar) offset,
                        __global scalar *base_offset, __global scalar *base_speed, __global scalar *sum_offset,
                        __global scalar *sum_speed, __global scalar *next_tip, __global scalar *next_speed,
                        __global scalar *next_offset, __global int *diverged_at, __global int *first) {
  int item = (int)get_global_id(0);
  stage_units(p, first_unit(p, item), last_unit(p, item), stages, stage, at, number, moments, sites, push, start, neighbour, rest, tip,
            speed, offset, base_offset, base_speed, sum_offset, sum_speed, next_tip, next_speed, next_offset, diverged_at,
            first);
}

// Computes all substeps. The state of stages 1 and 3 is in other_tip and other_speed, that of stage 2 in spare_tip and
// spare_speed. At the start and at the end of a substep, the state is in tip and speed.
__kernel void prism_stages_whole(TopologyParams p, int stages, TABLE(Moment) moments, TABLE(scalar) sites, TABLE(scalar) push,
                              TABLE(int) start, TABLE(int) neighbour, TABLE(scalar) rest, __global scalar *tip,
                              __global scalar *speed, __global scalar *offset, __global scalar *other_tip,
                              __global scalar *other_speed, __global scalar *spare_tip, __global scalar *spare_speed,
                              __global scalar *stage_offset, __global scalar *sum_offset, __global scalar *sum_speed,
                              __global int *diverged_at, __global int *first) {
  if (get_global_id(0) != 0) return;
  for (int i = 0; i < p.substeps; ++i)
    for (int stage = 0; stage < stages; ++stage) {
      int next = (stage + 1) % stages;
      stage_units(p, 0, p.blocks * UNITS, stages, stage, p.first_moment + 2 * i + stage_of(stages, stage, p.step).moment,
                p.first_step + i, moments, sites, push, start, neighbour, rest, stage == 0 ? tip : stage == 2 ? spare_tip : other_tip,
                stage == 0 ? speed : stage == 2 ? spare_speed : other_speed, stage == 0 ? offset : stage_offset, offset,
                speed, sum_offset, sum_speed, next == 0 ? tip : next == 2 ? spare_tip : other_tip,
                next == 0 ? speed : next == 2 ? spare_speed : other_speed, stage_offset, diverged_at, first);
    }
}
