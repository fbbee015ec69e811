// What the OpenCL solvers are timed against: serial C++ of the same schemes, and Eigen, on the same systems
// and states.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Of the tops, per stick: from its base, R, and R/s.
struct Motions {
  std::vector<glm::vec3> offset, speed;
};

class SolverRival {
 public:
  virtual ~SolverRival() = default;
  virtual void set(const Motions& state) = 0;
  /// `steps` steps, `first` of which were done before; moments: as springs::moments gives them.
  virtual void advance(const std::vector<Moment>& moments, int steps) = 0;
  virtual Motions state() const = 0;
  virtual long iterations() const { return 0; }  ///< of conjugate gradients, since it was made
};

/// A rival and what its name stands for: "serial-o3", "serial-fast", "serial-o3-double",
/// "eigen-llt-double-2" (two threads), "eigen-cg-block-float-1", ...
struct NamedRival {
  std::string name;
  std::unique_ptr<SolverRival> rival;
};

/// Everything that solves the same equations as `dynamics.solver` does on `topology`, by name. A sparse
/// direct factorization, which takes seconds and gigabytes on large systems, only below `most_direct` sticks.
/// The native ones are left out where this processor lacks what the building one had.
std::vector<NamedRival> solver_rivals(const SpringNetwork& topology, const Dynamics& dynamics,
                                      std::size_t most_direct = 5000);

/// The serial loops in double; not backward Euler on prisms.
std::unique_ptr<SolverRival> serial_in_double(const SpringNetwork& topology, const Dynamics& dynamics);

}  // namespace pelage::springs
