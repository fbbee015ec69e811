// Simulates shared prisms (triangular prisms whose neighbours share their sticks) by backward Euler. A time
// step solves one system of linear equations A x = b for the top masses of all sticks, where x is the change
// of their velocities. The system is solved by the method of conjugate gradients. The preconditioner is the
// inverse of A's diagonal 3 x 3 matrix blocks (block-Jacobi). r = b - A x is the residual, z is the product
// of the preconditioner and r, and d is the search direction. The iteration starts from the x of the previous
// step. A work-item computes a chunk of top masses. The chunks do not depend on the work-group size, and each
// work-item that needs a sum adds the sums of the chunks in the same order. The rounding of a sum therefore
// does not depend on the work-group size. On a large model, each function *_chunk() below runs in a separate
// launch. On a small model, one work-item runs all these functions in a single launch (gradients_whole),
// because many launches would take longer than the computation.
#include "springs/implicit.clh"
#include "springs/springs.clh"

// DOUBLE_SUMS is 1 if the device supports doubles. The sums over the chunks then have double precision.
#ifndef DOUBLE_SUMS
#define DOUBLE_SUMS 0
#endif
#if DOUBLE_SUMS
#ifndef __cplusplus
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
typedef double total;
#else
typedef float total;
#endif

// The type of a chunk's sums, with one partial sum per lane. After the chunk's last stick, total_of() adds the sums of
// all lanes.
#if LANES == 16 && DOUBLE_SUMS
typedef double16 totals;
#define to_totals convert_double16
#elif LANES == 16
typedef float16 totals;
#define to_totals(v) (v)
#else
typedef total totals;
#define to_totals(v) ((total)(v))
#endif

static inline total total_of(totals v) {
#if LANES == 16
  total lanes[16];
  vstore16(v, 0, lanes);
  total sum = 0;
  for (int k = 0; k < 16; ++k) sum += lanes[k];
  return sum;
#else
  return v;
#endif
}

// Adds the sums of all chunks. Eight partial sums are computed independently, and then added in order. With
// only one partial sum, each addition would wait for the previous one. A work-item would then wait for
// `chunks` additions instead of chunks / 8.
static inline total sum_of(__global const total *sums, int row, int chunks) {
  total part[8] = {0, 0, 0, 0, 0, 0, 0, 0}, sum = 0;
  int k = 0;
  for (; k + 8 <= chunks; k += 8)
    for (int j = 0; j < 8; ++j) part[j] += sums[row * chunks + k + j];
  for (int j = 0; j < 8; ++j) sum += part[j];
  for (; k < chunks; ++k) sum += sums[row * chunks + k];
  return sum;
}

// Loads a diagonal 3 x 3 matrix block of A. Its six different elements are stored as six columns.
static inline Symmetric load_block(TABLE(scalar) diagonal, int u) {
  real3 a = load3(diagonal, u, 6, 0), b = load3(diagonal, u, 6, 3);
  Symmetric m;
  m.xx = a.x, m.yy = a.y, m.zz = a.z, m.xy = b.x, m.xz = b.y, m.yz = b.z;
  return m;
}
static inline void store_block(Symmetric m, __global scalar *diagonal, int u) {
  store3(vec3(m.xx, m.yy, m.zz), diagonal, u, 6, 0);
  store3(vec3(m.xy, m.xz, m.yz), diagonal, u, 6, 3);
}

// Returns the inverse of a diagonal matrix block. The inverse is the preconditioner.
INLINE Symmetric inverse_of(Symmetric m) {
  Factors f = factored(m);
  real3 x = solved(f, uniform3(1.0f, 0.0f, 0.0f)), y = solved(f, uniform3(0.0f, 1.0f, 0.0f));
  real3 z = solved(f, uniform3(0.0f, 0.0f, 1.0f));
  Symmetric i;
  i.xx = x.x, i.yy = y.y, i.zz = z.z, i.xy = y.x, i.xz = z.x, i.yz = z.y;
  return i;
}

// Two top masses joined by a spring have the matrix block -(even I + g g^T) in A, with a number `even` and a vector g.
// Only g is stored, in three columns per entry. The sum of `even` and g.g is the same for all springs, so even_of() can
// compute `even` from g. An entry with g = 0 is padding and stands for no spring.
INLINE real even_of(TopologyParams p, real3 g) {
  real along = dot3(g, g);
  real even = REAL(p.step * (p.step * p.edge_stiffness + p.edge_damping)) - along;
  return along > REAL(0.0f) ? even : REAL(0.0f);
}

