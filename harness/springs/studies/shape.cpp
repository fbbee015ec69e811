#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "harness/compare/checks.hpp"
#include "harness/error.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/springs/studies/base.hpp"

namespace pelage::springs {

Shape shape_of(const SpringNetwork& network, const std::vector<glm::vec3>& offset) {
  Shape shape;
  std::vector<double> lean;
  shape.height_least = std::numeric_limits<double>::infinity();
  std::map<std::uint32_t, std::vector<std::size_t>> sticks_at;
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    const glm::dvec3 q(offset[i]), n(network.normal[i]);
    // The arc tangent is precise for small angles; the arc cosine is not.
    lean.push_back(std::atan2(glm::length(glm::cross(n, q)), glm::dot(n, q)) * 180 / std::numbers::pi);
    shape.height_least = std::min(shape.height_least, glm::dot(n, q) / double(network.length));
    sticks_at[network.point[i]].push_back(i);
  }
  const auto [least, most] = std::minmax_element(lean.begin(), lean.end());
  shape.lean_least = *least, shape.lean_most = *most, shape.lean_median = median(lean);
  std::vector<double> gaps;
  for (const auto& [point, sticks] : sticks_at) {
    if (sticks.size() < 2) continue;
    double gap = 0;
    for (const std::size_t a : sticks)
      for (const std::size_t b : sticks)
        gap = std::max(gap, glm::distance(glm::dvec3(offset[a]), glm::dvec3(offset[b])));
    gaps.push_back(gap / double(network.length));
  }
  shape.gap_points = gaps.size();
  if (gaps.empty()) return shape;
  shape.gap_median = median(gaps);
  shape.gap_most = *std::max_element(gaps.begin(), gaps.end());
  return shape;
}

void describe_gap(const Shape& shape, Row& row) {
  if (shape.gap_points == 0) return;
  row.metrics["gap_median"] = {shape.gap_median, "of the length"};
  row.metrics["gap_most"] = {shape.gap_most, "of the length"};
}

namespace {

class ShapeStudy : public Study {
 public:
  ShapeStudy(const cl::Device& device, Setting setting, double seconds)
      : Study(device, std::move(setting)),
        seconds_(seconds),
        masses_(queue_, setting_.network, setting_.dynamics) {
    if (!(seconds_ > 0))
      throw InputError(
          "dynamics.time = 0: the pipeline springs-shape measures the fur after dynamics.time seconds; give a time above 0");
    add_programs(programs_, {&masses_.program()});
  }
  FrameSample frame() override { return {.wall_ms = from_rest(masses_, seconds_).wall_ms}; }
  std::vector<Check> check(const Picture&) override {
    bounded(queue_, masses_);
    const SpringNetwork& network = setting_.network;
    const std::vector<glm::vec3> expected =
        reference_offsets(network, setting_.dynamics, rest_motions(network), 0, masses_.steps());
    return agreement_checks(network.kind, against_reference,
                            spread(masses_.offsets(queue_), expected, double(network.length)));
  }
  void describe(Row& row) override {
    Study::describe(row);
    const Shape shape = shape_of(setting_.network, masses_.offsets(queue_));
    row.metrics["lean_median"] = {shape.lean_median, "degrees"};
    row.metrics["lean_least"] = {shape.lean_least, "degrees"};
    row.metrics["lean_most"] = {shape.lean_most, "degrees"};
    row.metrics["height_least"] = {shape.height_least, "of the length"};
    double fastest = 0;
    for (const glm::vec3& v : masses_.speeds(queue_)) fastest = std::max(fastest, double(glm::length(v)));
    row.metrics["speed_most"] = {fastest / double(setting_.network.length), "lengths/s"};
    describe_gap(shape, row);
    row.metrics["lean_released"] = {released_lean(), "degrees"};
  }

 private:
  /// Ends gravity and wind, and returns the median lean after as many seconds as the load lasted.
  double released_lean() {
    Dynamics free = setting_.dynamics;
    free.gravity = glm::vec3(0);
    free.wind.speed = 0;
    masses_.set_forces(queue_, setting_.network, free);
    masses_.advance(queue_, int(masses_.steps()));
    return shape_of(setting_.network, masses_.offsets(queue_)).lean_median;
  }

  double seconds_;
  MassSprings masses_;
};

}  // namespace

std::unique_ptr<Subject> make_solver_shape(SubjectContext& context, const Case& which) {
  const Scene scene = scene_with_springs(context, which);
  return std::make_unique<ShapeStudy>(context.device, setting_of(context, scene),
                                      double(scene.dynamics.time));
}

}  // namespace pelage::springs
