// Solves large sparse systems with Laplacian matrices: one unknown per vertex of a mesh, two right-hand
// sides.
#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

namespace pelage {

/// Solves A X = B by conjugate gradients. The preconditioner is algebraic multigrid with smoothed aggregation
/// (Vanek, Mandel and Brezina 1996). Time and memory grow linearly with the number of unknowns n, whereas the
/// time of a factorization grows as n^1.5. Systems of at most 6000 unknowns are solved by a factorization
/// instead.
class LaplaceSolver {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

  /// `matrix` is symmetric and positive definite; its upper and its lower triangle are both stored.
  explicit LaplaceSolver(Matrix matrix);

  /// Solves for `x`. The value of `x` before the call is the initial guess. Iterates until the ratio of the
  /// norm of the residual to the norm of `b` is at most 1e-9. Returns the number of iterations, or nothing if
  /// this ratio is above 1e-5 after 300 iterations.
  std::optional<int> solve(const Columns& b, Columns& x) const;

 private:
  struct Level {
    Matrix a, up, down;  ///< `up` interpolates from the next coarser level; `down` is the transpose of `up`
    Eigen::VectorXd diagonal;
  };
  Columns cycle(std::size_t level, const Columns& b) const;

  std::vector<Level> levels_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> coarsest_;
};

}  // namespace pelage
