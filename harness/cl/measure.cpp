#include "harness/cl/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "harness/cl/program.hpp"

namespace pelage::cl {
namespace {

constexpr std::size_t group = 256;  // work-items per work-group; all launches have a multiple of them

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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

// Runs `work` once without timing it, because the first run includes compilation and the first access to
// memory. Then measures `times` runs of `work`, and returns the least time in seconds.
double best_seconds(int times, const std::function<void()>& work) {
  work();
  double best = seconds(work);
  for (int i = 1; i < times; ++i) best = std::min(best, seconds(work));
  return best;
}

double triad(const Queue& queue, const Program& program, std::size_t lanes) {
  const DeviceInfo& info = queue.device().info();
  // An array of 256 MiB is larger than the caches of most current devices. The arrays are smaller if memory
  // is short.
  std::size_t floats = std::size_t{64} << 20;
  while (floats > 4096 &&
         (floats * sizeof(float) > info.max_allocation || 12 * floats > info.global_memory / 4))
    floats /= 2;
  const Buffer<float> a(queue.device(), floats), b(queue.device(), floats), c(queue.device(), floats);
  Kernel clear(program, "triad"), kernel(program, "triad");
  // The arrays b and c are written once before the timed runs read them. Otherwise the operating system could
  // map all pages of both arrays to one shared page of zeros, and the kernel would read from the cache
  // instead of the memory.
  for (const auto* array : {&b, &c}) clear.with(*array, a, a, 0.0f).enqueue(queue, floats / lanes, group);
  kernel.with(a, b, c, 0.5f);
  const double best = best_seconds(7, [&] {
    kernel.enqueue(queue, floats / lanes, group);
    queue.finish();
  });
  return 3.0 * sizeof(float) * static_cast<double>(floats) / best * 1e-9;
}

double fma_peak(const Queue& queue, const Program& program, std::size_t lanes) {
  const std::size_t items =
      std::size_t{2048} * std::max(queue.device().info().compute_units, 1u) / lanes * 16;
  const Buffer<float> out(queue.device(), items * lanes);
  Kernel kernel(program, "chains");
  int rounds = 64;
  const auto run = [&] {
    kernel.with(rounds, 0.5f, out).enqueue(queue, items, group);
    queue.finish();
  };
  run();
  while (seconds(run) < 0.02 && rounds < (1 << 24)) rounds *= 2;
  const double operations = 16.0 * static_cast<double>(lanes * items) * rounds;
  return operations / best_seconds(7, run) * 1e-9;
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
  constexpr std::size_t items = 1 << 14;
  const Buffer<float> out(queue.device(), items);

  // The loop below doubles the number of rounds in the kernel until one launch takes at least 20 ms. Compared
  // with this time, the overhead of a launch is negligible, and the test remains short.
  const auto run = [&](int rounds) {
    return seconds([&] {
      load.with(rounds, 0.5f, out).enqueue(queue, items, group);
      queue.finish();
    });
  };
  run(1);
  int rounds = 256;
  while (run(rounds) < 0.02 && rounds < (1 << 28)) rounds *= 2;

  TimerCheck result;
  for (int attempt = 0; attempt < 3 && !result.real; ++attempt) {
    std::array<Event, 5> events;
    const double wall = 1e3 * seconds([&] {
                          for (Event& event : events) event = load.enqueue(queue, items, group);
                          queue.finish();
                        });
    std::array<Stamps, 5> batch;
    for (std::size_t i = 0; i < batch.size(); ++i) batch[i] = stamps_of(events[i]);
    result = judge_timer(queue.device().info().timer_resolution_ns, batch, wall);
  }
  return result;
}

DeviceSpeed measure_device(const Device& device) {
  const Queue queue(device);
  const auto lanes = static_cast<std::size_t>(device.info().lanes);
  const Program program(device, "measure/measure.cl", fmt::format("-D LANES={}", lanes));
  DeviceSpeed speed;
  speed.timer = check_timer(queue);
  speed.triad_gb_s = triad(queue, program, lanes);
  speed.fma_gflop_s = fma_peak(queue, program, lanes);

  constexpr std::size_t launches = 200;
  const Buffer<float> out(device, 1);
  Kernel nothing(program, "nothing");
  nothing.with(out);
  const auto launch = [&] { nothing.enqueue(queue, std::size_t{1}); };
  launch();
  queue.finish();
  std::vector<double> single(launches);
  for (double& time : single)
    time = seconds([&] {
      launch();
      queue.finish();
    });
  std::nth_element(single.begin(), single.begin() + launches / 2, single.end());
  speed.launch_us = single[launches / 2] * 1e6;
  speed.queued_launch_us = 1e6 / static_cast<double>(launches) * seconds([&] {
                             for (std::size_t i = 0; i < launches; ++i) launch();
                             queue.finish();
                           });
  return speed;
}

}  // namespace pelage::cl
