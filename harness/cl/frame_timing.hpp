// The times of one frame: wall time, and event times of its phases and kernels.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::cl {

/// The time of one kernel launch of a frame.
struct KernelTime {
  std::string kernel, phase;
  double ms = 0;
  std::size_t bytes = 0;  ///< total size of the kernel's buffer arguments, each buffer counted once
};

/// The times of one frame, in milliseconds. phase_event_ms and kernels are empty if the times of the device's
/// OpenCL events are not reliable.
struct FrameTiming {
  double wall_ms = 0;                            ///< time from the first enqueue until the queue has finished
  std::map<std::string, double> phase_event_ms;  ///< event times by phase, for instance "simulate"
  std::vector<KernelTime> kernels;               ///< in launch order; empty if phase_event_ms is empty
};

/// Calls `enqueue`, which enqueues the kernels of a frame and appends their events. Waits until the queue has
/// finished, and returns the times.
FrameTiming timed_frame(const Queue& queue, const std::function<void(PhaseEvents&)>& enqueue);

}  // namespace pelage::cl
