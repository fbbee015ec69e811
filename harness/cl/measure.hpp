// Measures the peak rates of a device through OpenCL. The speed of a kernel is compared with these rates.
#pragma once
#include "harness/cl/timer.hpp"

namespace pelage::cl {

struct DeviceSpeed {
  TimerCheck timer;
  double triad_gb_s =
      0;  ///< 1e9 bytes read and written per second by a = b + s c over arrays beyond any cache
  double fma_gflop_s = 0;       ///< 1e9 single-precision operations per second, an fma counted as two
  double launch_us = 0;         ///< an empty kernel, from the enqueue to the end of clFinish: median of 200
  double queued_launch_us = 0;  ///< the same per kernel if 200 are enqueued before one clFinish
};

/// Takes about two seconds. Bandwidth and peak are the best of several launches by the wall clock, so a fake
/// event timer has no effect. Throws DeviceError if the device cannot run the kernels.
DeviceSpeed measure_device(const Device& device);

}  // namespace pelage::cl
