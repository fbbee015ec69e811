// The loops of the serial baselines. plain_loops.cpp and fast_loops.cpp include this file and are compiled
// with different flags. The loops over sticks and over triangles run all steps for one tile of 256 sticks or
// triangles before they start the next tile, so that the tile's state stays in the first-level cache. Several
// threads divide the tiles among themselves.
#ifdef __clang__  // The pragmas that start with GCC are for GCC only.
#pragma clang diagnostic ignored "-Wunknown-pragmas"
#endif

constexpr int tile = 256;

// The properties of a Solver that are used as template arguments.
struct Scheme {
  bool implicit = false, in_turn = false;
  int stages = 1;
};

// A stage of a scheme with several evaluations of the forces, as in kernels/springs/equations.clh.
template <class T>
struct Stage {
  T weight, reach;
  int moment;
  bool corrects;
};
template <class T>
PELAGE_INLINE Stage<T> stage_of(int stages, int i, T h) {
  if (stages == 4) return {i == 0 || i == 3 ? h / T(6) : h / T(3), i < 2 ? h / T(2) : h, (i + 1) / 2, false};
  return {i == 1 ? T(0) : h / T(2), i == 0 ? h : h / T(2), i == 0 ? 0 : 2, i > 0};
}

template <class T>
PELAGE_INLINE V<T> at(T* const column[3], int i) {
  return {column[0][i], column[1][i], column[2][i]};
}
template <class T>
PELAGE_INLINE void put(T* const column[3], int i, V<T> a) {
  column[0][i] = a.x, column[1][i] = a.y, column[2][i] = a.z;
}
// The positions q and the velocities v of the tops.
template <class T>
struct Lists {
  T *q[3], *v[3];
};
template <class T>
Lists<T> lists_of(T* const q[3], T* const v[3]) {
  return {{q[0], q[1], q[2]}, {v[0], v[1], v[2]}};
}
template <class T>
PELAGE_INLINE Place<T> place(const Arrays<T>& a, int i) {
  return {at(a.root, i), at(a.normal, i), a.phase_cos[i], a.phase_sin[i]};
}

// State of the tops of one independent system: N = 1 for a stick, N = 3 for a separable prism.
template <class T, int N>
struct Block {
  V<T> q[N], v[N];
};
template <class T, int N>
struct Ground {
  Place<T> place[N];
  T rest[N];
};

template <class T, int N>
PELAGE_INLINE void forces(const Constants<T>& p, const Outside<T>& t, const Ground<T, N>& g,
                          const Block<T, N>& a, V<T> f[N]) {
#pragma GCC unroll 3
  for (int c = 0; c < N; ++c) f[c] = stick_force(p, t, g.place[c], a.q[c], a.v[c]);
  if constexpr (N == 3) {
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      const int to = c < 2 ? c + 1 : 0;
      const V<T> d = (g.place[to].root - g.place[c].root) + (a.q[to] - a.q[c]);
      const V<T> pull = edge_force(p, d, a.v[to] - a.v[c], g.rest[c]);
      f[c] = f[c] + pull;
      f[to] = f[to] - pull;
    }
  }
}

