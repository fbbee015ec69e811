// The arrays of the serial C++ solvers. Each component of a vector and each element of a matrix has its own
// array. Lengths are in R.
#pragma once
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// The arrays of conjugate gradients, which solve A x = b for backward Euler on the topology prisms. A
/// symmetric 3 x 3 matrix has the elements xx, yy, zz, xy, xz and yz. The first index of `product` and
/// `diagonal` is the thread (0 or 1), because both threads add terms of edges at the same time. The arrays of
/// thread 1 are then added to those of thread 0 and set to 0.
template <class T>
struct Gradients {
  T *change[3]{}, *load[3]{}, *residual[3]{}, *precond[3]{},
      *way[3]{};                       ///< x, b, r = b - A x, preconditioned r, search direction d
  T* product[2][3]{};                  ///< A d
  T *diagonal[2][6]{}, *inverse[6]{};  ///< 3 x 3 diagonal blocks of A, and their inverses
  T* coupling[4]{};  ///< for each edge, `even` and the vector g; the edge's block of A is -(even I + g g^T)
};

/// Pointers to the arrays of a system. This struct and loops.inl use no types of the standard library,
/// because fast_loops.cpp is compiled with -march=native and -ffast-math: the linker could use its copies of
/// the library's inline functions in other files.
template <class T>
struct Arrays {
  int sticks = 0, edges = 0;
  T *root[3]{}, *normal[3]{}, *phase_cos = nullptr, *phase_sin = nullptr;
  /// An edge is a spring between two tops. On prisms, `from` and `to` hold its two sticks, and `rest` its
  /// rest length. Separable prisms on F triangles have no `from` and `to`: stick c*F+f belongs to corner c of
  /// triangle f, and rest[c*F+f] is the rest length between corners c and (c + 1) % 3 of triangle f.
  const int *from = nullptr, *to = nullptr;
  T* rest = nullptr;
  T *q[3]{}, *v[3]{};  ///< state: top mass relative to its base (R), velocity of the top mass (R/s)
  /// Only for prisms: the forces on the tops, and work arrays of RK4. The second thread adds its forces to
  /// force[1], which contains zeros between two steps.
  T *force[2][3]{}, *work[12]{};
  Gradients<T> gradients;
};

/// The time steps that one call of a function of Loops computes. moments[2 * i] holds wind, gravity and the
/// object's motion at the start of step i.
struct Course {
  Solver solver = default_solver;
  TopologyParams params{};
  const Moment* moments = nullptr;
  int steps = 0;
  int threads = 1;            ///< 1 or 2
  double residual = 1e-5;     ///< conjugate gradients stop at this relative residual |r| / |b|
  int most_iterations = 500;  ///< largest number of conjugate gradient iterations per step
};

/// Functions that advance the state by the steps of a Course, with any of the four solvers.
template <class T>
struct Loops {
  void (*sticks)(const Arrays<T>&, const Course&);     ///< topologies sticks and separable-sticks
  void (*triangles)(const Arrays<T>&, const Course&);  ///< separable-prisms
  long (*prisms)(const Arrays<T>&, const Course&);     ///< returns the number of iterations
};

/// Returns the functions of loops.inl, compiled with -O3: plain_loops() without, and fast_loops() with
/// -march=native -ffast-math. The argument's type selects the number type; its value is ignored.
Loops<float> plain_loops(float);
Loops<double> plain_loops(double);
Loops<float> fast_loops(float);
Loops<double> fast_loops(double);
/// Returns whether this processor supports the vector instructions (AVX2, AVX-512F) that fast_loops uses.
bool fast_loops_run_here();

}  // namespace pelage::springs
