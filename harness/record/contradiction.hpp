// Refuses rows whose fields contradict each other. A correct checksum does not exclude contradictions: a
// person may edit a row and then compute its checksum again.
#pragma once
#include <span>

#include "harness/record/row.hpp"

namespace pelage {

/// The weakest limit that any version of pelage has used for a check of a picture
/// (harness/compare/tolerances.hpp).
struct WeakestLimit {
  const char* metric;
  double limit;
  bool at_least;
};
std::span<const WeakestLimit> weakest_limits();

/// Throws InputError, with the contradiction, unless all of the following conditions hold.
/// - A row with the status ok has checks, all its checks hold, and it has times of whole frames. A row with
///   another status has no times. The limit of a picture's check is at least as strict as weakest_limits().
/// - Every list of times has one entry per timed frame. Wall times and event times are above 0, CPU times not
///   negative. Their median is at most the median wall time multiplied by the number of CPUs, plus a
///   tolerance.
/// - The event time of a frame is the sum of the event times of its phases. The median event time is at most
///   the median wall time, plus a tolerance.
/// - A row has at least six frames if provenance.converged is true.
/// - The metric fragments_per_s equals the number of covered fragments divided by the median wall time. Each
///   metric PHASE_ratio or frame_over_PHASE follows from the wall times (harness/record/ratios.hpp).
/// - Every part of the row's identity (harness/record/identity.hpp) is a hash. In a row with the status ok,
///   the parts "scene" and "mesh" equal the fields scene_hash and mesh_hash, and the parts "device" and
///   "tuning" are the hashes of the device's entries in the provenance and of the tuning, where the row has
///   both.
/// - The device name of the row is equal to the device name in its provenance. The random seed of the check
///   is the check_seed() of the case.
void refuse_contradiction(const Row& row);

}  // namespace pelage
