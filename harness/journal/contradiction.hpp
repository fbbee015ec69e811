// Refuses rows whose fields contradict each other. The checksum of a line does not exclude such rows:
// somebody may edit a row and then compute its checksum again.
#pragma once
#include "harness/journal/row.hpp"

namespace pelage {

/// Throws InputError, which names the contradiction, unless all of these conditions hold:
/// - A row with the status ok has checks, all of them hold, and no check of a picture has a weaker limit than
///   pelage gives it. The row has times of whole frames. A row with another status has no times.
/// - Every list of times has one entry per timed frame. Wall times and event times are above 0. CPU times are
///   at least 0, and at most the wall time multiplied by the number of CPUs (with a tolerance).
/// - The event time of a frame is the sum of the event times of its phases. The median event time is at most
///   the median wall time (with a tolerance).
/// - A row that claims that its median converged has at least six frames.
/// - The metric fragments_per_s and the ratios of the baselines follow from the times and from the other
///   metrics.
/// - The identity consists of hashes. In a row with the status ok, its parts device, tuning, scene and mesh
///   agree with the other fields of the row, as far as the row has these fields.
/// - The device has the name that the provenance records, and the seed of the check belongs to the name of
///   the case.
void refuse_contradiction(const Row& row);

}  // namespace pelage
