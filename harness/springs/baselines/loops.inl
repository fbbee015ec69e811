// The serial loops, compiled once per set of flags (plain_loops.cpp, fast_loops.cpp). The loops over sticks
// and over triangles run all steps for one tile of 256 sticks or triangles before they start the next tile,
// so that the tile's state stays in the first-level cache.

constexpr int tile = 256;

// The properties of a Solver that are used as template arguments.
struct Scheme {
  bool implicit = false, in_turn = false;
  int stages = 1;
};

template <class T>
PELAGE_INLINE V<T> at(T* const column[3], int i) {
  return {column[0][i], column[1][i], column[2][i]};
}
template <class T>
PELAGE_INLINE V<T> at(const T* const column[3], int i) {
  return {column[0][i], column[1][i], column[2][i]};
}
template <class T>
PELAGE_INLINE void put(T* const column[3], int i, V<T> a) {
  column[0][i] = a.x, column[1][i] = a.y, column[2][i] = a.z;
}
template <class T>
PELAGE_INLINE Place<T> place(const Arrays<T>& a, int i) {
  return {at(a.root, i), at(a.normal, i), a.phase_cos[i], a.phase_sin[i]};
}

// State of the top masses of one independent system: N = 1 for a single stick, N = 3 for the three sticks of
// a separable prism.
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
  } else if constexpr (scheme.stages == 4) {
    Block<T, N> stage = a;
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) {
      forces<T, N>(p, t[i == 0 ? 0 : i == 3 ? 2 : 1], g, stage, f);
      const T weight = i == 0 || i == 3 ? h / T(6) : h / T(3), reach = i < 2 ? h / T(2) : h;
#pragma GCC unroll 3
      for (int c = 0; c < N; ++c) {
        const V<T> speed = stage.v[c], rate = p.inverse_mass * f[c];
        b.q[c] = b.q[c] + weight * speed;
        b.v[c] = b.v[c] + weight * rate;
        stage.q[c] = a.q[c] + reach * speed;
        stage.v[c] = a.v[c] + reach * rate;
      }
    }
  } else {
    forces<T, N>(p, t[2], g, a, f);
#pragma GCC unroll 3
    for (int c = 0; c < N; ++c) {
      const Row<T> row = stick_row(p, g.place[c], a.q[c], a.v[c], f[c]);
      b.v[c] = a.v[c] + solved(row.block, row.load);
      b.q[c] = a.q[c] + h * b.v[c];
    }
  }
  return b;
}

template <class T, int N, Scheme scheme, bool moving>
void through_blocks(const Arrays<T>& given, const Course& course) {
  const Arrays<T> a = given;
  Constants<T> p = constants<T>(course.params);
  p.moving = moving;
  const int blocks = a.sticks / N;
  for (int first = 0; first < blocks; first += tile) {
    const int end = first + tile < blocks ? first + tile : blocks;
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
}

// Computes all forces on shared prisms (adjacent prisms share their sticks). For each tile of edges, it
// computes the spring forces and then adds them to the forces on both ends of the edges.
template <class T, bool moving>
void all_forces(const Arrays<T>& given, const Constants<T>& constants, const Moment& moment, T* const qs[3],
                T* const vs[3]) {
  const Arrays<T> a = given;
  Constants<T> p = constants;
  p.moving = moving;
  T *const q[3] = {qs[0], qs[1], qs[2]}, *const v[3] = {vs[0], vs[1], vs[2]};
  const Outside<T> t = outside<T>(moment);
#pragma GCC ivdep
  for (int i = 0; i < a.sticks; ++i) put(a.force, i, stick_force(p, t, place(a, i), at(q, i), at(v, i)));
  T pull[3][tile];
  for (int first = 0; first < a.edges; first += tile) {
    const int count = first + tile < a.edges ? tile : a.edges - first;
#pragma GCC ivdep
    for (int k = 0; k < count; ++k) {
      const int from = a.from[first + k], to = a.to[first + k];
      const V<T> d = (at(a.root, to) - at(a.root, from)) + (at(q, to) - at(q, from));
      const V<T> f = edge_force(p, d, at(v, to) - at(v, from), a.rest[first + k]);
      pull[0][k] = f.x, pull[1][k] = f.y, pull[2][k] = f.z;
    }
    for (int k = 0; k < count; ++k) {
      const int from = a.from[first + k], to = a.to[first + k];
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) a.force[c][from] += pull[c][k], a.force[c][to] -= pull[c][k];
    }
  }
}

template <class T, bool moving>
void through_prisms(const Arrays<T>& a, const Course& course) {
  const Constants<T> p = constants<T>(course.params);
  const T h = p.step;
  for (int i = 0; i < course.steps; ++i) {
    const Moment* t = course.moments + 2 * std::size_t(i);
    if (!course.solver.multistage()) {
      all_forces<T, moving>(a, p, t[0], a.q, a.v);
      const bool in_turn = course.solver.in_turn;
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) {
        T *q = a.q[c], *v = a.v[c];
        const T* f = a.force[c];
#pragma GCC ivdep
        for (int k = 0; k < a.sticks; ++k) {
          const T speed = v[k] + (h * p.inverse_mass) * f[k];
          q[k] += h * (in_turn ? speed : v[k]);
          v[k] = speed;
        }
      }
      continue;
    }
    T *const *stage_q = a.work, *const *stage_v = a.work + 3, *const *sum_q = a.work + 6,
             *const *sum_v = a.work + 9;
    for (int stage = 0; stage < 4; ++stage) {
      T *const *q = stage == 0 ? a.q : stage_q, *const *v = stage == 0 ? a.v : stage_v;
      all_forces<T, moving>(a, p, t[(stage + 1) / 2], q, v);
      const T weight = stage == 0 || stage == 3 ? h / T(6) : h / T(3), reach = stage < 2 ? h / T(2) : h;
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) {
#pragma GCC ivdep
        for (int k = 0; k < a.sticks; ++k) {
          const T speed = v[c][k], rate = p.inverse_mass * a.force[c][k];
          sum_q[c][k] = (stage == 0 ? a.q[c][k] : sum_q[c][k]) + weight * speed;
          sum_v[c][k] = (stage == 0 ? a.v[c][k] : sum_v[c][k]) + weight * rate;
          if (stage < 3) {
            stage_q[c][k] = a.q[c][k] + reach * speed;
            stage_v[c][k] = a.v[c][k] + reach * rate;
          } else {
            a.q[c][k] = sum_q[c][k];
            a.v[c][k] = sum_v[c][k];
          }
        }
      }
    }
  }
}

template <class T, int N, bool moving>
void blocks_by(const Arrays<T>& a, const Course& course) {
  const Solver& solver = course.solver;
  if (solver.multistage()) return through_blocks<T, N, Scheme{.stages = 4}, moving>(a, course);
  if (!solver.implicit)
    return solver.in_turn ? through_blocks<T, N, Scheme{.in_turn = true}, moving>(a, course)
                          : through_blocks<T, N, Scheme{}, moving>(a, course);
  if constexpr (N == 1) through_blocks<T, N, Scheme{.implicit = true}, moving>(a, course);
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
            c.params.moving ? through_prisms<T, true>(a, c) : through_prisms<T, false>(a, c);
          }};
}
