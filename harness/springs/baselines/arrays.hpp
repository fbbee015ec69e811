// Arrays of the serial baselines: one array per vector component, as in a plain C++ program.
#pragma once
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Pointers to the arrays of a system; the struct owns no memory. The loops use no library types. They are
/// compiled with special flags, and library functions compiled with these flags must not be linked into the
/// rest of the program.
template <class T>
struct Arrays {
  int sticks = 0, edges = 0;
  const T *root[3]{}, *normal[3]{}, *phase_cos = nullptr, *phase_sin = nullptr;
  /// Shared prisms: the two sticks and the rest length of each edge. Separable prisms: rest lengths only;
  /// rest[c F + f] belongs to side c of triangle f, and corner c of triangle f is stick c F + f.
  const int *from = nullptr, *to = nullptr;
  const T* rest = nullptr;
  T *q[3]{}, *v[3]{};          ///< the state: top mass relative to its base (R), velocity (R/s)
  T *force[3]{}, *work[12]{};  ///< shared prisms only: the forces, and the work arrays of RK4
};

/// The time steps of one call. moments[2 i] is the environment at the start of step i.
struct Course {
  Solver solver = default_solver;
  TopologyParams params{};
  const Moment* moments = nullptr;
  int steps = 0;
};

/// The loops as compiled with one set of compiler flags, one function per kind of topology.
template <class T>
struct Loops {
  void (*sticks)(const Arrays<T>&, const Course&);     ///< all four solvers
  void (*triangles)(const Arrays<T>&, const Course&);  ///< separable prisms, explicit solvers only
  void (*prisms)(const Arrays<T>&, const Course&);     ///< shared prisms, explicit solvers only
};

/// The loops compiled with -O3 only. The argument selects the number type.
Loops<float> plain_loops(float);
Loops<double> plain_loops(double);
/// The loops compiled with -O3 -march=native -ffast-math. The argument selects the number type.
Loops<float> fast_loops(float);
Loops<double> fast_loops(double);
/// Returns whether this processor supports the vector instructions (AVX2, AVX-512F) that fast_loops uses.
bool fast_loops_run_here();

}  // namespace pelage::springs