template <class T, int N, Scheme scheme>
PELAGE_INLINE Block<T, N> stepped(const Constants<T>& p, const Outside<T>* t, const Ground<T, N>& g,
                                  const Block<T, N>& a) {
  const T h = p.step;
  V<T> f[N];
  Block<T, N> b = a;
  if constexpr (!scheme.implicit && scheme.stages == 1) {
    forces<T, N>(p, t[0], g, a, f);
#pragma GCC unroll 3
    for (int c = 0; c < N; ++c) {
      b.v[c] = a.v[c] + (h * p.inverse_mass) * f[c];
      b.q[c] = a.q[c] + h * (scheme.in_turn ? b.v[c] : a.v[c]);
    }
  } else if constexpr (scheme.stages > 1) {
    Block<T, N> stage = a;
#pragma GCC unroll 4
    for (int i = 0; i < scheme.stages; ++i) {
      const Stage<T> s = stage_of(scheme.stages, i, h);
      forces<T, N>(p, t[s.moment], g, stage, f);
#pragma GCC unroll 3
      for (int c = 0; c < N; ++c) {
        const V<T> speed = stage.v[c], rate = p.inverse_mass * f[c];
        stage.q[c] = (s.corrects ? b.q[c] : a.q[c]) + s.reach * speed;
        stage.v[c] = (s.corrects ? b.v[c] : a.v[c]) + s.reach * rate;
        b.q[c] = b.q[c] + s.weight * speed;
        b.v[c] = b.v[c] + s.weight * rate;
      }
    }
  } else {
    forces<T, N>(p, t[2], g, a, f);
    Row<T> row[N];
    V<T> change[N];
#pragma GCC unroll 3
    for (int c = 0; c < N; ++c) row[c] = stick_row(p, g.place[c], a.q[c], a.v[c], f[c]);
    if constexpr (N == 1) {
      change[0] = solved(row[0].block, row[0].load);
    } else {
      Symmetric<T> side[3];
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) {
        const int to = c < 2 ? c + 1 : 0;
        const V<T> d = (g.place[to].root - g.place[c].root) + (a.q[to] - a.q[c]);
        const Coupling<T> k = coupling_of(p, d, a.v[to] - a.v[c], g.rest[c]);
        side[c] = symmetric(k.even, k.along, k.s, T(0), k.s);
        row[c].block = row[c].block + side[c];
        row[to].block = row[to].block + side[c];
        row[c].load = row[c].load + k.drawn;
        row[to].load = row[to].load - k.drawn;
      }
      solve_triangle(row, side, change);
    }
#pragma GCC unroll 3
    for (int c = 0; c < N; ++c) {
      b.v[c] = a.v[c] + change[c];
      b.q[c] = a.q[c] + h * b.v[c];
    }
  }
  return b;
}

// Calls work(part) for the parts 0 to threads - 1. Up to `tile` items, one thread runs all parts, because
// starting a second thread would take longer than the work.
template <class Work>
void in_parts(int threads, int items, const Work& work) {
  if (threads == 1) return work(0);
#pragma omp parallel for num_threads(threads) schedule(static, 1) if (items > tile)
  for (int part = 0; part < threads; ++part) work(part);
}
// Returns the index of the first item of the part, if `count` items are divided into `threads` parts.
inline int begin_of(int part, int threads, int count) {
  return int(std::int64_t(part) * count / threads);
}

// Computes all time steps of the independent systems `first` to `end` - 1.
template <class T, int N, Scheme scheme, bool moving>
void through_tile(const Arrays<T> a, const Constants<T> constants, const Course& course, int first, int end) {
  Constants<T> p = constants;
  p.moving = moving;
  const int blocks = a.sticks / N;
  for (int i = 0; i < course.steps; ++i) {
    const Moment* moment = course.moments + 2 * std::size_t(i);
    const Outside<T> t[3] = {outside<T>(moment[0]), outside<T>(moment[1]), outside<T>(moment[2])};
#pragma GCC ivdep
    for (int k = first; k < end; ++k) {
      Ground<T, N> g;
      Block<T, N> b;
#pragma GCC unroll 3
      for (int c = 0; c < N; ++c) {
        g.place[c] = place(a, c * blocks + k);
        g.rest[c] = N == 3 ? a.rest[c * blocks + k] : T(0);
        b.q[c] = at(a.q, c * blocks + k);
        b.v[c] = at(a.v, c * blocks + k);
      }
      b = stepped<T, N, scheme>(p, t, g, b);
#pragma GCC unroll 3
      for (int c = 0; c < N; ++c) {
        put(a.q, c * blocks + k, b.q[c]);
        put(a.v, c * blocks + k, b.v[c]);
      }
    }
  }
}

