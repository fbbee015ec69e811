// Baselines that compute backward Euler with the library Eigen 3.4, compiled with -O3 -march=native.
#pragma once
#include <memory>

#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

enum class EigenWay {
  blocks,              ///< LLT of one Matrix<T, 9, 9> per triangle; only on separable prisms
  ldlt,                ///< SimplicialLDLT; the sparsity pattern is analysed once
  gradients_diagonal,  ///< ConjugateGradient (RowMajor, Lower | Upper) with DiagonalPreconditioner
  gradients_block,     ///< ConjugateGradient, preconditioned by the inverses of the 3 x 3 diagonal blocks
  gradients_cholesky   ///< ConjugateGradient, preconditioned by IncompleteCholesky
};

/// A solver of one mass-spring system, and the state of the system. The state arrays hold three values per
/// stick, in the order of the topology's sticks.
template <class T>
class EigenSolver {
 public:
  virtual ~EigenSolver() = default;
  virtual T* q() = 0;
  virtual T* v() = 0;
  virtual void forget() = 0;  ///< resets the initial guess of conjugate gradients to 0
  /// Advances the state by one step. `end` holds wind, gravity and the object's motion at the end of the
  /// step.
  virtual void step(const TopologyParams& params, const Moment& end) = 0;
  virtual long iterations() const = 0;  ///< number of conjugate gradient iterations so far
};

/// A mass-spring system as plain arrays. Each stick has a root (3 values, in R), a normal (3 values), and the
/// cosine and sine of the gust's phase (2 values). Each edge has the indices of its two sticks (`ends`) and a
/// rest length in R.
template <class T>
struct EigenSystem {
  int sticks = 0, edges = 0;
  const T *root = nullptr, *normal = nullptr, *phase = nullptr, *rest = nullptr;
  const int* ends = nullptr;
};

/// Returns a solver that holds a copy of the system and uses `threads` OpenMP threads. Conjugate gradients
/// stop when |r| / |b| is at most `residual`, where r is the residual and b is the right-hand side of the
/// linear equations.
std::unique_ptr<EigenSolver<float>> eigen_solver(const EigenSystem<float>& system, EigenWay way, int threads,
                                                 double residual);
std::unique_ptr<EigenSolver<double>> eigen_solver(const EigenSystem<double>& system, EigenWay way,
                                                  int threads, double residual);

}  // namespace pelage::springs
