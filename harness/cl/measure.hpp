// Measures the peak rates of a device through OpenCL. Reports compare the speed of kernels with these rates.
#pragma once
#include "harness/cl/timer.hpp"

namespace pelage::cl {

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
