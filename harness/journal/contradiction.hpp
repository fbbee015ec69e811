// Refuses rows whose fields contradict each other. A correct checksum does not exclude contradictions: a
// person may edit a row and then compute its checksum again.
#pragma once
#include "harness/journal/row.hpp"

namespace pelage {

/// Throws InputError unless all of the following conditions hold. The message names the contradiction.
/// - A row with the status ok has checks, and all its checks hold. No check of a picture has a weaker limit
///   than pelage uses. The row has times of whole frames. A row with another status has no times.
/// - Every list of times has one entry per timed frame. Wall times and event times are above 0. CPU times are
///   not negative. They are at most the wall time multiplied by the number of CPUs, plus a tolerance.
/// - The event time of a frame is the sum of the event times of its phases. The median event time is at most
///   the median wall time, plus a tolerance.
/// - A row has at least six frames if it claims that its median converged (has the required precision).
/// - The metric fragments_per_s and the time ratios of the baselines equal the values computed from the row's
///   times and other metrics.
/// - Every part of the identity is a hash. In a row with the status ok, the hashes of device, tuning, scene
///   and mesh agree with other fields of the row, if the row has these fields.
/// - The device name of the row is the one in its provenance. The random seed of the check is the one that
///   belongs to the name of the case.
void refuse_contradiction(const Row& row);

}  // namespace pelage