// Returns (even I + g g^T) w.
INLINE real3 pulled(TopologyParams p, real3 g, real3 w) { return along3(scale3(even_of(p, g), w), dot3(g, w), g); }

// Computes A, the inverses of its diagonal matrix blocks and the right-hand side b from the state. Then
// computes the residual r = b - A x, and the product z of the inverses and r. Stores z as the first search
// direction d. moments: wind, weight and object motion at successive times. at: index of the Moment at the
// end of the time step. root: positions of the sticks' bases. reach: positions of the top masses relative to their
// bases. The vector from one top mass to another is computed from differences of roots and differences of `reach`.
// The difference of two positions in R would have a rounding error of 6e-8 R, which is too large for stiff springs
// between light masses (docs/springs.md, section Solvers).
CALLED void set_up_chunk(TopologyParams p, int chunks, int chunk, int at, TABLE(Moment) moments, TABLE(scalar) sites,
                         TABLE(scalar) push, TABLE(int) start, TABLE(int) neighbour, TABLE(scalar) rest,
                         TABLE(scalar) root, TABLE(scalar) reach, TABLE(scalar) speed, TABLE(scalar) x,
                         __global scalar *diagonal, __global scalar *inverse, __global scalar *coupling,
                         __global scalar *r, __global scalar *d, __global total *sums) {
  real3 zero = uniform3(0.0f, 0.0f, 0.0f);
  totals rz = 0, rr = 0, bb = 0;
  for (int u = first_unit(p, chunk); u < last_unit(p, chunk); ++u) {
    whole own = WHOLE(u * LANES) + lane_numbers();
    Site site = load_site(p, sites, push, u, 1);
    Top a;
    a.q = xyz(load_rows(reach, u));
    a.v = xyz(load_rows(speed, u));
    real3 force = zero, load = zero, pulls = zero;
    Symmetric springs = symmetric(REAL(0.0f), REAL(0.0f), zero, REAL(0.0f), zero);
    int width = width_of(start, u);
    for (int k = 0; k < width; ++k) {
      int e = entry_of(start, u, k);
      whole other = load_whole(neighbour, e);
      real spring = other != own ? REAL(1.0f) : REAL(0.0f);  // 0: padding, whose neighbour is the stick itself
      real3 apart = add3(sub3(xyz(gather_rows(root, other)), site.root), sub3(xyz(gather_rows(reach, other)), a.q));
      real3 parting = sub3(xyz(gather_rows(speed, other)), a.v);
      real length = load_real(rest, e);
      force = add3(force, edge_force(p, apart, parting, length));
      Span edge = span_of(apart);
      Stiffness m = stiffness_of(p.step, p.edge_stiffness, p.edge_damping, edge, length);
      real3 g = scale3(spring * sqrt(m.along), edge.s);
      real even = even_of(p, g);
      springs = plus(springs, symmetric(even, REAL(1.0f), g, REAL(0.0f), zero));
      load = add3(load, along3(scale3(even, parting), spring * m.stiff_along * dot3(edge.s, parting), edge.s));
      pulls = add3(pulls, pulled(p, g, xyz(gather_rows(x, other))));
      store3(g, coupling, e, 3, 0);
    }
    Row row = stick_row(p, site, a, add3(stick_force(p, moments[at], site, a), force));
    row.block = plus(row.block, springs);
    store_block(row.block, diagonal, u);
    truth real_row = own < WHOLE(p.sticks);
    real3 b = choose3(real_row, add3(row.load, load), zero);
    real3 left = sub3(b, sub3(times(row.block, xyz(load_rows(x, u))), pulls));
    left = choose3(real_row, left, zero);
    Symmetric over = inverse_of(row.block);
    store_block(over, inverse, u);
    real3 z = times(over, left);
    store3(left, r, u, 3, 0);
    store_rows(row_of(z), d, u);
    rz += to_totals(dot3(left, z));
    rr += to_totals(dot3(left, left));
    bb += to_totals(dot3(b, b));
  }
  sums[SUM_RZ_EVEN * chunks + chunk] = total_of(rz);
  sums[SUM_RR * chunks + chunk] = total_of(rr);
  sums[SUM_BB * chunks + chunk] = total_of(bb);
}
__kernel void gradients_set_up(TopologyParams p, int chunks, int at, TABLE(Moment) moments, TABLE(scalar) sites,
                               TABLE(scalar) push, TABLE(int) start, TABLE(int) neighbour, TABLE(scalar) rest,
                               TABLE(scalar) root, TABLE(scalar) reach, TABLE(scalar) speed, TABLE(scalar) x,
                               __global scalar *diagonal, __global scalar *inverse, __global scalar *coupling,
                               __global scalar *r, __global scalar *d, __global total *sums) {
  int chunk = (int)get_global_id(0);
  if (chunk < chunks)
    set_up_chunk(p, chunks, chunk, at, moments, sites, push, start, neighbour, rest, root, reach, speed, x, diagonal,
                 inverse, coupling, r, d, sums);
}

