// Tests whether a device's event timer is real. Some drivers count calls instead of time.
#pragma once
#include <span>
#include <string>

#include "harness/cl/buffer.hpp"

namespace pelage::cl {

/// The profiling stamps of one command, in ns of the device's clock.
struct Stamps {
  std::uint64_t queued = 0, submitted = 0, started = 0, ended = 0;
};

struct TimerCheck {
  bool real = false;    ///< true: event times may be published
  std::string reason;   ///< why the timer is not real, in one line; empty if real
  double event_ms = 0;  ///< sum of the batch's event times
  double wall_ms = 0;   ///< wall time from the first enqueue to the end of clFinish
};

/// Tests a batch of commands of an in-order queue that kept the device busy for `wall_ms`. A real timer has a
/// resolution above 0, stamps in order within and between commands, and a sum of event times between half the
/// wall time and the whole wall time (plus 2% for the clocks' drift).
TimerCheck judge_timer(std::uint64_t resolution_ns, std::span<const Stamps> batch, double wall_ms);

/// Runs such a batch of about 0.2 s on the queue's device and tests it. Other work on the machine may delay
/// the batch, so the function tries up to three batches; a fake timer fails all of them.
TimerCheck check_timer(const Queue& queue);

}  // namespace pelage::cl