template <class T, int N, Scheme scheme, bool moving>
void through_blocks(const Arrays<T>& a, const Course& course) {
  const Constants<T> p = constants<T>(course.params);
  const int blocks = a.sticks / N, tiles = (blocks + tile - 1) / tile;
  in_parts(course.threads, blocks, [&](int part) {
    for (int n = begin_of(part, course.threads, tiles); n < begin_of(part + 1, course.threads, tiles); ++n)
      through_tile<T, N, scheme, moving>(a, p, course, n * tile, n < tiles - 1 ? (n + 1) * tile : blocks);
  });
}

// Sets force[0] to the forces on the tops of the sticks `first` to `end` - 1, without those of the edges.
template <class T, bool moving>
void stick_forces(const Arrays<T> a, const Constants<T> constants, const Moment& moment, const Lists<T> state,
                  int first, int end) {
  Constants<T> p = constants;
  p.moving = moving;
  const Outside<T> t = outside<T>(moment);
#pragma GCC ivdep
  for (int i = first; i < end; ++i)
    put(a.force[0], i, stick_force(p, t, place(a, i), at(state.q, i), at(state.v, i)));
}

// Adds the forces of the edges `first` to `end` - 1 to `force`. Of each tile of 256 edges, one loop computes
// the forces, so that it is vectorized, and a second loop adds them to both ends of the edges.
template <class T>
void edge_forces(const Arrays<T> a, const Constants<T> p, const Lists<T> state, T* const force[3], int first,
                 int end) {
  T pull[3][tile];
  for (; first < end; first += tile) {
    const int count = first + tile < end ? tile : end - first;
#pragma GCC ivdep
    for (int k = 0; k < count; ++k) {
      const int from = a.from[first + k], to = a.to[first + k];
      const V<T> d = (at(a.root, to) - at(a.root, from)) + (at(state.q, to) - at(state.q, from));
      const V<T> f = edge_force(p, d, at(state.v, to) - at(state.v, from), a.rest[first + k]);
      pull[0][k] = f.x, pull[1][k] = f.y, pull[2][k] = f.z;
    }
    for (int k = 0; k < count; ++k) {
      const int from = a.from[first + k], to = a.to[first + k];
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) force[c][from] += pull[c][k], force[c][to] -= pull[c][k];
    }
  }
}

// For the sticks `first` to `end` - 1, adds the vectors in `other` to those in `sum`, and sets `other` to 0.
template <class T>
void gather_parts(T* const sum[3], T* const other[3], int first, int end) {
  for (int c = 0; c < 3; ++c) {
    T *a = sum[c], *b = other[c];
#pragma GCC ivdep
    for (int i = first; i < end; ++i) a[i] += b[i], b[i] = T(0);
  }
}

// Sets force[0] to the forces on all tops. With two threads, each thread processes half of the edges, and the
// second adds its forces to force[1], which contains zeros before the call.
template <class T, bool moving>
void all_forces(const Arrays<T>& a, const Constants<T>& p, const Moment& moment, const Lists<T>& state,
                int threads) {
  const auto share = [&](int part, int count) { return begin_of(part, threads, count); };
  in_parts(threads, a.sticks, [&](int part) {
    stick_forces<T, moving>(a, p, moment, state, share(part, a.sticks), share(part + 1, a.sticks));
  });
  in_parts(threads, a.sticks, [&](int part) {
    edge_forces<T>(a, p, state, a.force[part], share(part, a.edges), share(part + 1, a.edges));
  });
  if (threads > 1)
    in_parts(threads, a.sticks, [&](int part) {
      gather_parts<T>(a.force[0], a.force[1], share(part, a.sticks), share(part + 1, a.sticks));
    });
}

// Advances the top masses `first` to `end` - 1 by one step of explicit or semi-implicit Euler.
template <class T>
void euler_move(const Arrays<T> a, T h, T rate, bool in_turn, int first, int end) {
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    T *q = a.q[c], *v = a.v[c];
    const T* f = a.force[0][c];
#pragma GCC ivdep
    for (int k = first; k < end; ++k) {
      const T speed = v[k] + rate * f[k];
      q[k] += h * (in_turn ? speed : v[k]);
      v[k] = speed;
    }
  }
}

