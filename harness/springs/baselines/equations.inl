// The equations of docs/springs.md in scalar C++. Each function computes one stick or one edge; the compiler
// may vectorize the loops that call it. Files that are compiled with special flags include this file inside
// an unnamed namespace.
#define PELAGE_INLINE \
  [[gnu::always_inline]] inline  // a function call in a loop would prevent its vectorization

template <class T>
struct V {
  T x, y, z;
};
template <class T>
PELAGE_INLINE V<T> operator+(V<T> a, V<T> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
PELAGE_INLINE V<T> operator-(V<T> a, V<T> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
PELAGE_INLINE V<T> operator*(T s, V<T> a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
PELAGE_INLINE T dot(V<T> a, V<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
PELAGE_INLINE V<T> cross(V<T> a, V<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
struct Constants {
  T length, mass, inverse_mass, stiffness, damping, edge_stiffness, edge_damping, drag, weight, step;
  bool moving;
};
template <class T>
PELAGE_INLINE Constants<T> constants(const TopologyParams& p) {
  return {T(p.length),       T(p.mass), T(1) / T(p.mass),   T(p.stiffness), T(p.damping), T(p.edge_stiffness),
          T(p.edge_damping), T(p.drag), T(p.return_weight), T(p.step),      p.moving != 0};
}

template <class T>
struct Outside {
  V<T> steady, gust, turn, turn_up;
  T gust_sin, gust_cos;
};
template <class T>
PELAGE_INLINE Outside<T> outside(const Moment& m) {
  return {{T(m.steady_x), T(m.steady_y), T(m.steady_z)},
          {T(m.gust_x), T(m.gust_y), T(m.gust_z)},
          {T(m.turn_x), T(m.turn_y), T(m.turn_z)},
          {T(m.turn_up_x), T(m.turn_up_y), T(m.turn_up_z)},
          T(m.gust_sin),
          T(m.gust_cos)};
}

template <class T>
struct Place {
  V<T> root, normal;
  T phase_cos, phase_sin;
};

template <class T>
struct Span {
  V<T> s;
  T length, inverse;
};
template <class T>
PELAGE_INLINE Span<T> span_of(V<T> d) {
  const T length = std::sqrt(dot(d, d)), inverse = T(1) / (length > T(1e-20) ? length : T(1e-20));
  return {inverse * d, length, inverse};
}

template <class T>
PELAGE_INLINE V<T> stick_force(const Constants<T>& p, const Outside<T>& t, const Place<T>& at, V<T> q,
                               V<T> v) {
  const Span<T> stick = span_of(q);
  V<T> f = t.steady + (t.gust_sin * at.phase_cos - t.gust_cos * at.phase_sin) * t.gust - p.drag * v;
  if (p.moving) {
    const V<T> r = at.root + q, carried = cross(t.turn, r);
    f = f - p.mass * (cross(t.turn_up, r) + cross(t.turn, carried + T(2) * v)) - p.drag * carried;
  }
  const T tension = p.stiffness * (stick.length - p.length) + p.damping * dot(v, stick.s);
  const T back = p.weight * (T(1) - dot(at.normal, stick.s));
  return f - tension * stick.s + back * (at.normal - stick.s);
}

template <class T>
PELAGE_INLINE V<T> edge_force(const Constants<T>& p, V<T> d, V<T> dv, T rest) {
  const Span<T> a = span_of(d);
  return (p.edge_stiffness * (a.length - rest) + p.edge_damping * dot(dv, a.s)) * a.s;
}

template <class T>
struct Symmetric {
  T xx, yy, zz, xy, xz, yz;
};
// a I + b s s^T + c t t^T
template <class T>
PELAGE_INLINE Symmetric<T> symmetric(T a, T b, V<T> s, T c, V<T> t) {
  return {a + b * s.x * s.x + c * t.x * t.x, a + b * s.y * s.y + c * t.y * t.y,
          a + b * s.z * s.z + c * t.z * t.z, b * s.x * s.y + c * t.x * t.y,
          b * s.x * s.z + c * t.x * t.z,     b * s.y * s.z + c * t.y * t.z};
}

// The equation of backward Euler for the top of a stick without edges: block * dv = load, where dv is the
// change of its velocity.
template <class T>
struct Row {
  Symmetric<T> block;
  V<T> load;
};
template <class T>
PELAGE_INLINE Row<T> stick_row(const Constants<T>& p, const Place<T>& at, V<T> q, V<T> v, V<T> force) {
  const T h = p.step, hhk = h * h * p.stiffness;
  const Span<T> stick = span_of(q);
  const T slack = T(1) - p.length * stick.inverse, across = hhk * (slack > T(0) ? slack : T(0));
  const T cosine = dot(at.normal, stick.s), back = h * h * p.weight * stick.inverse;
  const V<T> lean = at.normal - cosine * stick.s;
  const T even = across + back * (T(1) - cosine), stiff = hhk - across - back * (T(1) - cosine);
  const V<T> pulled = even * v + (stiff * dot(stick.s, v)) * stick.s + (back * dot(lean, v)) * lean;
  return {symmetric(p.mass + h * p.drag + even, stiff + h * p.damping, stick.s, back, lean),
          h * force - pulled};
}

// The terms that an edge (a spring between two tops) adds to the equations. The unit vector s points from its
// first end to its second end. The matrix even * I + along * s s^T, which is h^2 K plus a damping term, is
// added to the diagonal blocks of both ends and subtracted from the two blocks that couple the ends. `drawn`,
// which is h^2 K times the velocity of the second end relative to the first, is added to the right-hand side
// of the first end and subtracted from that of the second end. h is the time step, and K the edge's stiffness
// matrix.
template <class T>
struct Coupling {
  V<T> s, drawn;
  T even, along;
};
template <class T>
PELAGE_INLINE Coupling<T> coupling_of(const Constants<T>& p, V<T> d, V<T> dv, T rest) {
  const Span<T> a = span_of(d);
  const T hhk = p.step * p.step * p.edge_stiffness, slack = T(1) - rest * a.inverse;
  const T even = hhk * (slack > T(0) ? slack : T(0)), stiff = hhk - even;
  return {a.s, even * dv + (stiff * dot(a.s, dv)) * a.s, even, stiff + p.step * p.edge_damping};
}

// The factors of a symmetric 3 x 3 matrix m = L diag(d) L^T. L is a lower triangular matrix with ones on the
// diagonal.
template <class T>
struct Factors {
  T over_x, over_y, over_z;  // elements of 1 / d
  T yx, zx, zy;              // elements of L
};
template <class T>
PELAGE_INLINE Factors<T> factored(const Symmetric<T>& m) {
  const T over_x = T(1) / m.xx, yx = m.xy * over_x, zx = m.xz * over_x;
  const T over_y = T(1) / (m.yy - yx * m.xy), rest = m.yz - zx * m.xy, zy = rest * over_y;
  return {over_x, over_y, T(1) / (m.zz - zx * m.xz - zy * rest), yx, zx, zy};
}
template <class T>
PELAGE_INLINE V<T> solved(const Factors<T>& f, V<T> b) {
  const T y = b.y - f.yx * b.x, z = (b.z - f.zx * b.x - f.zy * y) * f.over_z, new_y = y * f.over_y - f.zy * z;
  return {b.x * f.over_x - f.yx * new_y - f.zx * z, new_y, z};
}
// Solves m x = b for a symmetric 3 x 3 matrix m.
template <class T>
PELAGE_INLINE V<T> solved(const Symmetric<T>& m, V<T> b) {
  return solved(factored(m), b);
}

template <class T>
PELAGE_INLINE V<T> operator*(const Symmetric<T>& m, V<T> a) {
  return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z,
          m.xz * a.x + m.yz * a.y + m.zz * a.z};
}
template <class T>
PELAGE_INLINE Symmetric<T> operator+(const Symmetric<T>& a, const Symmetric<T>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}
template <class T>
PELAGE_INLINE Symmetric<T> inverse(const Symmetric<T>& m) {
  const Factors<T> f = factored(m);
  const V<T> x = solved(f, V<T>{1, 0, 0}), y = solved(f, V<T>{0, 1, 0}), z = solved(f, V<T>{0, 0, 1});
  return {x.x, y.y, z.z, x.y, x.z, y.z};
}

// A 3 x 3 matrix, stored by columns.
template <class T>
struct Matrix {
  V<T> x, y, z;
};
template <class T>
PELAGE_INLINE Matrix<T> columns(const Symmetric<T>& m) {
  return {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
}
template <class T>
PELAGE_INLINE Matrix<T> solved(const Factors<T>& f, const Matrix<T>& m) {
  return {solved(f, m.x), solved(f, m.y), solved(f, m.z)};
}
template <class T>
PELAGE_INLINE V<T> operator*(const Matrix<T>& m, V<T> a) {
  return a.x * m.x + a.y * m.y + a.z * m.z;
}
template <class T>
PELAGE_INLINE V<T> transposed_times(const Matrix<T>& m, V<T> a) {
  return {dot(m.x, a), dot(m.y, a), dot(m.z, a)};
}
// Returns the matrix a - b^T c. The caller ensures that this matrix is symmetric.
template <class T>
PELAGE_INLINE Symmetric<T> less_product(const Symmetric<T>& a, const Matrix<T>& b, const Matrix<T>& c) {
  return {a.xx - dot(b.x, c.x), a.yy - dot(b.y, c.y), a.zz - dot(b.z, c.z),
          a.xy - dot(b.x, c.y), a.xz - dot(b.x, c.z), a.yz - dot(b.y, c.z)};
}

// Solves the nine equations of a separable prism by block elimination. row[c] is the equation of the top at
// corner c. side[c] is -1 times the 3 x 3 block that couples corner c to corner (c + 1) mod 3.
template <class T>
PELAGE_INLINE void solve_triangle(const Row<T> row[3], const Symmetric<T> side[3], V<T> change[3]) {
  const Matrix<T> m01 = columns(side[0]), m12 = columns(side[1]), m02 = columns(side[2]);
  const Factors<T> f0 = factored(row[0].block);
  const Matrix<T> n01 = solved(f0, m01), n02 = solved(f0, m02);
  const Factors<T> f1 = factored(less_product(row[1].block, m01, n01));
  const Matrix<T> left = {m12.x + side[0] * n02.x, m12.y + side[0] * n02.y, m12.z + side[0] * n02.z};
  const Matrix<T> n12 = solved(f1, left);
  const Factors<T> f2 = factored(less_product(less_product(row[2].block, m02, n02), left, n12));
  const V<T> load1 = row[1].load + transposed_times(n01, row[0].load);
  const V<T> load2 = row[2].load + transposed_times(n02, row[0].load) + transposed_times(n12, load1);
  change[2] = solved(f2, load2);
  change[1] = solved(f1, load1) + n12 * change[2];
  change[0] = solved(f0, row[0].load) + (n01 * change[1] + n02 * change[2]);
}
