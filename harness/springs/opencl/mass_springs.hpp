// A topology in motion on an OpenCL device.
#pragma once
#include <memory>
#include <stdexcept>

#include "harness/cl/program.hpp"
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// The masses flew apart: dt is too long for the stiffness, or the forces are absurd.
struct Diverged : std::runtime_error {
  Diverged(long step_number, std::size_t mass_number, const Dynamics& dynamics);
  long step;         ///< the first step after which a mass was out of bounds or not a number, from 0
  std::size_t mass;  ///< the lowest such mass of the topology
};

struct MassSpringOptions {
  int lanes = 0;            ///< sticks or triangles at a time, 1 or 16; 0: as suits the device
  std::size_t group = 0;    ///< work-items of a work-group; 0: as suits the device
  int blocks_per_item = 0;  ///< slices that a work-item goes through; 0: as suits the device
  /// One work-item takes the whole model through all steps of a launch: what suits a CPU where the model is
  /// so small that the launches cost more than the steps.
  enum class Whole { as_suits, never, always } whole = Whole::as_suits;
};

/// Whether that suits: the sticks of shared prisms, or the slices of the others, are few.
bool whole_suits(const cl::DeviceInfo& device, Kind kind, Solver solver, std::size_t sticks);

/// What conjugate gradients did so far; all 0 where nothing was solved by them.
struct LinearSolves {
  long solves = 0, iterations = 0;
  int most_iterations = 0;    ///< of one solve
  double worst_residual = 0;  ///< largest |r| / |b| that a solve ended with, by its own reckoning
};

class MassSprings {
 public:
  /// At rest. Throws InputError where check(dynamics) does.
  MassSprings(const cl::Queue& queue, const SpringNetwork& topology, const Dynamics& dynamics,
              const MassSpringOptions& options = {});
  ~MassSprings();
  MassSprings(MassSprings&&) noexcept;
  MassSprings& operator=(MassSprings&&) noexcept;

  /// Puts every top where these say, R and R/s per stick, as if `steps` steps were done; none is lost, and
  /// conjugate gradients start from nothing. Throws InputError for another count, or a value that is not
  /// finite.
  void set(const cl::Queue& queue, const std::vector<glm::vec3>& offsets,
           const std::vector<glm::vec3>& speeds, long steps = 0);

  /// Steps of another length from now on, s; the number of those done is as set() says. Throws InputError
  /// where check(dynamics) does.
  void retime(float step);

  /// Local forces on the tops from now on, N, one per stick, in the object's frame; empty: none. Throws
  /// InputError for another count, or a force that is not finite.
  void push(const cl::Queue& queue, const std::vector<glm::vec3>& force);

  /// Enqueues that many steps. Waits for nothing but the host's own tables, and for conjugate gradients. Adds
  /// every launch to `launches`, where one is given.
  void enqueue(const cl::Queue& queue, int substeps, std::vector<cl::Event>* launches = nullptr);

  /// Throws Diverged when a step enqueued so far went wrong; waits for the queue.
  void check(const cl::Queue& queue) const;

  /// enqueue, then check.
  void advance(const cl::Queue& queue, int substeps);

  std::vector<glm::vec3> offsets(const cl::Queue& queue) const;  ///< per stick, top less base, R
  std::vector<glm::vec3> speeds(const cl::Queue& queue) const;   ///< per stick, of the top, R/s
  /// Those offsets on the device; where each stick's x lies there, y and z being 16 further each.
  const cl::Buffer<float>& offset() const;
  std::vector<std::int32_t> offset_columns() const;
  long steps() const;         ///< done or enqueued
  float length() const;       ///< of the fur, R
  std::size_t bytes() const;  ///< of device memory, as memory() counts it
  const LinearSolves& solves() const;
  const cl::Program& program() const;  ///< of the solver

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pelage::springs
