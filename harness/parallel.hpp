// Runs independent work on all cores. The results do not depend on the number of threads, because each call
// of the work writes its own results.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace pelage {

/// Calls work(i) once for every i below `count`, in no particular order. `work` must not throw.
template <class Work>
void for_each_index(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  const std::size_t threads = std::min(count, std::size_t(std::thread::hardware_concurrency()));
  std::vector<std::jthread> others;  // their destructors wait
  for (std::size_t i = 1; i < threads; ++i) others.emplace_back(run);
  run();
}

/// Calls work(i) once for every i below `count`. A thread takes `grain` consecutive indices at a time, to
/// reduce the overhead of short calls.
template <class Work>
void for_each_index(std::size_t count, std::size_t grain, const Work& work) {
  for_each_index((count + grain - 1) / grain, [&](std::size_t run) {
    for (std::size_t i = run * grain; i < std::min(count, (run + 1) * grain); ++i) work(i);
  });
}

}  // namespace pelage
