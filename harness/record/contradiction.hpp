// Refuses rows (recorded results of cases) whose fields contradict each other. A correct checksum does not
// exclude contradictions: a person may edit a row and then compute its checksum again.
#pragma once
#include <span>

#include "harness/record/row.hpp"

namespace pelage {

/// The weakest limit that any version of pelage has used for a check of a picture
/// (harness/compare/tolerances.hpp). If `at_least` is true, the checked value must be at least the limit,
/// otherwise at most the limit.
struct WeakestLimit {
  const char* metric;
  double limit;
  bool at_least;
};
std::span<const WeakestLimit> weakest_limits();

/// Throws InputError unless all of the following conditions hold. The message names the contradiction.
/// - A row with the status ok has checks (comparisons with trusted results), and all its checks hold. It has
///   times of whole frames. A row with another status has no times. The limit of a picture's check is at
///   least as strict as the weakest limit that any version of pelage has used.
/// - Every list of times has one entry per timed frame. Wall times and event times are above 0. CPU times are
///   not negative. Their median is at most the median wall time multiplied by the number of CPUs, plus a
///   tolerance.
/// - The event time of a frame is the sum of the event times of its phases. The median event time is at most
///   the median wall time, plus a tolerance.
/// - A row has at least six frames if the field `converged` of its provenance is true. This field states that
///   the median frame time has the required precision.
/// - The metric fragments_per_s equals the number of covered fragments divided by the median wall time. Each
///   metric PHASE_ratio, or frame_over_PHASE, equals the ratio computed from the wall times of the phase and
///   of the frames (harness/record/ratios.hpp).
/// - Every part of the row's identity (harness/record/identity.hpp) is a hash.
/// - In a row with the status ok, four parts of the identity agree with other fields of the row. The parts
///   "scene" and "mesh" equal the fields scene_hash and mesh_hash. The part "device" is the hash of the
///   device's entries in the provenance. The part "tuning" is the hash of the row's tuning. If the row lacks
///   such a part or field, the part is not tested.
/// - The device name of the row is equal to the device name in its provenance. The random seed of the check
///   is the seed that check_seed() returns for the name of the case.
void refuse_contradiction(const Row& row);

}  // namespace pelage
