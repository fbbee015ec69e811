#include <algorithm>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "harness/error.hpp"
#include "harness/mesh/finish.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/mesh/unfold.hpp"

namespace pelage {
namespace {

// Returns the cost of a UV map; a lower cost is better. The area scale of a face is its UV area divided by
// its surface area. Let r be the quotient of two percentiles of the faces' area scales: the 99th percentile
// divided by the 1st percentile. The cost is ln r + 20 (o + f). Here o is the fraction of the map's area that
// overlaps, and f is the fraction that flipped faces take. An overlap of 1% therefore increases the cost as
// much as a 22% greater r.
double cost(const Surface& unfolded, const std::string& name) {
  const UvQuality quality = uv_quality(finish(unfolded, name, {}), 512);
  if (!(quality.area_low > 0)) return std::numeric_limits<double>::max();
  return std::log(quality.area_high / quality.area_low) + 20 * (quality.overlapping + quality.flipped);
}

double cost(const Surface& surface, const CutPlan& plan, const std::string& name, const Unfold& unfold) {
  try {
    return cost(unfold(surface, plan, name), name);
  } catch (const InputError&) {
    return std::numeric_limits<double>::max();
  }
}

constexpr std::size_t most_tries = 20;

TriedPlan reach_into_limbs(const Surface& surface, glm::dvec3 root, const std::string& name,
                           const Unfold& unfold, const std::function<void(double)>& part) {
  const double least = 0.15 * bounding_sphere(surface.point).radius;
  TriedPlan best{{root, {}}, std::numeric_limits<double>::max()};
  best.cost = cost(surface, best.plan, name, unfold);
  std::vector<glm::dvec3> refused;
  for (std::size_t i = 0; i < most_tries; ++i) {
    part(double(i + 1) / (most_tries + 1));
    const Tip tip = farthest_from_cut(surface, best.plan, refused);
    if (tip.distance < least) break;
    CutPlan longer = best.plan;
    longer.tips.push_back(tip.point);
    const double there = cost(surface, longer, name, unfold);
    // All unusable maps have the same cost. Until a plan gives a usable map, each new tip is therefore kept
    // in the plan.
    if (there < best.cost || best.cost == std::numeric_limits<double>::max())
      best = {longer, there};
    else
      refused.push_back(tip.point);
  }
  return best;
}

}  // namespace

std::vector<TriedPlan> plan_cuts(const Surface& proxy, const std::string& name, const Unfold& unfold,
                                 const std::function<void(double)>& part) {
  // On a surface with handles, the cut graph depends on the face where its computation starts. The search
  // therefore uses four start points that are far from each other.
  std::vector<glm::dvec3> roots{proxy.point.front()};
  // For a closed surface, `euler` is twice the Euler characteristic: 4 without handles, less with handles.
  const long euler = 2 * long(proxy.point.size()) - long(proxy.triangle.size());
  while (euler < 4 && roots.size() < 4) {
    const auto near = [&](const glm::dvec3& p) {
      double least = std::numeric_limits<double>::max();
      for (const glm::dvec3& root : roots) least = std::min(least, glm::dot(p - root, p - root));
      return least;
    };
    roots.push_back(*std::ranges::max_element(proxy.point, {}, near));
  }
  std::vector<TriedPlan> plans;
  const auto within = [&](double fraction) {
    if (part) part((double(plans.size()) + fraction) / double(roots.size()));
  };
  for (const glm::dvec3& root : roots) plans.push_back(reach_into_limbs(proxy, root, name, unfold, within));
  return plans;
}

Surface unfold_best(const Surface& surface, const std::vector<TriedPlan>& plans, const std::string& name) {
  std::vector<std::pair<double, Surface>> maps;  // with their costs
  std::exception_ptr failure;
  for (const TriedPlan& tried : plans) {
    try {
      Surface unfolded = unfold_model(surface, tried.plan, name);
      const double there = cost(unfolded, name);
      maps.emplace_back(there, std::move(unfolded));
    } catch (const InputError&) {
      failure = std::current_exception();
    }
  }
  if (maps.empty()) std::rethrow_exception(failure);
  return std::move(std::ranges::min_element(maps, {}, [](const auto& map) { return map.first; })->second);
}

Surface unfold_first(const Surface& surface, std::vector<TriedPlan> plans, const std::string& name,
                     const Unfold& unfold) {
  std::ranges::stable_sort(plans, {}, &TriedPlan::cost);
  std::exception_ptr failure;
  for (const TriedPlan& tried : plans) {
    try {
      return unfold(surface, tried.plan, name);
    } catch (const InputError&) {
      failure = std::current_exception();
    }
  }
  std::rethrow_exception(failure);
}

}  // namespace pelage