// Computes the product A d, and the sum d.Ad of each chunk.
CALLED void product_chunk(TopologyParams p, int chunks, int chunk, TABLE(int) start, TABLE(int) neighbour,
                          TABLE(scalar) diagonal, TABLE(scalar) coupling, TABLE(scalar) d, __global scalar *product_d,
                          __global total *sums) {
  totals sum = 0;
  for (int u = first_unit(p, chunk); u < last_unit(p, chunk); ++u) {
    real3 v = xyz(load_rows(d, u)), w = times(load_block(diagonal, u), v);
    int width = width_of(start, u);
    for (int k = 0; k < width; ++k) {
      int e = entry_of(start, u, k);
      w = sub3(w, pulled(p, load3(coupling, e, 3, 0), xyz(gather_rows(d, load_whole(neighbour, e)))));
    }
    store3(w, product_d, u, 3, 0);
    sum += to_totals(dot3(v, w));
  }
  sums[SUM_DAD * chunks + chunk] = total_of(sum);
}
__kernel void gradients_product(TopologyParams p, int chunks, TABLE(int) start, TABLE(int) neighbour,
                                TABLE(scalar) diagonal, TABLE(scalar) coupling, TABLE(scalar) d,
                                __global scalar *product_d, __global total *sums) {
  int chunk = (int)get_global_id(0);
  if (chunk < chunks) product_chunk(p, chunks, chunk, start, neighbour, diagonal, coupling, d, product_d, sums);
}

// Returns the step length r.z / d.Ad of the conjugate gradients. odd: 1 if the number of the iteration is odd.
static inline real alpha_of(__global const total *sums, int chunks, int odd) {
  total dad = sum_of(sums, SUM_DAD, chunks);
  // If dad (the sum d.Ad) is NaN, the returned step length and x become NaN too, so note_step() reports the diverged
  // masses. If this function returned 0 for a NaN, x and the positions of these masses could stay finite. The
  // divergence would then not be detected.
  return REAL((scalar)(dad <= 0 ? 0 : sum_of(sums, odd ? SUM_RZ_ODD : SUM_RZ_EVEN, chunks) / dad));
}

// Computes the new residual r -= alpha A d, and the product z of `inverse` and r. Stores z in the buffer that held A d.
CALLED void advance_chunk(TopologyParams p, int chunks, int chunk, int odd, TABLE(scalar) inverse,
                          __global scalar *product_d, __global scalar *r, __global total *sums) {
  real alpha = alpha_of(sums, chunks, odd);
  totals rz = 0, rr = 0;
  for (int u = first_unit(p, chunk); u < last_unit(p, chunk); ++u) {
    real3 left = along3(load3(r, u, 3, 0), -alpha, load3(product_d, u, 3, 0));
    real3 z = times(load_block(inverse, u), left);
    store3(left, r, u, 3, 0);
    store3(z, product_d, u, 3, 0);
    rz += to_totals(dot3(left, z));
    rr += to_totals(dot3(left, left));
  }
  sums[(odd ? SUM_RZ_EVEN : SUM_RZ_ODD) * chunks + chunk] = total_of(rz);
  sums[SUM_RR * chunks + chunk] = total_of(rr);
}
__kernel void gradients_advance(TopologyParams p, int chunks, int odd, TABLE(scalar) inverse, __global scalar *product_d,
                                __global scalar *r, __global total *sums) {
  int chunk = (int)get_global_id(0);
  if (chunk < chunks) advance_chunk(p, chunks, chunk, odd, inverse, product_d, r, sums);
}

