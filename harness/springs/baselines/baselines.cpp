#include "harness/springs/baselines/baselines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/springs/baselines/arrays.hpp"
#include "harness/springs/baselines/eigen.hpp"

namespace pelage::springs {
namespace {

double phase_at(const SpringNetwork& topology, const Wind& wind, std::size_t stick) {
  const glm::dvec3 along = glm::normalize(glm::dvec3(wind.direction));
  return 2 * std::numbers::pi * glm::dot(glm::dvec3(topology.gust_at[stick]), along) /
         double(wind.wavelength);
}

template <class T>
using Columns = std::array<std::vector<T>, 3>;

template <class T>
class SerialRival : public SolverRival {
 public:
  SerialRival(const SpringNetwork& topology, const Dynamics& dynamics, const Loops<T>& loops, int threads = 1)
      : kind_(topology.kind), course_{dynamics.solver, params(dynamics, topology.length)}, loops_(loops) {
    course_.threads = threads;
    course_.residual = double(dynamics.residual);
    course_.most_iterations = dynamics.most_iterations;
    const std::size_t sticks = topology.sticks(), triangles = topology.corner.size();
    for (std::size_t i = 0; i < sticks; ++i)
      place_.push_back(kind_.own_edges() ? i % 3 * triangles + i / 3 : i);
    for (Columns<T>* columns : {&root_, &normal_, &q_, &v_})
      for (std::vector<T>& column : *columns) column.resize(sticks);
    phase_cos_.resize(sticks), phase_sin_.resize(sticks);
    for (std::size_t i = 0; i < sticks; ++i) {
      put(root_, i, topology.mass[i]);
      put(normal_, i, topology.normal[i]);
      const double phase = phase_at(topology, dynamics.wind, i);
      phase_cos_[place_[i]] = T(std::cos(phase)), phase_sin_[place_[i]] = T(std::sin(phase));
    }
    rest_.resize(topology.edges().size());
    for (std::size_t e = 0; e < rest_.size(); ++e)
      rest_[kind_.own_edges() ? e % 3 * triangles + e / 3 : e] = T(topology.rest[sticks + e]);
    if (kind_.shared_edges()) {
      for (const glm::uvec2 edge : topology.edges()) {
        from_.push_back(int(edge.x) - int(sticks));
        to_.push_back(int(edge.y) - int(sticks));
      }
      for (std::vector<T>& column : force_) column.resize(sticks);
      if (dynamics.solver.implicit) {
        for (std::vector<T>& column : vectors_) column.resize(sticks);
        for (std::vector<T>& column : coupling_) column.resize(rest_.size());
      }
      for (std::vector<T>& column : work_) column.resize(dynamics.solver.multistage() ? sticks : 0);
    }
  }

  void set(const Motions& state) override {
    for (std::size_t i = 0; i < place_.size(); ++i) put(q_, i, state.offset[i]), put(v_, i, state.speed[i]);
    for (std::vector<T>& column : vectors_) std::fill(column.begin(), column.end(), T(0));
  }

  void advance(const std::vector<Moment>& moments, int steps) override {
    course_.moments = moments.data();
    course_.steps = steps;
    const Arrays<T> a = arrays();
    if (kind_.shared_edges())
      iterations_ += loops_.prisms(a, course_);
    else if (kind_.own_edges())
      loops_.triangles(a, course_);
    else
      loops_.sticks(a, course_);
  }

  long iterations() const override { return iterations_; }

  Motions state() const override {
    Motions found;
    for (const std::size_t place : place_) {
      found.offset.emplace_back(q_[0][place], q_[1][place], q_[2][place]);
      found.speed.emplace_back(v_[0][place], v_[1][place], v_[2][place]);
    }
    return found;
  }

 private:
  void put(Columns<T>& columns, std::size_t stick, glm::vec3 value) {
    for (std::size_t c = 0; c < 3; ++c) columns[c][place_[stick]] = T(value[int(c)]);
  }
  Arrays<T> arrays() {
    Arrays<T> a;
    a.sticks = int(place_.size()), a.edges = int(rest_.size());
    for (std::size_t c = 0; c < 3; ++c) {
      a.root[c] = root_[c].data(), a.normal[c] = normal_[c].data();
      a.q[c] = q_[c].data(), a.v[c] = v_[c].data();
      a.force[0][c] = force_[c].data(), a.force[1][c] = force_[3 + c].data();
    }
    std::size_t next = 0;
    Gradients<T>& g = a.gradients;
    for (T** list : {g.change, g.load, g.residual, g.precond, g.way, g.product[0], g.product[1]})
      for (int c = 0; c < 3; ++c) list[c] = vectors_[next++].data();
    for (T** list : {g.diagonal[0], g.diagonal[1], g.inverse})
      for (int c = 0; c < 6; ++c) list[c] = vectors_[next++].data();
    for (std::size_t c = 0; c < coupling_.size(); ++c) g.coupling[c] = coupling_[c].data();
    for (std::size_t c = 0; c < work_.size(); ++c) a.work[c] = work_[c].data();
    a.phase_cos = phase_cos_.data(), a.phase_sin = phase_sin_.data();
    a.from = from_.data(), a.to = to_.data(), a.rest = rest_.data();
    return a;
  }

