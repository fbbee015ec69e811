// Strand motion: one work-item advances LANES strands through all substeps of a frame. With LENGTH_MAP, the array of the
// strands' constants has one more column: the length of each strand. With CONTACT, it has three further columns, the roots,
// and colliders push the strands.
// The host defines these for scenes with fur.length_map and with colliders.
#ifndef LENGTH_MAP
#define LENGTH_MAP 0
#endif
#if CONTACT
#include "common/contact.clh"
#endif
#include "simulate/equations.clh"

static inline real3 load_column3(TABLE(float) table, int first, int stride, int block) {
  return vec3(load_real(table + (size_t)first * stride, block), load_real(table + (size_t)(first + 1) * stride, block),
              load_real(table + (size_t)(first + 2) * stride, block));
}

static inline void store_column3(real3 v, __global float *table, int first, int stride, int block) {
  store_real(v.x, table + (size_t)first * stride, block);
  store_real(v.y, table + (size_t)(first + 1) * stride, block);
  store_real(v.z, table + (size_t)(first + 2) * stride, block);
}

// gusts: for each substep, the sine and the cosine of 2 pi f t. t is the substep's start time, and f is the
// frequency of the gusts.
// contact: the colliders at the end of each substep. field: the distances from the mesh among them.
__kernel void strand_frame(SimulateParams s, TABLE(float) gusts, TABLE(float) strands, __global float *state
#if CONTACT
                           , TABLE(float) contact, TABLE(float) field
#endif
) {
  int block = (int)get_global_id(0);
  if (block * LANES >= s.stride) return;
  real3 normal = load_column3(strands, NORMAL_X, s.stride, block);
  real3 anchor = load_column3(strands, ANCHOR_X, s.stride, block);
  real phase_cos = load_real(strands + (size_t)PHASE_COS * s.stride, block);
  real phase_sin = load_real(strands + (size_t)PHASE_SIN * s.stride, block);
  Strand a;
  a.tip = load_column3(state, TIP_X, s.stride, block);
  a.speed = load_column3(state, SPEED_X, s.stride, block);
#if LENGTH_MAP
  real length = load_real(strands + (size_t)VIRTUAL_STRAND_COLUMNS * s.stride, block), length_square = length * length;
#else
  real length = REAL(s.length), length_square = REAL(s.length * s.length);
#endif
#if CONTACT
  real3 root = load_column3(strands, VIRTUAL_STRAND_COLUMNS + (LENGTH_MAP ? 1 : 0), s.stride, block);
#endif
  for (int i = 0; i < s.substeps; ++i) {
    real3 f = forces(s, a, anchor, phase_cos, phase_sin, gusts[2 * i], gusts[2 * i + 1]);
    a = accelerated(s, a, f);
#if CONTACT
    Pushed p = {a.tip, a.speed};
    p = pushed_out(colliders_at(contact, field, i), p, root, normal);
    a.tip = p.place;
    a.speed = p.speed;
#endif
    a = constrained_within(a, normal, length, length_square);
  }
  store_column3(a.tip, state, TIP_X, s.stride, block);
  store_column3(a.speed, state, SPEED_X, s.stride, block);
}