// Computes x += alpha d, and then the next search direction d = z + beta d. beta is the new r.z divided by the old r.z.
CALLED void turn_chunk(TopologyParams p, int chunks, int chunk, int odd, TABLE(scalar) z, __global scalar *d,
                       __global scalar *x, __global const total *sums) {
  real alpha = alpha_of(sums, chunks, odd);
  total before = sum_of(sums, odd ? SUM_RZ_ODD : SUM_RZ_EVEN, chunks);
  total after = sum_of(sums, odd ? SUM_RZ_EVEN : SUM_RZ_ODD, chunks);
  real beta = REAL((scalar)(before > 0 ? after / before : 0));
  for (int u = first_unit(p, chunk); u < last_unit(p, chunk); ++u) {
    real3 way = xyz(load_rows(d, u));
    store_rows(row_of(along3(xyz(load_rows(x, u)), alpha, way)), x, u);
    store_rows(row_of(along3(load3(z, u, 3, 0), beta, way)), d, u);
  }
}
__kernel void gradients_turn(TopologyParams p, int chunks, int odd, TABLE(scalar) z, __global scalar *d,
                             __global scalar *x, __global const total *sums) {
  int chunk = (int)get_global_id(0);
  if (chunk < chunks) turn_chunk(p, chunks, chunk, odd, z, d, x, sums);
}

// Computes the new velocity v += x, and then the new position q += h v, where h is the time step. Stores q in columns
// (offset) and in rows (reach).
CALLED void move_chunk(TopologyParams p, int chunk, int number, TABLE(scalar) x, __global scalar *offset,
                       __global scalar *speed, __global scalar *reach, __global int *diverged_at, __global int *first) {
  for (int u = first_unit(p, chunk); u < last_unit(p, chunk); ++u) {
    Top a;
    a.v = add3(xyz(load_rows(speed, u)), xyz(load_rows(x, u)));
    a.q = along3(load3(offset, u, 3, 0), REAL(p.step), a.v);
    store_rows(row_of(a.v), speed, u);
    store3(a.q, offset, u, 3, 0);
    store_rows(row_of(a.q), reach, u);
    note_step(p, a, u, number, diverged_at, first);
  }
}
__kernel void gradients_move(TopologyParams p, int chunks, int number, TABLE(scalar) x, __global scalar *offset,
                             __global scalar *speed, __global scalar *reach, __global int *diverged_at,
                             __global int *first) {
  int chunk = (int)get_global_id(0);
  if (chunk < chunks) move_chunk(p, chunk, number, x, offset, speed, reach, diverged_at, first);
}

// Computes all substeps of a launch in one work-item. Each substep iterates until |r| <= residual |b|, but at most
// `most` times. The whole model is one chunk. solved: receives the total number of iterations, the greatest
// number of iterations in one substep, and the greatest |r| / |b| at the end of a substep.
__kernel void gradients_whole(TopologyParams p, int most, scalar residual, TABLE(Moment) moments, TABLE(scalar) sites,
                              TABLE(scalar) push, TABLE(int) start, TABLE(int) neighbour, TABLE(scalar) rest,
                              TABLE(scalar) root, __global scalar *reach, __global scalar *offset,
                              __global scalar *speed, __global scalar *x,
                              __global scalar *diagonal, __global scalar *inverse, __global scalar *coupling,
                              __global scalar *r, __global scalar *d, __global scalar *product_d, __global total *sums,
                              __global int *diverged_at, __global int *first, __global scalar *solved) {
  if (get_global_id(0) != 0) return;
  for (int k = 0; k < 3; ++k) solved[k] = 0;
  for (int i = 0; i < p.substeps; ++i) {
    set_up_chunk(p, 1, 0, p.first_moment + 2 * i + 2, moments, sites, push, start, neighbour, rest, root, reach, speed, x,
                 diagonal, inverse, coupling, r, d, sums);
    total bb = sums[SUM_BB];
    int done = 0;
    // At least one iteration is computed. If a mass has diverged, one of the sums is infinite or NaN, and
    // this iteration makes x NaN.
    for (; done < most && (done == 0 || sums[SUM_RR] > (total)residual * (total)residual * bb); ++done) {
      product_chunk(p, 1, 0, start, neighbour, diagonal, coupling, d, product_d, sums);
      advance_chunk(p, 1, 0, done % 2, inverse, product_d, r, sums);
      turn_chunk(p, 1, 0, done % 2, product_d, d, x, sums);
    }
    move_chunk(p, 0, p.first_step + i, x, offset, speed, reach, diverged_at, first);
    scalar left = bb > 0 ? sqrt((scalar)(sums[SUM_RR] / bb)) : 0;
    solved[0] += (scalar)done;
    solved[1] = solved[1] > (scalar)done ? solved[1] : (scalar)done;
    solved[2] = solved[2] > left ? solved[2] : left;
  }
}
