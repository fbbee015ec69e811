// The arrays of the serial C++ solvers, which are baselines of the OpenCL solvers. Each component of a vector
// has its own array. Lengths are in R, the radius of the mesh's bounding sphere. Shared prisms are the
// topology in which adjacent prisms share their sticks. Separable prisms are the topology in which each prism
// has its own three sticks.
#pragma once
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Pointers to the arrays of the conjugate-gradient solver. Backward Euler on shared prisms uses this solver
/// for its linear equations A x = b. Each component of a vector and each element of a matrix has its own
/// array. A symmetric 3 x 3 matrix has the elements xx, yy, zz, xy, xz and yz. The first index of `product`
/// and `diagonal` is the thread (0 or 1), because both threads add terms of edges at the same time. The
/// arrays of thread 1 are then added to those of thread 0 and set to 0.
template <class T>
struct Gradients {
  T *change[3]{}, *load[3]{}, *residual[3]{}, *precond[3]{},
      *way[3]{};                       ///< x, b, r = b - A x, preconditioned r, search direction d
  T* product[2][3]{};                  ///< A d
  T *diagonal[2][6]{}, *inverse[6]{};  ///< 3 x 3 diagonal blocks of A, and their inverses
  T* coupling[4]{};  ///< for each edge, `even` and the vector g; the edge's block of A is -(even I + g g^T)
};

/// Pointers to the arrays of a system; the struct owns no memory. fast_loops.cpp is compiled with
/// -march=native and -ffast-math. This struct and the loops in loops.inl therefore use no types of the
/// standard library. Otherwise the compiler would compile inline functions of the standard library with these
/// flags, and the linker could use the compiled functions in files that are compiled without these flags.
template <class T>
struct Arrays {
  int sticks = 0, edges = 0;
  T *root[3]{}, *normal[3]{}, *phase_cos = nullptr, *phase_sin = nullptr;
  /// An edge is a spring between two top masses. On shared prisms, `from` and `to` hold the indices of the
  /// two sticks of each edge, and `rest` holds the edge's rest length in R. Separable prisms do not use
  /// `from` and `to`. Separable prisms on F triangles have 3 F sticks: stick c*F+f belongs to corner c of
  /// triangle f. rest[c*F+f] is the rest length of the edge between corners c and (c + 1) % 3 of triangle f.
  const int *from = nullptr, *to = nullptr;
  T* rest = nullptr;
  T *q[3]{}, *v[3]{};  ///< state: top mass relative to its base (R), velocity of the top mass (R/s)
  /// Only for shared prisms: the forces on the top masses, and work arrays of RK4. The second thread adds its
  /// forces to force[1], which contains zeros between two steps.
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

/// Functions that advance the state by the steps of a Course, one function per kind of topology. All
/// functions of one instance of Loops are compiled with the same compiler flags.
template <class T>
struct Loops {
  /// Advances the topologies sticks and separable-sticks by the steps of `Course` with any of the four
  /// solvers. Neither topology has springs between top masses.
  void (*sticks)(const Arrays<T>&, const Course&);
  /// Advances separable prisms by the steps of `Course` with any of the four solvers.
  void (*triangles)(const Arrays<T>&, const Course&);
  /// Advances shared prisms by the steps of `Course` with any of the four solvers. Returns the number of
  /// conjugate-gradient iterations.
  long (*prisms)(const Arrays<T>&, const Course&);
};

/// Returns the functions of loops.inl, compiled with -O3 and without further optimization flags. The
/// argument's type selects the number type; its value is ignored.
Loops<float> plain_loops(float);
Loops<double> plain_loops(double);
/// Returns the functions of loops.inl, compiled with -O3 -march=native -ffast-math. The argument's type
/// selects the number type; its value is ignored.
Loops<float> fast_loops(float);
Loops<double> fast_loops(double);
/// Returns whether this processor supports the vector instructions (AVX2, AVX-512F) that fast_loops uses.
bool fast_loops_run_here();

}  // namespace pelage::springs
