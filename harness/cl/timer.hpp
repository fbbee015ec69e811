// Tests whether a device's event timer is real. The timestamps of a fake timer count calls of the driver
// instead of time.
#pragma once
#include <span>
#include <string>

#include "harness/cl/buffer.hpp"

namespace pelage::cl {

/// The profiling timestamps of one command, in ns of the device's clock.
struct Stamps {
  std::uint64_t queued = 0, submitted = 0, started = 0, ended = 0;
};

struct TimerCheck {
  bool real = false;    ///< true: event times are reliable enough to be published
  std::string reason;   ///< reason why event times are not reliable, in one line; empty if `real` is true
  double event_ms = 0;  ///< sum of the event times of the tested commands
  double wall_ms = 0;   ///< wall time from the first enqueue to the end of clFinish
};

/// Tests the timestamps of a batch of commands in an in-order queue. The batch kept the device busy for
/// `wall_ms`. A real timer meets three conditions: its resolution is above 0; the timestamps of each command
/// and of successive commands are in order; and the sum of the event times is between half the wall time and
/// the whole wall time (plus 2% for the drift between the clocks).
TimerCheck judge_timer(std::uint64_t resolution_ns, std::span<const Stamps> batch, double wall_ms);

/// Runs a batch of commands of about 0.2 s on the queue's device, and tests its timestamps by judge_timer().
/// Other processes may delay a batch, so a real timer may fail the test. The function therefore tests up to
/// three batches, until a batch passes. A timer that does not measure time fails in
/// every batch.
TimerCheck check_timer(const Queue& queue);

}  // namespace pelage::cl
