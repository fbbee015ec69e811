#include "harness/mesh/laplace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pelage {
namespace {

constexpr Eigen::Index direct_unknowns = 6000;
constexpr double strong = 0.02;      // i and j are strongly connected if |a_ij| > strong * sqrt(a_ii a_jj)
constexpr double damping = 2.0 / 3;  // damping of the Jacobi step that smooths the interpolation
constexpr double good = 1e-9, usable = 1e-5;
constexpr int most_iterations = 300;

using Matrix = LaplaceSolver::Matrix;
using Columns = LaplaceSolver::Columns;
constexpr int no_group = -1;

bool joined(const Eigen::VectorXd& diagonal, Eigen::Index i, Eigen::Index j, double value) {
  return j != i && value * value > strong * strong * diagonal[i] * diagonal[j];
}

// Partitions the unknowns into groups of strongly connected neighbours. Returns the group of each unknown,
// and adds the number of groups to `count`, which is 0 before.
std::vector<int> aggregates(const Matrix& a, const Eigen::VectorXd& diagonal, int& count) {
  std::vector<int> group(std::size_t(a.rows()), no_group);
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    bool free = group[std::size_t(i)] == no_group;
    for (Matrix::InnerIterator at(a, i); free && at; ++at)
      free = !joined(diagonal, i, at.col(), at.value()) || group[std::size_t(at.col())] == no_group;
    if (!free) continue;
    group[std::size_t(i)] = count;
    for (Matrix::InnerIterator at(a, i); at; ++at)
      if (joined(diagonal, i, at.col(), at.value())) group[std::size_t(at.col())] = count;
    ++count;
  }
  const std::vector<int> first = group;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    if (group[std::size_t(i)] != no_group) continue;
    double most = 0;
    for (Matrix::InnerIterator at(a, i); at; ++at) {
      if (first[std::size_t(at.col())] == no_group || !joined(diagonal, i, at.col(), at.value())) continue;
      if (std::abs(at.value()) > most)
        most = std::abs(at.value()), group[std::size_t(i)] = first[std::size_t(at.col())];
    }
  }
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    if (group[std::size_t(i)] != no_group) continue;
    group[std::size_t(i)] = count;
    for (Matrix::InnerIterator at(a, i); at; ++at)
      if (group[std::size_t(at.col())] == no_group && joined(diagonal, i, at.col(), at.value()))
        group[std::size_t(at.col())] = count;
    ++count;
  }
  return group;
}

// Returns the matrix that interpolates one value per group to one value per unknown. The interpolation is
// constant over each group and is then smoothed by a damped Jacobi step.
Matrix interpolation(const Matrix& a, const Eigen::VectorXd& diagonal, const std::vector<int>& group,
                     int count) {
  Matrix step(a.rows(), count);
  std::vector<std::pair<int, double>> row;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    row.assign(1, {group[std::size_t(i)], 1.0});
    for (Matrix::InnerIterator at(a, i); at; ++at)
      row.emplace_back(group[std::size_t(at.col())], -damping * at.value() / diagonal[i]);
    std::sort(row.begin(), row.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    step.startVec(i);
    for (std::size_t first = 0, last; first < row.size(); first = last) {
      double sum = 0;
      for (last = first; last < row.size() && row[last].first == row[first].first; ++last)
        sum += row[last].second;
      step.insertBack(i, row[first].first) = sum;
    }
  }
  step.finalize();
  return step;
}

// Improves the solution `x` of a x = b by one Gauss-Seidel sweep, in ascending or descending order of the
// unknowns.
void sweep(const Matrix& a, const Eigen::VectorXd& diagonal, const Columns& b, Columns& x, bool ascending) {
  for (Eigen::Index k = 0; k < a.rows(); ++k) {
    const Eigen::Index i = ascending ? k : a.rows() - 1 - k;
    double u = b(i, 0), v = b(i, 1);
    for (Matrix::InnerIterator at(a, i); at; ++at) {
      u -= at.value() * x(at.col(), 0);
      v -= at.value() * x(at.col(), 1);
    }
    x(i, 0) += u / diagonal[i];
    x(i, 1) += v / diagonal[i];
  }
}

}  // namespace

LaplaceSolver::LaplaceSolver(Matrix matrix) {
  matrix.makeCompressed();
  for (;;) {
    Level level;
    level.a.swap(matrix);
    level.diagonal = level.a.diagonal();
    int count = 0;
    std::vector<int> group;
    if (level.a.rows() > direct_unknowns) group = aggregates(level.a, level.diagonal, count);
    const bool last = group.empty() || double(count) > 0.8 * double(level.a.rows());
    if (!last) {
      level.up = interpolation(level.a, level.diagonal, group, count);
      level.down = level.up.transpose();
      const Matrix half = level.a * level.up;
      matrix = level.down * half;
    }
    levels_.push_back(std::move(level));
    if (last) break;
  }
  coarsest_.compute(Eigen::SparseMatrix<double>(levels_.back().a));
}

LaplaceSolver::Columns LaplaceSolver::cycle(std::size_t number, const Columns& b) const {
  const Level& level = levels_[number];
  if (number + 1 == levels_.size()) return coarsest_.solve(b);
  Columns x = Columns::Zero(b.rows(), b.cols());
  sweep(level.a, level.diagonal, b, x, true);
  const Columns rest = b - level.a * x;
  const Columns below = level.down * rest;
  x += level.up * cycle(number + 1, below);
  sweep(level.a, level.diagonal, b, x, false);
  return x;
}

std::optional<int> LaplaceSolver::solve(const Columns& b, Columns& x) const {
  if (coarsest_.info() != Eigen::Success) return {};
  if (levels_.size() == 1) {
    x = coarsest_.solve(b);
    return x.allFinite() ? std::optional(0) : std::nullopt;
  }
  const Eigen::Array2d size = b.colwise().norm().transpose().array().max(std::numeric_limits<double>::min());
  Columns rest = b - levels_.front().a * x;
  Columns z = cycle(0, rest), p = z;
  Eigen::Array2d rz = rest.cwiseProduct(z).colwise().sum().transpose().array();
  for (int iterations = 0;; ++iterations) {
    const double left = (rest.colwise().norm().transpose().array() / size).maxCoeff();
    if (!(left > good) || iterations == most_iterations)
      return left <= usable && x.allFinite() ? std::optional(iterations) : std::nullopt;
    const Columns ap = levels_.front().a * p;
    const Eigen::Array2d pap = p.cwiseProduct(ap).colwise().sum().transpose().array();
    const Eigen::Array2d alpha = (pap > 0).select(rz / pap, 0.0);
    x += p * alpha.matrix().asDiagonal();
    rest -= ap * alpha.matrix().asDiagonal();
    z = cycle(0, rest);
    const Eigen::Array2d next = rest.cwiseProduct(z).colwise().sum().transpose().array();
    const Eigen::Array2d beta = (rz > 0).select(next / rz, 0.0);
    p = (z + p * beta.matrix().asDiagonal()).eval();
    rz = next;
  }
}

}  // namespace pelage
