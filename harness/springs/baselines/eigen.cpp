// This file is compiled with -march=native; other files of pelage must run on any processor. The macro
// renames the namespace, so that the linker does not let other files call the functions of Eigen of this
// file.
#define Eigen pelage_native_eigen
#include "harness/springs/baselines/eigen.hpp"

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <cmath>

namespace pelage::springs {
namespace {
#include "harness/springs/baselines/equations.inl"

template <class T>
using Values = Eigen::Matrix<T, Eigen::Dynamic, 1>;
using Numbers = Eigen::Matrix<int, Eigen::Dynamic, 1>;
template <class T>
using Sparse = Eigen::SparseMatrix<T, Eigen::RowMajor>;

template <class T>
V<T> at(const Values<T>& values, int i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}
template <class T>
void put(Values<T>& values, int i, V<T> a) {
  values[3 * i] = a.x, values[3 * i + 1] = a.y, values[3 * i + 2] = a.z;
}
template <class T>
Eigen::Matrix<T, 3, 3> matrix(const Symmetric<T>& m) {
  Eigen::Matrix<T, 3, 3> a;
  a << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return a;
}

// A preconditioner for Eigen: the inverses of the 3 x 3 blocks on the diagonal.
template <class T>
class BlockJacobi {
 public:
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic };
  BlockJacobi() = default;
  template <class M>
  explicit BlockJacobi(const M& m) {
    compute(m);
  }
  Eigen::Index rows() const { return inverse_.rows(); }
  Eigen::Index cols() const { return inverse_.rows(); }
  template <class M>
  BlockJacobi& analyzePattern(const M&) {
    return *this;
  }
  template <class M>
  BlockJacobi& factorize(const M& m) {
    return compute(m);
  }
  template <class M>
  BlockJacobi& compute(const M& m) {
    inverse_.resize(m.rows(), 3);
    for (Eigen::Index i = 0; i < m.rows(); i += 3) {
      Eigen::Matrix<T, 3, 3> block;
      const auto* inner = m.innerIndexPtr() + m.outerIndexPtr()[i];
      int slot = 0;
      while (inner[slot] != i) slot += 3;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) block(r, c) = m.valuePtr()[m.outerIndexPtr()[i + r] + slot + c];
      inverse_.template middleRows<3>(i) = block.inverse();
    }
    return *this;
  }
  template <class B>
  Values<T> solve(const B& b) const {
    Values<T> x(b.size());
    for (Eigen::Index i = 0; i < b.size(); i += 3)
      x.template segment<3>(i).noalias() = inverse_.template middleRows<3>(i) * b.template segment<3>(i);
    return x;
  }
  Eigen::ComputationInfo info() const { return Eigen::Success; }

 private:
  Eigen::Matrix<T, Eigen::Dynamic, 3, Eigen::RowMajor> inverse_;
};

template <class T>
class Base : public EigenSolver<T> {
 public:
  Base(const EigenSystem<T>& s, int threads)
      : sticks_(s.sticks),
        edges_(s.edges),
        threads_(threads),
        root_(Eigen::Map<const Values<T>>(s.root, 3 * s.sticks)),
        normal_(Eigen::Map<const Values<T>>(s.normal, 3 * s.sticks)),
        phase_(Eigen::Map<const Values<T>>(s.phase, 2 * s.sticks)),
        rest_(Eigen::Map<const Values<T>>(s.rest, s.edges)),
        ends_(Eigen::Map<const Numbers>(s.ends, 2 * s.edges)),
        q_(3 * s.sticks),
        v_(3 * s.sticks) {}
  T* q() override { return q_.data(); }
  T* v() override { return v_.data(); }
  void forget() override {}
  long iterations() const override { return 0; }

 protected:
  Place<T> place(int i) const { return {at(root_, i), at(normal_, i), phase_[2 * i], phase_[2 * i + 1]}; }
  V<T> apart(int from, int to) const {
    return (at(root_, to) - at(root_, from)) + (at(q_, to) - at(q_, from));
  }
  int sticks_, edges_, threads_;
  Values<T> root_, normal_, phase_, rest_;
  Numbers ends_;
  Values<T> q_, v_;
};

template <class T>
class Blocks : public Base<T> {
 public:
  using Base<T>::Base;
  void step(const TopologyParams& params, const Moment& end) override {
    const Constants<T> p = constants<T>(params);
    const Outside<T> t = outside<T>(end);
    const int triangles = this->sticks_ / 3;
#pragma omp parallel for num_threads(this->threads_) if (this->threads_ > 1)
    for (int f = 0; f < triangles; ++f) triangle(p, t, f);
  }

