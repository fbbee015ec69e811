// Large sparse systems of Laplace's kind: one unknown per vertex of a mesh, two right-hand sides.
#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

namespace pelage {

/// Solves A X = B by conjugate gradients, preconditioned by algebraic multigrid with smoothed aggregation
/// (Vanek, Mandel and Brezina 1996): time and memory grow with the number of unknowns, where a factorization
/// of A takes its 1.5th power. Systems of a few thousand unknowns are factored.
class LaplaceSolver {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

  /// A symmetric positive definite matrix, whole (both triangles), positive on its diagonal.
  explicit LaplaceSolver(Matrix matrix);

  /// Starts from the `x` given; stops when the residual is 1e-9 of `b` in norm. The number of iterations;
  /// empty when 300 leave more than 1e-5 of it.
  std::optional<int> solve(const Columns& b, Columns& x) const;

 private:
  struct Level {
    Matrix a, up, down;  ///< `up` interpolates from the next level to this one, `down` is its transpose
    Eigen::VectorXd diagonal;
  };
  Columns cycle(std::size_t level, const Columns& b) const;

  std::vector<Level> levels_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> coarsest_;
};

}  // namespace pelage
