#include "harness/springs/baselines/baselines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/springs/baselines/arrays.hpp"
#include "harness/springs/baselines/eigen.hpp"

namespace pelage::springs {
namespace {

template <class T>
class SerialBaseline : public SolverBaseline {
 public:
  SerialBaseline(const SpringNetwork& network, const Dynamics& dynamics, const Loops<T>& loops,
                 int threads = 1)
      : kind_(network.kind), course_{dynamics.solver, params(dynamics, network.length)}, loops_(loops) {
    course_.threads = threads;
    course_.residual = double(dynamics.residual);
    course_.most_iterations = dynamics.most_iterations;
    const std::size_t sticks = network.sticks(), triangles = network.corner.size(),
                      edges = network.edges().size();
    for (std::size_t i = 0; i < sticks; ++i)
      place_.push_back(kind_.own_edges() ? i % 3 * triangles + i / 3 : i);
    const auto column = [&](std::size_t size) { return owned_.emplace_back(size).data(); };
    const auto columns = [&](auto& list) {
      for (T*& each : list) each = column(sticks);
    };
    Arrays<T>& a = arrays_;
    a.sticks = int(sticks), a.edges = int(edges);
    columns(a.root), columns(a.normal), columns(a.q), columns(a.v);
    a.phase_cos = column(sticks), a.phase_sin = column(sticks), a.rest = column(edges);
    for (std::size_t i = 0; i < sticks; ++i) {
      put(a.root, i, network.mass[i]);
      put(a.normal, i, network.normal[i]);
      const double phase = gust_phase(dynamics.wind, network.gust_at[i]);
      a.phase_cos[place_[i]] = T(std::cos(phase)), a.phase_sin[place_[i]] = T(std::sin(phase));
    }
    for (std::size_t e = 0; e < edges; ++e)
      a.rest[kind_.own_edges() ? e % 3 * triangles + e / 3 : e] = T(network.rest[sticks + e]);
    if (!kind_.shared_edges()) return;
    for (const glm::uvec2 edge : network.edges()) {
      from_.push_back(int(edge.x) - int(sticks));
      to_.push_back(int(edge.y) - int(sticks));
    }
    a.from = from_.data(), a.to = to_.data();
    columns(a.force[0]), columns(a.force[1]);
    if (dynamics.solver.multistage()) columns(a.work);
    if (!dynamics.solver.implicit) return;
    Gradients<T>& g = a.gradients;
    for (auto* list : {&g.change, &g.load, &g.residual, &g.precond, &g.way, &g.product[0], &g.product[1]})
      columns(*list);
    for (auto* list : {&g.diagonal[0], &g.diagonal[1], &g.inverse}) columns(*list);
    for (T*& each : g.coupling) each = column(edges);
  }

  void set(const Motions& state) override {
    for (std::size_t i = 0; i < place_.size(); ++i) {
      put(arrays_.q, i, state.offset[i]);
      put(arrays_.v, i, state.speed[i]);
    }
    for (T* change : arrays_.gradients.change)
      if (change) std::fill_n(change, place_.size(), T(0));
  }

  void advance(const std::vector<Moment>& moments, int steps) override {
    course_.moments = moments.data();
    course_.steps = steps;
    if (kind_.shared_edges())
      iterations_ += loops_.prisms(arrays_, course_);
    else if (kind_.own_edges())
      loops_.triangles(arrays_, course_);
    else
      loops_.sticks(arrays_, course_);
  }

  long iterations() const override { return iterations_; }

  Motions state() const override {
    Motions found;
    const Arrays<T>& a = arrays_;
    for (const std::size_t place : place_) {
      found.offset.emplace_back(a.q[0][place], a.q[1][place], a.q[2][place]);
      found.speed.emplace_back(a.v[0][place], a.v[1][place], a.v[2][place]);
    }
    return found;
  }

 private:
  void put(T* const (&columns)[3], std::size_t stick, glm::vec3 value) {
    for (std::size_t c = 0; c < 3; ++c) columns[c][place_[stick]] = T(value[int(c)]);
  }

  Kind kind_;
  Course course_;
  Loops<T> loops_;
  std::vector<std::size_t> place_;     // index of each stick in the arrays
  std::vector<std::vector<T>> owned_;  // the arrays to which arrays_ points
  std::vector<int> from_, to_;
  Arrays<T> arrays_;
  long iterations_ = 0;
};

template <class T>
class EigenBaseline : public SolverBaseline {
 public:
  EigenBaseline(const SpringNetwork& network, const Dynamics& dynamics, EigenWay way, int threads)
      : sticks_(network.sticks()), params_(params(dynamics, network.length)) {
    std::vector<T> root, normal, phase, rest;
    std::vector<int> ends;
    for (std::size_t i = 0; i < sticks_; ++i) {
      for (int c = 0; c < 3; ++c)
        root.push_back(T(network.mass[i][c])), normal.push_back(T(network.normal[i][c]));
      const double at = gust_phase(dynamics.wind, network.gust_at[i]);
      phase.push_back(T(std::cos(at))), phase.push_back(T(std::sin(at)));
    }
    for (std::size_t e = 0; e < network.edges().size(); ++e) {
      ends.push_back(int(network.edges()[e].x) - int(sticks_));
      ends.push_back(int(network.edges()[e].y) - int(sticks_));
      rest.push_back(T(network.rest[sticks_ + e]));
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
void add_eigen(std::vector<NamedBaseline>& baselines, const SpringNetwork& network, const Dynamics& dynamics,
               EigenWay way, const char* what, bool threaded) {
  for (int threads = 1; threads <= (threaded ? 2 : 1); ++threads)
    baselines.push_back(
        {fmt::format("eigen-{}-{}-{}", what, std::is_same_v<T, float> ? "float" : "double", threads),
         std::make_unique<EigenBaseline<T>>(network, dynamics, way, threads), threads});
}

}  // namespace

std::unique_ptr<SolverBaseline> serial_in_double(const SpringNetwork& network, const Dynamics& dynamics) {
  return std::make_unique<SerialBaseline<double>>(network, dynamics, plain_loops(0.0));
}

std::vector<NamedBaseline> solver_baselines(const SpringNetwork& network, const Dynamics& dynamics,
                                            std::size_t most_direct) {
  std::vector<NamedBaseline> baselines;
  if (dynamics.solver.implicit && dynamics.full_jacobian) return baselines;
  const bool fast = fast_loops_run_here();
  const auto serial = [&]<class T>(const char* name, const Loops<T>& loops, int threads = 1) {
    baselines.push_back(
        {name, std::make_unique<SerialBaseline<T>>(network, dynamics, loops, threads), threads});
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
  if (!dynamics.solver.implicit || !network.kind.edges) return baselines;
  if (!fast) return baselines;
  if (network.kind.own_edges()) {
    add_eigen<double>(baselines, network, dynamics, EigenWay::blocks, "llt", true);
    add_eigen<float>(baselines, network, dynamics, EigenWay::blocks, "llt", true);
    return baselines;
  }
  add_eigen<double>(baselines, network, dynamics, EigenWay::gradients_diagonal, "cg-diagonal", true);
  add_eigen<double>(baselines, network, dynamics, EigenWay::gradients_block, "cg-block", true);
  add_eigen<float>(baselines, network, dynamics, EigenWay::gradients_block, "cg-block", true);
  add_eigen<double>(baselines, network, dynamics, EigenWay::gradients_cholesky, "cg-cholesky", false);
  if (network.sticks() < most_direct)
    add_eigen<double>(baselines, network, dynamics, EigenWay::ldlt, "ldlt", false);
  return baselines;
}

}  // namespace pelage::springs