// Computes a stage of a step for the top masses `first` to `end` - 1.
template <class T>
void stage_move(const Arrays<T> a, const Lists<T> state, T h, T inverse_mass, int stages, int stage, int first,
                int end) {
  T *const *stage_q = a.work, *const *stage_v = a.work + 3, *const *sum_q = a.work + 6,
           *const *sum_v = a.work + 9;
  const Stage<T> s = stage_of(stages, stage, h);
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
#pragma GCC ivdep
    for (int k = first; k < end; ++k) {
      const T speed = state.v[c][k], rate = inverse_mass * a.force[0][c][k];
      const T q = stage == 0 ? a.q[c][k] : sum_q[c][k], v = stage == 0 ? a.v[c][k] : sum_v[c][k];
      sum_q[c][k] = q + s.weight * speed;
      sum_v[c][k] = v + s.weight * rate;
      if (stage < stages - 1) {
        stage_q[c][k] = (s.corrects ? q : a.q[c][k]) + s.reach * speed;
        stage_v[c][k] = (s.corrects ? v : a.v[c][k]) + s.reach * rate;
      } else {
        a.q[c][k] = sum_q[c][k];
        a.v[c][k] = sum_v[c][k];
      }
    }
  }
}

#include "harness/springs/baselines/gradients.inl"

template <class T, bool moving>
long through_prisms(const Arrays<T>& a, const Course& course) {
  const Constants<T> p = constants<T>(course.params);
  const T h = p.step;
  const int threads = course.threads;
  const auto share = [&](int part) { return begin_of(part, threads, a.sticks); };
  const Lists<T> state = lists_of(a.q, a.v), staged = lists_of(a.work, a.work + 3);
  long iterations = 0;
  for (int i = 0; i < course.steps; ++i) {
    const Moment* t = course.moments + 2 * std::size_t(i);
    if (course.solver.implicit) {
      all_forces<T, moving>(a, p, t[2], state, threads);
      iterations += gradient_step<T>(a, p, course);
    } else if (!course.solver.multistage()) {
      all_forces<T, moving>(a, p, t[0], state, threads);
      in_parts(threads, a.sticks, [&](int part) {
        euler_move<T>(a, h, h * p.inverse_mass, course.solver.in_turn, share(part), share(part + 1));
      });
    } else {
      const int stages = course.solver.stages;
      for (int stage = 0; stage < stages; ++stage) {
        const Lists<T>& now = stage == 0 ? state : staged;
        all_forces<T, moving>(a, p, t[stage_of(stages, stage, h).moment], now, threads);
        in_parts(threads, a.sticks, [&](int part) {
          stage_move<T>(a, now, h, p.inverse_mass, stages, stage, share(part), share(part + 1));
        });
      }
    }
  }
  return iterations;
}

template <class T, int N, bool moving>
void blocks_by(const Arrays<T>& a, const Course& course) {
  const Solver& solver = course.solver;
  if (solver.stages == 4) return through_blocks<T, N, Scheme{.stages = 4}, moving>(a, course);
  if (solver.stages == 3) return through_blocks<T, N, Scheme{.stages = 3}, moving>(a, course);
  if (!solver.implicit)
    return solver.in_turn ? through_blocks<T, N, Scheme{.in_turn = true}, moving>(a, course)
                          : through_blocks<T, N, Scheme{}, moving>(a, course);
  through_blocks<T, N, Scheme{.implicit = true}, moving>(a, course);
}

template <class T>
Loops<T> loops() {
  return {[](const Arrays<T>& a, const Course& c) {
            c.params.moving ? blocks_by<T, 1, true>(a, c) : blocks_by<T, 1, false>(a, c);
          },
          [](const Arrays<T>& a, const Course& c) {
            c.params.moving ? blocks_by<T, 3, true>(a, c) : blocks_by<T, 3, false>(a, c);
          },
          [](const Arrays<T>& a, const Course& c) {
            return c.params.moving ? through_prisms<T, true>(a, c) : through_prisms<T, false>(a, c);
          }};
}
