#include "harness/cl/timer.hpp"

#include <fmt/format.h>

#include <chrono>

#include "harness/cl/program.hpp"

namespace pelage::cl {
namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Stamps stamps_of(const Event& event) {
  Stamps stamps;
  const auto read = [&](cl_profiling_info key, std::uint64_t& into) {
    cl_ulong value = 0;
    check(clGetEventProfilingInfo(event.get(), key, sizeof value, &value, nullptr),
          "clGetEventProfilingInfo");
    into = value;
  };
  read(CL_PROFILING_COMMAND_QUEUED, stamps.queued);
  read(CL_PROFILING_COMMAND_SUBMIT, stamps.submitted);
  read(CL_PROFILING_COMMAND_START, stamps.started);
  read(CL_PROFILING_COMMAND_END, stamps.ended);
  return stamps;
}

}  // namespace

TimerCheck judge_timer(std::uint64_t resolution_ns, std::span<const Stamps> batch, double wall_ms) {
  TimerCheck result;
  result.wall_ms = wall_ms;
  const auto fake = [&](std::string reason) {
    result.reason = std::move(reason);
    return result;
  };
  if (batch.empty()) return fake("no command was timed");
  for (const Stamps& s : batch) result.event_ms += static_cast<double>(s.ended - s.started) * 1e-6;
  if (resolution_ns == 0) return fake("the driver reports a timer resolution of 0");
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const Stamps& s = batch[i];
    if (s.ended <= s.started) return fake("the end time of a command is not after its start time");
    if (s.queued > s.submitted || s.submitted > s.started)
      return fake("the times of a command are not in the order queued, submitted, started");
    if (i > 0 && s.started < batch[i - 1].ended)
      return fake("a command of an in-order queue overlaps the command before it");
  }
  if (result.event_ms < 0.5 * wall_ms || result.event_ms > 1.02 * wall_ms)
    return fake(fmt::format("the event times sum to {:.3g} ms, the wall clock measured {:.3g} ms",
                            result.event_ms, wall_ms));
  result.real = true;
  return result;
}

TimerCheck check_timer(const Queue& queue) {
  const Program program(queue.device(), "measure/measure.cl");
  Kernel load(program, "chains");
  constexpr std::size_t items = 1 << 14, group = 256;
  const Buffer<float> out(queue.device(), items);

  // The loop below doubles the number of rounds in the kernel until one launch takes at least 20 ms. Compared
  // with this time, the overhead of a launch is negligible, and the test remains short.
  const auto run = [&](int rounds) {
    const auto start = std::chrono::steady_clock::now();
    load.with(rounds, 0.5f, out).enqueue(queue, items, group);
    queue.finish();
    return milliseconds_since(start);
  };
  run(1);
  int rounds = 256;
  while (run(rounds) < 20 && rounds < (1 << 28)) rounds *= 2;

  TimerCheck result;
  for (int attempt = 0; attempt < 3 && !result.real; ++attempt) {
    std::array<Event, 5> events;
    const auto start = std::chrono::steady_clock::now();
    for (Event& event : events) event = load.enqueue(queue, items, group);
    queue.finish();
    const double wall = milliseconds_since(start);
    std::array<Stamps, 5> batch;
    for (std::size_t i = 0; i < batch.size(); ++i) batch[i] = stamps_of(events[i]);
    result = judge_timer(queue.device().info().timer_resolution_ns, batch, wall);
  }
  return result;
}

}  // namespace pelage::cl