 private:
  void triangle(const Constants<T>& p, const Outside<T>& t, int f) {
    Eigen::Matrix<T, 9, 9> m = Eigen::Matrix<T, 9, 9>::Zero();
    Eigen::Matrix<T, 9, 1> load;
    V<T> force[3];
    for (int c = 0; c < 3; ++c)
      force[c] = stick_force(p, t, this->place(3 * f + c), at(this->q_, 3 * f + c), at(this->v_, 3 * f + c));
    for (int c = 0; c < 3; ++c) {
      const int to = (c + 1) % 3, i = 3 * f + c, j = 3 * f + to;
      const V<T> d = this->apart(i, j), dv = at(this->v_, j) - at(this->v_, i);
      const V<T> pull = edge_force(p, d, dv, this->rest_[i]);
      force[c] = force[c] + pull;
      force[to] = force[to] - pull;
    }
    for (int c = 0; c < 3; ++c) {
      const int i = 3 * f + c;
      const Row<T> row = stick_row(p, this->place(i), at(this->q_, i), at(this->v_, i), force[c]);
      m.template block<3, 3>(3 * c, 3 * c) = matrix(row.block);
      load.template segment<3>(3 * c) << row.load.x, row.load.y, row.load.z;
    }
    for (int c = 0; c < 3; ++c) {
      const int to = (c + 1) % 3, i = 3 * f + c, j = 3 * f + to;
      const Coupling<T> k =
          coupling_of(p, this->apart(i, j), at(this->v_, j) - at(this->v_, i), this->rest_[i]);
      const Eigen::Matrix<T, 3, 3> block = matrix(symmetric(k.even, k.along, k.s, T(0), k.s));
      m.template block<3, 3>(3 * c, 3 * c) += block;
      m.template block<3, 3>(3 * to, 3 * to) += block;
      m.template block<3, 3>(3 * c, 3 * to) -= block;
      m.template block<3, 3>(3 * to, 3 * c) -= block;
      const Eigen::Matrix<T, 3, 1> drawn(k.drawn.x, k.drawn.y, k.drawn.z);
      load.template segment<3>(3 * c) += drawn;
      load.template segment<3>(3 * to) -= drawn;
    }
    const Eigen::Matrix<T, 9, 1> change = m.llt().solve(load);
    auto v = this->v_.template segment<9>(9 * f);
    v += change;
    this->q_.template segment<9>(9 * f) += p.step * v;
  }
};

// Solves the equations of all sticks as one sparse system. The sparsity pattern is computed once. The
// matrix consists of 3 x 3 blocks, and each stick has one row of blocks. In each step, threads compute the
// rows of blocks in parallel, because the rows do not depend on each other.
template <class T, class Solver>
class Whole : public Base<T> {
 public:
  Whole(const EigenSystem<T>& s, int threads, double residual)
      : Base<T>(s, threads),
        first_(Numbers::Zero(s.sticks + 1)),
        load_(3 * s.sticks),
        change_(Values<T>::Zero(3 * s.sticks)) {
    lay_out();
    if constexpr (iterative) solver_.setTolerance(T(residual));
    solver_.analyzePattern(matrix_);
  }
  void forget() override { change_.setZero(); }
  long iterations() const override { return iterations_; }
  void step(const TopologyParams& params, const Moment& end) override {
    const Constants<T> p = constants<T>(params);
    const Outside<T> t = outside<T>(end);
    Eigen::setNbThreads(this->threads_);
#pragma omp parallel for num_threads(this->threads_) if (this->threads_ > 1)
    for (int i = 0; i < this->sticks_; ++i) row(p, t, i);
    solver_.factorize(matrix_);
    if constexpr (iterative) {
      change_ = solver_.solveWithGuess(load_, change_);
      iterations_ += long(solver_.iterations());
    } else {
      change_ = solver_.solve(load_);
    }
    this->v_ += change_;
    this->q_ += p.step * this->v_;
  }

 private:
  static constexpr bool iterative = requires(Solver s) {
    s.setTolerance(T(0));
  };

