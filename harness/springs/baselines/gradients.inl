// Backward Euler on prisms: each step solves the equations of all tops by conjugate gradients, preconditioned
// by the inverses of the 3 x 3 diagonal blocks. loops.inl includes this file. An edge couples the equations of
// its two tops by the matrix even I + g g^T, where g is sqrt(along) * s (coupling_of()).

// Computes the coupling of the edges `first` to `end` - 1. For each edge, adds terms to the diagonal blocks
// and to the right-hand sides of the two sticks at its ends, in the arrays of the thread `part`.
template <class T>
void edge_rows(const Arrays<T> a, const Constants<T> p, int part, int first, int end) {
  const Gradients<T>& g = a.gradients;
  T block[6][tile], drawn[3][tile];
  for (; first < end; first += tile) {
    const int count = first + tile < end ? tile : end - first;
#pragma GCC ivdep
    for (int k = 0; k < count; ++k) {
      const int e = first + k, from = a.from[e], to = a.to[e];
      const V<T> d = (at(a.root, to) - at(a.root, from)) + (at(a.q, to) - at(a.q, from));
      const Coupling<T> c = coupling_of(p, d, at(a.v, to) - at(a.v, from), a.rest[e]);
      const T size = std::sqrt(c.along > T(0) ? c.along : T(0));
      g.coupling[0][e] = c.even;
      g.coupling[1][e] = size * c.s.x, g.coupling[2][e] = size * c.s.y, g.coupling[3][e] = size * c.s.z;
      const Symmetric<T> m = symmetric(c.even, c.along, c.s, T(0), c.s);
      block[0][k] = m.xx, block[1][k] = m.yy, block[2][k] = m.zz;
      block[3][k] = m.xy, block[4][k] = m.xz, block[5][k] = m.yz;
      drawn[0][k] = c.drawn.x, drawn[1][k] = c.drawn.y, drawn[2][k] = c.drawn.z;
    }
    for (int k = 0; k < count; ++k) {
      const int from = a.from[first + k], to = a.to[first + k];
      for (int c = 0; c < 6; ++c)
        g.diagonal[part][c][from] += block[c][k], g.diagonal[part][c][to] += block[c][k];
      for (int c = 0; c < 3; ++c)
        g.product[part][c][from] += drawn[c][k], g.product[part][c][to] -= drawn[c][k];
    }
  }
}

// Computes the diagonal blocks, their inverses and the right-hand sides of the sticks `first` to `end` - 1,
// with the terms of the edges that each thread has added to its own arrays (edge_rows()). Sets the arrays of
// the second thread to 0.
template <class T>
void stick_rows(const Arrays<T> a, const Constants<T> p, int threads, int first, int end) {
  const Gradients<T>& g = a.gradients;
#pragma GCC ivdep
  for (int i = first; i < end; ++i) {
    Row<T> row = stick_row(p, place(a, i), at(a.q, i), at(a.v, i), at(a.force[0], i));
    V<T> load = row.load + at(g.product[0], i);
    Symmetric<T> block =
        row.block + Symmetric<T>{g.diagonal[0][0][i], g.diagonal[0][1][i], g.diagonal[0][2][i],
                                 g.diagonal[0][3][i], g.diagonal[0][4][i], g.diagonal[0][5][i]};
    if (threads > 1) {
      load = load + at(g.product[1], i);
      block = block + Symmetric<T>{g.diagonal[1][0][i], g.diagonal[1][1][i], g.diagonal[1][2][i],
                                   g.diagonal[1][3][i], g.diagonal[1][4][i], g.diagonal[1][5][i]};
      put(g.product[1], i, V<T>{0, 0, 0});
      for (int c = 0; c < 6; ++c) g.diagonal[1][c][i] = T(0);
    }
    const Symmetric<T> over = inverse(block);
    g.diagonal[0][0][i] = block.xx, g.diagonal[0][1][i] = block.yy, g.diagonal[0][2][i] = block.zz;
    g.diagonal[0][3][i] = block.xy, g.diagonal[0][4][i] = block.xz, g.diagonal[0][5][i] = block.yz;
    g.inverse[0][i] = over.xx, g.inverse[1][i] = over.yy, g.inverse[2][i] = over.zz;
    g.inverse[3][i] = over.xy, g.inverse[4][i] = over.xz, g.inverse[5][i] = over.yz;
    put(g.load, i, load);
  }
}

