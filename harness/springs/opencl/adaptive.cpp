#include "harness/springs/opencl/adaptive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"

namespace pelage::springs {
namespace {

using Vectors = std::vector<glm::vec3>;

/// Returns the 99th percentile of the distances between a[i] and b[i], as a fraction of `length`.
double difference(const Vectors& a, const Vectors& b, float length) {
  std::vector<double> error;
  error.reserve(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    error.push_back(glm::distance(glm::dvec3(a[i]), glm::dvec3(b[i])) / double(length));
  const auto at = error.begin() + std::ptrdiff_t((error.size() - 1) * 99 / 100);
  std::nth_element(error.begin(), at, error.end());
  return *at;
}

}  // namespace

AdaptiveSteps::AdaptiveSteps(float span, int steps, float tolerance, int most)
    : span_(span), tolerance_(tolerance), steps_(steps), most_(most) {
  if (!(span > 0) || !(tolerance > 0) || steps < 1 || steps > most)
    throw InputError(fmt::format(
        "adaptive steps: frame length {} s, {} steps, tolerance {}, at most {} steps; frame length and "
        "tolerance must be above 0, and the number of steps must be from 1 to the limit",
        span, steps, tolerance, most));
}

AdaptiveSteps::Frame AdaptiveSteps::advance(const cl::Queue& queue, MassSprings& masses,
                                            std::vector<cl::Event>* launches) {
  const Vectors offsets = masses.offsets(queue), speeds = masses.speeds(queue);
  const auto moved = [&](int steps) {
    masses.retime(span_ / float(steps));
    masses.set(queue, offsets, speeds, frame_ * steps);
    masses.enqueue(queue, steps, launches);
    masses.check(queue);
    return masses.offsets(queue);
  };
  // Computes one frame in `steps` steps. If the masses diverge, returns an empty result, so that advance()
  // tries more steps.
  const auto tried = [&](int steps) {
    try {
      return moved(steps);
    } catch (const Diverged&) {
      if (steps >= most_) throw;
      return Vectors{};
    }
  };
  Vectors coarse = tried(steps_);
  for (;;) {
    if (2 * steps_ > most_)
      throw InputError(
          fmt::format("the tolerance {} needs more than {} time steps per frame; use a larger tolerance or a "
                      "shorter frame",
                      tolerance_, most_));
    Vectors fine = tried(2 * steps_);
    const double error = coarse.empty() || fine.empty() ? std::numeric_limits<double>::infinity()
                                                        : difference(coarse, fine, masses.length());
    if (error <= double(tolerance_)) {
      const Frame frame{2 * steps_, error};
      if (error < 0.25 * double(tolerance_)) steps_ = std::max(1, steps_ / 2);
      ++frame_;
      return frame;
    }
    steps_ *= 2;
    coarse = std::move(fine);
  }
}

}  // namespace pelage::springs
