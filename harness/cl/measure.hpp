// Measures the peak rates of a device through OpenCL. Reports compare the speed of kernels with these rates.
// Also tests whether a device's event timer is real, which means that its timestamps measure time. A fake
// timer counts the calls to the driver, and reports these counts as timestamps.
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
/// `wall_ms`. A real timer meets three conditions. Its resolution is above 0. The timestamps of each command
/// and of successive commands are in order. The sum of the event times is at least half the wall time, and at
/// most 2% longer than the wall time. These 2% permit a drift between the two clocks.
TimerCheck judge_timer(std::uint64_t resolution_ns, std::span<const Stamps> batch, double wall_ms);

/// Runs a batch of five commands, each of at least 20 ms, on the queue's device, and tests its
/// timestamps by judge_timer(). Other processes may delay a batch, so a real timer may fail the test. The
/// function therefore tests up to three batches, until a batch passes. A timer that does not measure time
/// fails in every batch.
TimerCheck check_timer(const Queue& queue);

struct DeviceSpeed {
  TimerCheck timer;
  /// Memory bandwidth (reads plus writes) of a = b + s c in GB/s. The arrays are larger than most caches.
  double triad_gb_s = 0;
  double fma_gflop_s = 0;  ///< 1e9 single-precision operations per second; an fma counts as two
  /// Time of one launch of an empty kernel, from its enqueue to the end of clFinish: median of 200 launches.
  double launch_us = 0;
  double queued_launch_us = 0;  ///< time per launch if 200 launches are enqueued before one clFinish
};

/// Measures a device, which takes about two seconds. The bandwidth and the arithmetic peak are the best
/// values of several launches. The wall clock times these launches, because the device's event timer may be
/// wrong. Throws DeviceError if the device cannot run the kernels.
DeviceSpeed measure_device(const Device& device);

}  // namespace pelage::cl