  // Computes the sparsity pattern: for each row of blocks, the columns of its blocks in ascending order, and
  // the edge to which each block belongs (-1 for the diagonal block).
  void lay_out() {
    for (int e = 0; e < this->edges_; ++e)
      ++first_[this->ends_[2 * e] + 1], ++first_[this->ends_[2 * e + 1] + 1];
    for (int i = 0; i < this->sticks_; ++i) first_[i + 1] += first_[i] + 1;
    column_.resize(first_[this->sticks_]), edge_.resize(first_[this->sticks_]);
    Numbers filled = first_;
    const auto insert = [&](int i, int column, int edge) {
      int k = filled[i]++;
      for (; k > first_[i] && column_[k - 1] > column; --k)
        column_[k] = column_[k - 1], edge_[k] = edge_[k - 1];
      column_[k] = column, edge_[k] = edge;
    };
    for (int i = 0; i < this->sticks_; ++i) insert(i, i, -1);
    for (int e = 0; e < this->edges_; ++e) {
      insert(this->ends_[2 * e], this->ends_[2 * e + 1], e);
      insert(this->ends_[2 * e + 1], this->ends_[2 * e], e);
    }
    matrix_.resize(3 * this->sticks_, 3 * this->sticks_);
    matrix_.resizeNonZeros(9 * Eigen::Index(column_.size()));
    for (int i = 0; i < this->sticks_; ++i) {
      const int width = first_[i + 1] - first_[i];
      for (int r = 0; r < 3; ++r) {
        const int begin = 9 * first_[i] + 3 * width * r;
        matrix_.outerIndexPtr()[3 * i + r] = begin;
        for (int k = 0; k < width; ++k)
          for (int c = 0; c < 3; ++c) {
            matrix_.innerIndexPtr()[begin + 3 * k + c] = 3 * column_[first_[i] + k] + c;
            matrix_.valuePtr()[begin + 3 * k + c] = r == c && column_[first_[i] + k] == i ? T(1) : T(0);
          }
      }
    }
    matrix_.outerIndexPtr()[3 * this->sticks_] = 9 * int(column_.size());
  }

  void row(const Constants<T>& p, const Outside<T>& t, int i) {
    const V<T> v = at(this->v_, i);
    V<T> force = stick_force(p, t, this->place(i), at(this->q_, i), v);
    const int width = first_[i + 1] - first_[i];
    T* rows[3];
    for (int r = 0; r < 3; ++r) rows[r] = matrix_.valuePtr() + 9 * first_[i] + 3 * width * r;
    Eigen::Matrix<T, 3, 3> own = Eigen::Matrix<T, 3, 3>::Zero();
    V<T> drawn{0, 0, 0};
    int own_slot = 0;
    for (int k = 0; k < width; ++k) {
      const int j = column_[first_[i] + k], e = edge_[first_[i] + k];
      if (e < 0) {
        own_slot = k;
        continue;
      }
      const V<T> d = this->apart(i, j), dv = at(this->v_, j) - v;
      force = force + edge_force(p, d, dv, this->rest_[e]);
      const Coupling<T> pull = coupling_of(p, d, dv, this->rest_[e]);
      drawn = drawn + pull.drawn;
      const Eigen::Matrix<T, 3, 3> block = matrix(symmetric(pull.even, pull.along, pull.s, T(0), pull.s));
      own += block;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) rows[r][3 * k + c] = -block(r, c);
    }
    const Row<T> stick = stick_row(p, this->place(i), at(this->q_, i), v, force);
    own += matrix(stick.block);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) rows[r][3 * own_slot + c] = own(r, c);
    put(load_, i, stick.load + drawn);
  }

  Numbers first_, column_, edge_;
  Sparse<T> matrix_;
  Values<T> load_, change_;
  Solver solver_;
  long iterations_ = 0;
};

template <class T, class Preconditioner>
using Gradients = Eigen::ConjugateGradient<Sparse<T>, Eigen::Lower | Eigen::Upper, Preconditioner>;

template <class T>
std::unique_ptr<EigenSolver<T>> made(const EigenSystem<T>& s, EigenWay way, int threads, double residual) {
  switch (way) {
    case EigenWay::blocks:
      return std::make_unique<Blocks<T>>(s, threads);
    case EigenWay::ldlt:
      return std::make_unique<Whole<T, Eigen::SimplicialLDLT<Sparse<T>>>>(s, threads, residual);
    case EigenWay::gradients_diagonal:
      return std::make_unique<Whole<T, Gradients<T, Eigen::DiagonalPreconditioner<T>>>>(s, threads, residual);
    case EigenWay::gradients_block:
      return std::make_unique<Whole<T, Gradients<T, BlockJacobi<T>>>>(s, threads, residual);
    case EigenWay::gradients_cholesky:
      break;
  }
  return std::make_unique<Whole<T, Gradients<T, Eigen::IncompleteCholesky<T>>>>(s, threads, residual);
}

}  // namespace

std::unique_ptr<EigenSolver<float>> eigen_solver(const EigenSystem<float>& s, EigenWay way, int threads,
                                                 double residual) {
  return made(s, way, threads, residual);
}
std::unique_ptr<EigenSolver<double>> eigen_solver(const EigenSystem<double>& s, EigenWay way, int threads,
                                                  double residual) {
  return made(s, way, threads, residual);
}

}  // namespace pelage::springs
