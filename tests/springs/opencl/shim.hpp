// Mass-springs on no device: the kernels' text in double, driven as MassSprings drives them.
#pragma once
#include <vector>

#include "harness/springs/model/layout.hpp"

namespace pelage::springs::test {

/// What the kernels of one layout are handed, the state in double.
struct Memory {
  TopologyParams params{};
  std::vector<Moment> moments;
  const Layout* layout = nullptr;
  std::vector<double> sites, push, sides, rest;  ///< the layout's floats
  std::vector<double> offset, speed;             ///< columns; of shared prisms speed lies in rows of four
  std::vector<int> diverged_at, first;
  std::vector<double> tip, change;  ///< shared prisms, rows: root + q, and the last step's dv
};

using BlockKernel = void (*)(TopologyParams, const Moment*, const double*, const double*, const double*,
                             double*, double*, int*, int*);
/// blocks.cl's, built for one kind of block.
struct BlockKernels {
  BlockKernel explicit_euler, backward_euler, semi_implicit_euler, rk4;
};
BlockKernels stick_kernels();
BlockKernels triangle_kernels();

/// One launch over all blocks.
void launch_blocks(const BlockKernels& kernels, Solver solver, Memory& memory);

/// Substep number `substep` of a launch on shared prisms; backward Euler's conjugate gradients until |r| is
/// `residual` |b|.
void prism_substep(Solver solver, Memory& memory, int substep);
int gradients_substep(Memory& memory, int substep, double residual);
/// All substeps of memory.params by one work-item; how many iterations they took (explicit: 0).
int prisms_whole(Solver solver, Memory& memory);
int gradients_whole(Memory& memory, double residual);

class Shim {
 public:
  Shim(const SpringNetwork& topology, const Dynamics& dynamics);
  void push(const std::vector<glm::vec3>& force);
  void advance(int substeps, bool whole = false);  ///< whole: one work-item for all, shared prisms only
  std::vector<glm::dvec3> offsets() const { return by_stick(memory_.offset, false); }
  std::vector<glm::dvec3> speeds() const { return by_stick(memory_.speed, kind_ == Kind::prisms); }
  void set(const std::vector<glm::dvec3>& offsets, const std::vector<glm::dvec3>& speeds);

 private:
  void stand();  // tips from offsets
  std::vector<glm::dvec3> by_stick(const std::vector<double>& values, bool rows) const;
  std::size_t at(std::size_t stick, std::size_t c, bool rows) const;
  Dynamics dynamics_;
  Kind kind_;
  Layout layout_;
  Memory memory_;
  long steps_ = 0;
};

}  // namespace pelage::springs::test