template <class T>
PELAGE_INLINE Symmetric<T> block_at(T* const column[6], int i) {
  return {column[0][i], column[1][i], column[2][i], column[3][i], column[4][i], column[5][i]};
}

// For the sticks `first` to `end` - 1, sets product[0] to the product of the stick's diagonal block and its
// vector in `x`.
template <class T>
void diagonal_product(const Arrays<T> a, T* const x[3], int first, int end) {
  const Gradients<T>& g = a.gradients;
#pragma GCC ivdep
  for (int i = first; i < end; ++i) put(g.product[0], i, block_at(g.diagonal[0], i) * at(x, i));
}
// For each edge from `first` to `end` - 1, multiplies the edge's coupling matrix by the vectors of its two
// ends in `x`. Subtracts each product from the element of product[part] that belongs to the opposite end.
template <class T>
void edge_product(const Arrays<T> a, T* const x[3], int part, int first, int end) {
  const Gradients<T>& g = a.gradients;
  T pull[6][tile];
  for (; first < end; first += tile) {
    const int count = first + tile < end ? tile : end - first;
#pragma GCC ivdep
    for (int k = 0; k < count; ++k) {
      const int e = first + k;
      const V<T> s = {g.coupling[1][e], g.coupling[2][e], g.coupling[3][e]}, from = at(x, a.from[e]),
                 to = at(x, a.to[e]);
      const V<T> on_from = g.coupling[0][e] * to + dot(s, to) * s,
                 on_to = g.coupling[0][e] * from + dot(s, from) * s;
      pull[0][k] = on_from.x, pull[1][k] = on_from.y, pull[2][k] = on_from.z;
      pull[3][k] = on_to.x, pull[4][k] = on_to.y, pull[5][k] = on_to.z;
    }
    for (int k = 0; k < count; ++k) {
      const int from = a.from[first + k], to = a.to[first + k];
      for (int c = 0; c < 3; ++c)
        g.product[part][c][from] -= pull[c][k], g.product[part][c][to] -= pull[3 + c][k];
    }
  }
}
template <class T>
void product(const Arrays<T>& a, T* const x[3], int threads) {
  const Gradients<T>& g = a.gradients;
  const auto share = [&](int part, int count) { return begin_of(part, threads, count); };
  in_parts(threads, a.sticks,
           [&](int part) { diagonal_product<T>(a, x, share(part, a.sticks), share(part + 1, a.sticks)); });
  in_parts(threads, a.sticks,
           [&](int part) { edge_product<T>(a, x, part, share(part, a.edges), share(part + 1, a.edges)); });
  if (threads > 1)
    in_parts(threads, a.sticks, [&](int part) {
      gather_parts<T>(g.product[0], g.product[1], share(part, a.sticks), share(part + 1, a.sticks));
    });
}

// Returns the sum of the dot products of the vectors `a` and `b` of the sticks `first` to `end` - 1.
template <class T>
T dots(T* const a[3], T* const b[3], int first, int end) {
  T sum = 0;
  for (int i = first; i < end; ++i) sum += dot(at(a, i), at(b, i));
  return sum;
}