  Kind kind_;
  Course course_;
  Loops<T> loops_;
  std::vector<std::size_t> place_;  // index of each stick in the arrays
  Columns<T> root_, normal_, q_, v_;
  std::array<std::vector<T>, 6> force_;
  std::array<std::vector<T>, 12> work_;
  std::array<std::vector<T>, 21 + 18> vectors_;  // conjugate-gradient arrays with one value per stick
  std::array<std::vector<T>, 4> coupling_;
  long iterations_ = 0;
  std::vector<T> phase_cos_, phase_sin_, rest_;
  std::vector<int> from_, to_;
};

template <class T>
class EigenRival : public SolverRival {
 public:
  EigenRival(const SpringNetwork& topology, const Dynamics& dynamics, EigenWay way, int threads)
      : sticks_(topology.sticks()), params_(params(dynamics, topology.length)) {
    std::vector<T> root, normal, phase, rest;
    std::vector<int> ends;
    for (std::size_t i = 0; i < sticks_; ++i) {
      for (int c = 0; c < 3; ++c)
        root.push_back(T(topology.mass[i][c])), normal.push_back(T(topology.normal[i][c]));
      const double at = phase_at(topology, dynamics.wind, i);
      phase.push_back(T(std::cos(at))), phase.push_back(T(std::sin(at)));
    }
    for (std::size_t e = 0; e < topology.edges().size(); ++e) {
      ends.push_back(int(topology.edges()[e].x) - int(sticks_));
      ends.push_back(int(topology.edges()[e].y) - int(sticks_));
      rest.push_back(T(topology.rest[sticks_ + e]));
    }
    solver_ = eigen_solver(
        {int(sticks_), int(rest.size()), root.data(), normal.data(), phase.data(), rest.data(), ends.data()},
        way, threads, double(dynamics.residual));
  }

  void set(const Motions& state) override {
    for (std::size_t i = 0; i < sticks_; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        solver_->q()[3 * i + c] = T(state.offset[i][int(c)]);
        solver_->v()[3 * i + c] = T(state.speed[i][int(c)]);
      }
    solver_->forget();
  }
  void advance(const std::vector<Moment>& moments, int steps) override {
    for (int i = 0; i < steps; ++i) solver_->step(params_, moments[2 * std::size_t(i) + 2]);
  }
  Motions state() const override {
    Motions found;
    for (std::size_t i = 0; i < sticks_; ++i) {
      const T *q = solver_->q() + 3 * i, *v = solver_->v() + 3 * i;
      found.offset.emplace_back(q[0], q[1], q[2]);
      found.speed.emplace_back(v[0], v[1], v[2]);
    }
    return found;
  }
  long iterations() const override { return solver_->iterations(); }

 private:
  std::size_t sticks_;
  TopologyParams params_;
  std::unique_ptr<EigenSolver<T>> solver_;
};

template <class T>
void add_eigen(std::vector<NamedRival>& rivals, const SpringNetwork& topology, const Dynamics& dynamics,
               EigenWay way, const char* what, bool threaded) {
  for (int threads = 1; threads <= (threaded ? 2 : 1); ++threads)
    rivals.push_back(
        {fmt::format("eigen-{}-{}-{}", what, std::is_same_v<T, float> ? "float" : "double", threads),
         std::make_unique<EigenRival<T>>(topology, dynamics, way, threads), threads});
}

}  // namespace

std::unique_ptr<SolverRival> serial_in_double(const SpringNetwork& topology, const Dynamics& dynamics) {
  return std::make_unique<SerialRival<double>>(topology, dynamics, plain_loops(0.0));
}

std::vector<NamedRival> solver_rivals(const SpringNetwork& topology, const Dynamics& dynamics,
                                      std::size_t most_direct) {
  std::vector<NamedRival> rivals;
  if (dynamics.solver.implicit && dynamics.full_jacobian) return rivals;
  const bool fast = fast_loops_run_here();
  const auto serial = [&]<class T>(const char* name, const Loops<T>& loops, int threads = 1) {
    rivals.push_back({name, std::make_unique<SerialRival<T>>(topology, dynamics, loops, threads), threads});
  };
  if (dynamics.solver.implicit)
    serial("serial-o3-double", plain_loops(0.0));
  else
    serial("serial-o3", plain_loops(0.0f));
  if (fast) {
    if (dynamics.solver.implicit) serial("serial-fast-double", fast_loops(0.0));
    serial("serial-fast", fast_loops(0.0f));
    serial("parallel-fast-2", fast_loops(0.0f), 2);
  }
  if (!dynamics.solver.implicit || !topology.kind.edges) return rivals;
  if (!fast) return rivals;
  if (topology.kind.own_edges()) {
    add_eigen<double>(rivals, topology, dynamics, EigenWay::blocks, "llt", true);
    add_eigen<float>(rivals, topology, dynamics, EigenWay::blocks, "llt", true);
    return rivals;
  }
  add_eigen<double>(rivals, topology, dynamics, EigenWay::gradients_diagonal, "cg-diagonal", true);
  add_eigen<double>(rivals, topology, dynamics, EigenWay::gradients_block, "cg-block", true);
  add_eigen<float>(rivals, topology, dynamics, EigenWay::gradients_block, "cg-block", true);
  add_eigen<double>(rivals, topology, dynamics, EigenWay::gradients_cholesky, "cg-cholesky", false);
  if (topology.sticks() < most_direct)
    add_eigen<double>(rivals, topology, dynamics, EigenWay::ldlt, "ldlt", false);
  return rivals;
}

}  // namespace pelage::springs
