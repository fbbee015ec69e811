// The baselines of the OpenCL solvers: serial C++ loops with the same integration schemes, and solvers of the
// library Eigen. They solve the same systems as the OpenCL solvers, from the same initial states.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// State of the top of each stick: its position relative to the stick's base in R, and its velocity in R/s.
struct Motions {
  std::vector<glm::vec3> offset, speed;
};

/// A baseline solver of one mass-spring system.
class SolverBaseline {
 public:
  virtual ~SolverBaseline() = default;
  virtual void set(const Motions& state) = 0;
  /// Advances the state by `steps` steps. moments[2 * i] holds wind, gravity and the object's motion at the
  /// start of step i (see springs::moments).
  virtual void advance(const std::vector<Moment>& moments, int steps) = 0;
  virtual Motions state() const = 0;
  virtual long iterations() const { return 0; }  ///< number of conjugate gradient iterations so far
};

/// A baseline and its name. Examples of names are "serial-o3", "serial-fast", "serial-o3-double",
/// "parallel-fast-2" (serial-fast on two threads), "eigen-llt-double-2" (two threads) and
/// "eigen-cg-block-float-1" (one thread).
struct NamedBaseline {
  std::string name;
  std::unique_ptr<SolverBaseline> solver;
  int threads = 1;
};

/// Returns all baselines that solve the equations of `dynamics.solver` on `network`. The one with a sparse
/// direct factorization takes seconds and gigabytes on large systems, so it is left out from `most_direct`
/// sticks on. Those that are compiled for the processor of the machine that built pelage are left out where
/// the processor lacks the vector instructions. For backward Euler with `dynamics.full_jacobian` there is no
/// baseline.
std::vector<NamedBaseline> solver_baselines(const SpringNetwork& network, const Dynamics& dynamics,
                                            std::size_t most_direct = 5000);

/// Returns the serial C++ baseline in double precision.
std::unique_ptr<SolverBaseline> serial_in_double(const SpringNetwork& network, const Dynamics& dynamics);

}  // namespace pelage::springs
