// What a device can do at best, measured through OpenCL: the ceiling that a kernel's speed is held against.
#pragma once
#include "harness/cl/timer.hpp"

namespace pelage::cl {

struct DeviceSpeed {
  TimerCheck timer;
  double triad_gb_s =
      0;  ///< 1e9 bytes read and written per second by a = b + s c over arrays beyond any cache
  double fma_gflop_s = 0;       ///< 1e9 single-precision operations per second, an fma counted as two
  double launch_us = 0;         ///< an empty kernel, from the enqueue to the end of the finish: median of 200
  double queued_launch_us = 0;  ///< the same per kernel when 200 are enqueued before one finish
};

/// Takes about two seconds. Bandwidth and peak are the best of several launches by the wall clock, so that a
/// fake event timer does not matter. Throws DeviceError when the device cannot run them.
DeviceSpeed measure_device(const Device& device);

}  // namespace pelage::cl
