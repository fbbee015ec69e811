// pelage-bench-chains: compares the device's simulation of strands (harness/strands/opencl/chains.hpp) with
// serial loops that compute the same time step (harness/strands/baselines/serial_chains.hpp). Each round
// simulates the same frame with all of them in turns. The program prints the medians of wall time and CPU
// time, the medians of the ratios within a round, the share of strands that touch a stop, and the largest
// difference of the states after the last round.
//
// Usage: pelage-bench-chains [STRANDS [ROUNDS [SUBSTEPS]]]. PoCL uses one thread if the environment has
// POCL_MAX_PTHREAD_COUNT=1.
#include "harness/strands/opencl/chains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "bench/timing.hpp"
#include "harness/error.hpp"
#include "harness/strands/baselines/serial_chains.hpp"

namespace {

using namespace pelage;
using bench::median;
using bench::Time;
using bench::timed;
using strands::Chain;
using strands::ChainState;

/// Strands on the unit sphere that lean 40 degrees downwards, with lengths from 0.07 to 0.13 R.
std::vector<Chain> chains_on_sphere(std::size_t count) {
  std::vector<Chain> chains;
  chains.reserve(count);
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));  // a spiral of points with equal areas
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * double(i) + 1) / double(count), r = std::sqrt(1 - z * z),
                 angle = turn * double(i);
    Chain chain;
    chain.normal = glm::vec3(r * std::cos(angle), z, r * std::sin(angle));
    chain.root = chain.normal;
    const glm::vec3 down = glm::vec3(0, -1, 0) + chain.normal.y * chain.normal;
    chain.rest =
        glm::normalize(chain.normal * std::cos(0.7f) +
                       (glm::length(down) > 1e-4f ? glm::normalize(down) : glm::vec3(0)) * std::sin(0.7f));
    chain.length = 0.07f + 0.06f * float(i % 97) / 96;
    chains.push_back(chain);
  }
  return chains;
}

bool touches(const ChainState& state) {
  return std::any_of(state.stop.begin(), state.stop.end(), [](float impulse) { return impulse > 0; });
}

int run(std::size_t count, int rounds, int substeps) {
  const std::vector<Chain> chains = chains_on_sphere(count);
  strands::ChainDynamics dynamics;
  dynamics.wind.speed = 3;
  dynamics.wind.gust = 0.5f;
  const cl::Device device = cl::choose_device("");
  const cl::Queue queue(device);
  strands::Chains ours(queue, chains, dynamics);
  strands::SerialChains plain(chains, dynamics, strands::plain_chain_loop),
      fast(chains, dynamics, strands::fast_chain_loop);
  struct Way {
    const char* name;
    std::function<void()> step;
    std::vector<double> wall, cpu, wall_ratio, cpu_ratio;
  };
  std::array<Way, 3> ways{Way{"device",
                              [&] {
                                ours.enqueue(queue, substeps);
                                queue.finish();
                              },
                              {},
                              {},
                              {},
                              {}},
                          Way{"serial, -O3", [&] { plain.advance(substeps); }, {}, {}, {}, {}},
                          Way{"serial, fast", [&] { fast.advance(substeps); }, {}, {}, {}, {}}};
  for (int round = -10; round < rounds; ++round) {  // the first ten rounds are not timed
    std::array<Time, 3> time{};
    for (std::size_t i = 0; i < ways.size(); ++i) time[i] = timed(ways[i].step);
    for (std::size_t i = 0; round >= 0 && i < ways.size(); ++i) {
      ways[i].wall.push_back(time[i].wall_ms);
      ways[i].cpu.push_back(time[i].cpu_ms);
      ways[i].wall_ratio.push_back(time[i].wall_ms / time[0].wall_ms);
      ways[i].cpu_ratio.push_back(time[i].cpu_ms / time[0].cpu_ms);
    }
  }
  const std::vector<ChainState> of_device = ours.states(queue), of_plain = plain.states();
  double worst = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 2; ++k)
      worst = std::max(worst, double(glm::length(of_device[i].direction[k] - of_plain[i].direction[k])));
  const auto touching = std::count_if(of_device.begin(), of_device.end(), touches);
  fmt::print(
      "{} strands, {} substeps, {} rounds in turns, {}; {:.1f}% touch a stop; directions differ by at most "
      "{:.1e}\n",
      count, substeps, rounds, device.info().name, 100.0 * double(touching) / double(count), worst);
  fmt::print("{:<14} {:>9} {:>9} {:>16} {:>12} {:>12}\n", "", "wall, ms", "CPU, ms", "CPU ns per step",
             "wall : device", "CPU : device");
  for (const Way& way : ways)
    fmt::print("{:<14} {:>9.2f} {:>9.2f} {:>16.2f} {:>12.2f} {:>12.2f}\n", way.name, median(way.wall),
               median(way.cpu), median(way.cpu) * 1e6 / double(count) / substeps, median(way.wall_ratio),
               median(way.cpu_ratio));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const long count = argc > 1 ? std::atol(argv[1]) : 100'000, rounds = argc > 2 ? std::atol(argv[2]) : 15,
               substeps = argc > 3 ? std::atol(argv[3]) : 4;
    if (argc > 4 || count < 1 || count > 10'000'000 || rounds < 1 || rounds > 10'000 || substeps < 1 ||
        substeps > 1000) {
      fmt::print(stderr, "usage: pelage-bench-chains [STRANDS [ROUNDS [SUBSTEPS]]]\n");
      return 2;
    }
    return run(std::size_t(count), int(rounds), int(substeps));
  } catch (const InputError& error) {
    fmt::print(stderr, "pelage-bench-chains: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "pelage-bench-chains: {}\n", error.what());
    return 1;
  }
}
