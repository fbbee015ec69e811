// What MassSprings is made of: the buffers that every solver shares, and the launches of each.
#pragma once
#include <string>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/topology/layout.hpp"
#include "harness/topology/mass_springs.hpp"

namespace pelage::topology {

/// Rows of four floats per stick but where said.
struct Buffers {
  cl::Buffer<Moment> moments;  ///< of the launch in hand
  cl::Buffer<glm::vec4> root, normal, push, offset, speed;
  cl::Buffer<std::int32_t> diverged_at;  ///< per row, the first step after which the mass was lost
  cl::Buffer<std::int32_t> first;        ///< one: the least of those
};

/// "-D NAME=value" for a build at `lanes` lanes.
std::string build_options(int lanes);

/// Sticks, separable sticks, separable prisms: one launch takes every block through all substeps.
class BlockStage {
 public:
  BlockStage(const cl::Queue& queue, const Layout& layout, Solver solver, int lanes,
             const MassSpringOptions& options);
  void enqueue(const cl::Queue& queue, TopologyParams params, const Buffers& buffers);
  std::size_t bytes() const { return side_.size() * sizeof(glm::vec4); }
  double build_ms() const { return program_.build_ms(); }

 private:
  cl::Program program_;
  cl::Kernel frame_;
  cl::Buffer<glm::vec4> side_;
  std::size_t group_;
  int blocks_, units_, per_item_;
};

}  // namespace pelage::topology
