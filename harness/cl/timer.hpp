// Is a device's event timer real? Some drivers count calls instead of time.
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
  bool real = false;    ///< event times may be published
  std::string reason;   ///< why not, in one line; empty when real
  double event_ms = 0;  ///< sum of the batch's event times
  double wall_ms = 0;   ///< wall time from the first enqueue to the finish
};

/// Judges a batch of commands of an in-order queue that kept the device busy for `wall_ms`: resolution above
/// 0, stamps in order within and between commands, and a sum between half the wall time and all of it (2% for
/// the clocks' drift).
TimerCheck judge_timer(std::uint64_t resolution_ns, std::span<const Stamps> batch, double wall_ms);

/// Runs such a batch, about 0.2 s of it, on the queue's device and judges it. A machine busy with other work
/// may starve the batch, so up to three are tried; a fake timer fails them all.
TimerCheck check_timer(const Queue& queue);

}  // namespace pelage::cl
