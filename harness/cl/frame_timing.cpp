#include "harness/cl/frame_timing.hpp"

#include <chrono>
#include <optional>

namespace pelage::cl {

FrameTiming timed_frame(const Queue& queue, const std::function<void(PhaseEvents&)>& enqueue) {
  PhaseEvents events;
  const auto begin = std::chrono::steady_clock::now();
  enqueue(events);
  queue.finish();
  FrameTiming timing;
  timing.wall_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  for (const auto& [phase, event] : events) {
    const std::optional<double> ms = event.milliseconds(queue.device());
    if (!ms) {
      timing.phase_event_ms.clear();
      timing.kernels.clear();
      break;
    }
    timing.phase_event_ms[phase] += *ms;
    timing.kernels.push_back({event.kernel(), phase, *ms, event.bytes()});
  }
  return timing;
}

}  // namespace pelage::cl
