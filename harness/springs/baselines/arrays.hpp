// What the serial rivals work on: the arrays of a plain C++ program, one column per component.
#pragma once
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Views of a system's arrays, without an owner: the loops are compiled with other flags than the rest, so
/// that nothing of theirs may end up in anybody else's code.
template <class T>
struct Arrays {
  int sticks = 0, edges = 0;
  const T *root[3]{}, *normal[3]{}, *phase_cos = nullptr, *phase_sin = nullptr;
  /// Shared prisms: the ends and rest length of each edge. Separable prisms: rest lengths only, those of side
  /// c of all triangles one after another; corner c of triangle f is stick c F + f.
  const int *from = nullptr, *to = nullptr;
  const T* rest = nullptr;
  T *q[3]{}, *v[3]{};          ///< the state
  T *force[3]{}, *work[12]{};  ///< shared prisms: room for the forces, and for RK4's stages
};

/// Steps of one call; moment 2 i is at the start of step i.
struct Course {
  Solver solver = default_solver;
  TopologyParams params{};
  const Moment* moments = nullptr;
  int steps = 0;
};

/// One way to compile the loops.
template <class T>
struct Loops {
  void (*sticks)(const Arrays<T>&, const Course&);     ///< all four solvers
  void (*triangles)(const Arrays<T>&, const Course&);  ///< separable prisms, the explicit three
  void (*prisms)(const Arrays<T>&, const Course&);     ///< shared prisms, the explicit three
};

/// -O3, and nothing else.
Loops<float> plain_loops(float);
Loops<double> plain_loops(double);
/// -O3 -march=native -ffast-math.
Loops<float> fast_loops(float);
Loops<double> fast_loops(double);
/// Whether this processor has what the machine that compiled them had.
bool fast_loops_run_here();

}  // namespace pelage::springs