// For the sticks `first` to `end` - 1, computes the residual r -= alpha * product[0] and the preconditioned
// residual z = inverse * r. Sets `rz` to the sum of r . z, and `rr` to the sum of r . r.
template <class T>
void advance_residual(const Arrays<T> a, T alpha, int first, int end, T& rz, T& rr) {
  const Gradients<T>& g = a.gradients;
  T sum_z = 0, sum_r = 0;
#pragma GCC ivdep
  for (int i = first; i < end; ++i) {
    const V<T> r = at(g.residual, i) - alpha * at(g.product[0], i), z = block_at(g.inverse, i) * r;
    put(g.residual, i, r);
    put(g.precond, i, z);
    sum_z += dot(r, z), sum_r += dot(r, r);
  }
  rz = sum_z, rr = sum_r;
}
// For the sticks `first` to `end` - 1, computes the solution x += alpha * way and then the new search
// direction way = z + beta * way.
template <class T>
void turn_way(const Arrays<T> a, T alpha, T beta, int first, int end) {
  const Gradients<T>& g = a.gradients;
#pragma GCC ivdep
  for (int i = first; i < end; ++i) {
    const V<T> way = at(g.way, i);
    put(g.change, i, at(g.change, i) + alpha * way);
    put(g.way, i, at(g.precond, i) + beta * way);
  }
}

constexpr int most_gradient_threads = 2;

// Advances the system by one backward Euler step. force[0] must contain the forces on the top masses. Returns
// the number of conjugate-gradient iterations.
template <class T>
long gradient_step(const Arrays<T>& a, const Constants<T>& p, const Course& course) {
  const Gradients<T>& g = a.gradients;
  const int threads = course.threads;
  const auto share = [&](int part) { return begin_of(part, threads, a.sticks); };
  T sum[2][most_gradient_threads];
  const auto total = [&](int row) {
    T all = 0;
    for (int part = 0; part < threads; ++part) all += sum[row][part];
    return all;
  };
  in_parts(threads, a.sticks, [&](int part) {
    for (int i = share(part); i < share(part + 1); ++i) {
      put(g.product[0], i, V<T>{0, 0, 0});
      for (int c = 0; c < 6; ++c) g.diagonal[0][c][i] = T(0);
    }
  });
  in_parts(threads, a.sticks, [&](int part) {
    edge_rows<T>(a, p, part, begin_of(part, threads, a.edges), begin_of(part + 1, threads, a.edges));
  });
  in_parts(threads, a.sticks, [&](int part) { stick_rows<T>(a, p, threads, share(part), share(part + 1)); });
  product<T>(a, g.change, threads);  // A x; the initial guess of x is the solution of the previous step
  in_parts(threads, a.sticks, [&](int part) {
    sum[1][part] = dots<T>(g.load, g.load, share(part), share(part + 1));
    for (int i = share(part); i < share(part + 1); ++i) put(g.residual, i, at(g.load, i));
  });
  const T enough = T(course.residual) * T(course.residual) * total(1);
  in_parts(threads, a.sticks, [&](int part) {
    advance_residual<T>(a, T(1), share(part), share(part + 1), sum[0][part], sum[1][part]);
    for (int i = share(part); i < share(part + 1); ++i) put(g.way, i, at(g.precond, i));
  });
  T rz = total(0), rr = total(1);
  long done = 0;
  for (; rr > enough && done < course.most_iterations; ++done) {
    product<T>(a, g.way, threads);
    in_parts(threads, a.sticks,
             [&](int part) { sum[0][part] = dots<T>(g.way, g.product[0], share(part), share(part + 1)); });
    const T alpha = rz / total(0);
    in_parts(threads, a.sticks, [&](int part) {
      advance_residual<T>(a, alpha, share(part), share(part + 1), sum[0][part], sum[1][part]);
    });
    const T next = total(0);
    rr = total(1);
    in_parts(threads, a.sticks,
             [&](int part) { turn_way<T>(a, alpha, next / rz, share(part), share(part + 1)); });
    rz = next;
  }
  in_parts(threads, a.sticks, [&](int part) {
    for (int i = share(part); i < share(part + 1); ++i) {
      const V<T> v = at(a.v, i) + at(g.change, i);
      put(a.v, i, v);
      put(a.q, i, at(a.q, i) + p.step * v);
    }
  });
  return done;
}
