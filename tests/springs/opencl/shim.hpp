// Runs the source of the mass-spring kernels as C++ in double precision, in the same order as MassSprings
// runs the kernels.
#pragma once
#include <vector>

#include "harness/springs/model/layout.hpp"

namespace pelage::springs::test {

/// The arguments of the kernels for one Layout (a topology in the kernels' order). Positions, velocities and
/// constants of the sticks are in double precision.
struct Memory {
  TopologyParams params{};
  std::vector<Moment> moments;
  const Layout* layout = nullptr;
  std::vector<double> sites, push, sides, rest;  ///< the float arrays of the layout, converted to double
  /// `offset` has the top minus the base of each stick, and `speed` the velocity of each top. Both are stored
  /// in columns x, y and z, except `speed` of prisms, which has one row of four values per stick.
  std::vector<double> offset, speed;
  std::vector<int> diverged_at, first;
  /// Only prisms use these arrays, with one row of four values per stick: the positions of top and base,
  /// their difference, and the change of the top's velocity in the previous step.
  std::vector<double> tip, root, reach, change;
};

using BlockKernel = void (*)(TopologyParams, const Moment*, const double*, const double*, const double*,
                             double*, double*, int*, int*);
/// The kernels of blocks.cl, compiled for one kind of block: a stick or a triangle of three sticks.
struct BlockKernels {
  BlockKernel explicit_euler, backward_euler, semi_implicit_euler, rk4, predictor_corrector;
};
BlockKernels stick_kernels();
BlockKernels triangle_kernels();

/// Runs the kernel of `solver` for all work-items of one launch.
void launch_blocks(const BlockKernels& kernels, Solver solver, Memory& memory);

/// prism_substep and gradients_substep compute the substep with the index `substep` of a launch on prisms.
/// gradients_substep uses backward Euler. It iterates conjugate gradients until the relative residual is at
/// most `residual`.
void prism_substep(Solver solver, Memory& memory, int substep);
void gradients_substep(Memory& memory, int substep, double residual);
/// prisms_whole and gradients_whole compute memory.params.substeps substeps on prisms in a single work-item.
void prisms_whole(Solver solver, Memory& memory);
void gradients_whole(Memory& memory, double residual);

class Shim {
 public:
  Shim(const SpringNetwork& network, const Dynamics& dynamics);
  void push(const std::vector<glm::vec3>& force);
  /// Advances by `substeps` steps. If `whole` is set, one work-item computes all of them (prisms only).
  void advance(int substeps, bool whole = false);
  std::vector<glm::dvec3> offsets() const { return by_stick(memory_.offset, false); }
  std::vector<glm::dvec3> speeds() const { return by_stick(memory_.speed, kind_ == Kind::prisms); }
  void set(const std::vector<glm::dvec3>& offsets, const std::vector<glm::dvec3>& speeds);

 private:
  void stand();  // computes the rows of `tip`, `root` and `reach` from `sites` and `offset`
  std::vector<glm::dvec3> by_stick(const std::vector<double>& values, bool rows) const;
  std::size_t at(std::size_t stick, std::size_t c, bool rows) const;
  Dynamics dynamics_;
  Kind kind_;
  Layout layout_;
  Memory memory_;
  long steps_ = 0;
};

}  // namespace pelage::springs::test
