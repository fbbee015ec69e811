// Backward Euler by Eigen 3.4, compiled -O3 -march=native: what a program with a good library would do.
#pragma once
#include <memory>

#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

enum class EigenWay {
  blocks,              ///< Matrix<T, 9, 9> and LLT, triangle by triangle: separable prisms only
  ldlt,                ///< SimplicialLDLT, analysed once
  gradients_diagonal,  ///< ConjugateGradient over RowMajor, Lower | Upper, preconditioned by the diagonal,
  gradients_block,     ///< by the inverses of the 3 x 3 blocks on it,
  gradients_cholesky   ///< by an incomplete Cholesky factorization
};

/// A system in motion. State: three values per stick, one stick after another; separable prisms in their own
/// order.
template <class T>
class EigenSolver {
 public:
  virtual ~EigenSolver() = default;
  virtual T* q() = 0;
  virtual T* v() = 0;
  virtual void forget() = 0;  ///< the change that conjugate gradients start from
  virtual void step(const TopologyParams& params, const Moment& end) = 0;  ///< end: of the step
  virtual long iterations() const = 0;  ///< of conjugate gradients, since the start
};

/// Plain arrays: roots, normals (three each), phases (cosine, sine) per stick; edges as pairs of sticks.
template <class T>
struct EigenSystem {
  int sticks = 0, edges = 0;
  const T *root = nullptr, *normal = nullptr, *phase = nullptr, *rest = nullptr;
  const int* ends = nullptr;
};

/// Copies the system. `threads` of OpenMP; residual: |r| / |b| at which conjugate gradients stop.
std::unique_ptr<EigenSolver<float>> eigen_solver(const EigenSystem<float>& system, EigenWay way, int threads,
                                                 double residual);
std::unique_ptr<EigenSolver<double>> eigen_solver(const EigenSystem<double>& system, EigenWay way,
                                                  int threads, double residual);

}  // namespace pelage::springs
