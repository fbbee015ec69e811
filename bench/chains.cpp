// pelage-bench-chains: compares the device's simulation of strands (harness/strands/opencl/chains.hpp) with
// serial loops that compute the same time step (harness/strands/baselines/serial_chains.hpp). Each round
// simulates the same frame with all of them in turns. The program prints the medians of wall time and CPU
// time, the least CPU time of a strand and step, the medians of the ratios within a round, the mean share of
// strands that touch a stop, and the median difference of the states after the last round.
//
// Usage: pelage-bench-chains [STRANDS [ROUNDS [SUBSTEPS [SOFT]]]]. SOFT is the stiffness k1 of the softest
// strands in 1/s^2. The softer the strands, the more of them touch a stop. PoCL uses one thread if the
// environment has POCL_MAX_PTHREAD_COUNT=1.
#include "harness/strands/opencl/chains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "bench/program.hpp"
#include "bench/timing.hpp"
#include "harness/prepare/random.hpp"
#include "harness/strands/baselines/serial_chains.hpp"

namespace {

using namespace pelage;
using bench::median;
using bench::Time;
using bench::timed;
using strands::Chain;
using strands::ChainState;

/// Strands on the unit sphere that lean 40 degrees downwards, with lengths from 0.07 to 0.13 R. Their
/// stiffness k1 varies from `soft` to 100 times `soft`. Neighbours have different lengths and stiffnesses.
std::vector<Chain> chains_on_sphere(std::size_t count, float soft) {
  const Random random(1, 1);
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
    chain.length = 0.07f + 0.06f * float(random.uniform(i, 0));
    chain.stiffness_first = soft * std::pow(100.0f, float(random.uniform(i, 1)));
    chain.stiffness_second = 0.5f * chain.stiffness_first;
    chains.push_back(chain);
  }
  return chains;
}

bool touches(const ChainState& state) {
  return std::any_of(state.stop.begin(), state.stop.end(), [](float impulse) { return impulse > 0; });
}

int run(std::size_t count, int rounds, int substeps, float soft) {
  const std::vector<Chain> chains = chains_on_sphere(count, soft);
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
  double touching = 0;
  for (int round = -30; round < rounds; ++round) {  // the first rounds are not timed
    std::array<Time, 3> time{};
    for (std::size_t i = 0; i < ways.size(); ++i) time[i] = timed(ways[i].step);
    for (std::size_t i = 0; round >= 0 && i < ways.size(); ++i) {
      ways[i].wall.push_back(time[i].wall_ms);
      ways[i].cpu.push_back(time[i].cpu_ms);
      ways[i].wall_ratio.push_back(time[i].wall_ms / time[0].wall_ms);
      ways[i].cpu_ratio.push_back(time[i].cpu_ms / time[0].cpu_ms);
    }
    if (round < 0) continue;
    const std::vector<ChainState> states = ours.states(queue);
    touching += double(std::count_if(states.begin(), states.end(), touches)) / double(count) / rounds;
  }
  const std::vector<ChainState> of_device = ours.states(queue), of_plain = plain.states();
  std::vector<double> differences;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 2; ++k)
      differences.push_back(double(glm::length(of_device[i].direction[k] - of_plain[i].direction[k])));
  fmt::print(
      "{} strands, {} substeps, {} rounds in turns, {}; {:.1f}% touch a stop; median difference of the "
      "directions {:.1e}\n",
      count, substeps, rounds, device.info().name, 100 * touching, median(differences));
  fmt::print("{:<14} {:>9} {:>9} {:>16} {:>12} {:>12}\n", "", "wall, ms", "CPU, ms", "least ns a step",
             "wall : device", "CPU : device");
  for (const Way& way : ways)
    fmt::print("{:<14} {:>9.2f} {:>9.2f} {:>16.2f} {:>12.2f} {:>12.2f}\n", way.name, median(way.wall),
               median(way.cpu),
               *std::min_element(way.cpu.begin(), way.cpu.end()) * 1e6 / double(count) / substeps,
               median(way.wall_ratio), median(way.cpu_ratio));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::exit_code("pelage-bench-chains", argc, argv, [](bench::Arguments a) {
    const long count = std::atol(a.at(1, "100000").c_str()), rounds = std::atol(a.at(2, "15").c_str()),
               substeps = std::atol(a.at(3, "4").c_str());
    const double soft = std::atof(a.at(4, "20").c_str());
    if (a.count > 5 || count < 1 || count > 10'000'000 || rounds < 1 || rounds > 10'000 || substeps < 1 ||
        substeps > 1000 || !(soft >= 1 && soft <= 1e5))
      return bench::wrong_usage("pelage-bench-chains [STRANDS [ROUNDS [SUBSTEPS [SOFT]]]]");
    return run(std::size_t(count), int(rounds), int(substeps), float(soft));
  });
}
