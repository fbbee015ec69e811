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
