#include "harness/springs/opencl/adaptive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"

namespace pelage::springs {
namespace {

using Vectors = std::vector<glm::vec3>;

/// The 99th percentile of the distances, of `length`.
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
        "adaptive steps: a frame of {} s in {} steps, tolerance {}, at most {} steps; all above 0, "
        "and no more steps than the most",
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
  // The coarser of the two was the finer one before; empty where it exploded.
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
          fmt::format("tolerance {}: not reached with {} steps a frame; a larger one, or a shorter frame",
                      tolerance_, steps_));
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
