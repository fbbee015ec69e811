#include "harness/compare/strands.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/checks.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/contact/reference/colliders.hpp"
#include "harness/parallel.hpp"
#include "harness/prepare/random.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/springs/model/motion.hpp"
#include "harness/strands/reference/chain.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "harness/strands/scene/strand_input.hpp"

namespace pelage {
namespace {

using strands::Chain;
using strands::ChainState;
using strands::DrawnStrand;
using strands::Entry;
using strands::KeyStrand;
using strands::StrandInput;
namespace naive = strands::reference;

constexpr std::size_t chains_compared = 2000, curves_compared = 20000;

/// Returns `most` different indices below `count` in ascending order, or all of them if there are fewer.
std::vector<std::size_t> sample(std::size_t count, std::size_t most, std::uint32_t seed) {
  const Random random(seed, 81);
  const std::size_t chosen = std::min(count, most);
  std::vector<std::size_t> indices;
  // One index of each of `chosen` ranges of equal length.
  for (std::size_t i = 0; i < chosen; ++i) {
    const std::size_t first = i * count / chosen, end = (i + 1) * count / chosen;
    indices.push_back(first + std::size_t(random.uniform(i) * double(end - first)));
  }
  return indices;
}

/// Returns the greatest value of all but the greatest 0.1% of the values; infinite if a value is not a
/// number.
double p999(std::vector<double> values) {
  if (std::any_of(values.begin(), values.end(), [](double v) { return !(v < 1e9); })) return 1e9;
  std::sort(values.begin(), values.end());
  return values[values.size() - 1 - values.size() / 1000];
}

/// Returns the greatest distance between a control point of the device and that of the reference, R.
double worst_point(const DrawnStrand& a, const DrawnStrand& b) {
  double worst = 0;
  for (std::size_t k = 0; k < 3; ++k)
    worst = std::max(worst, glm::distance(glm::dvec3(a.point[k]), glm::dvec3(b.point[k])));
  return worst < 1e9 ? worst : 1e9;
}

/// The exact control points of curve i.
DrawnStrand exact_curve(const StrandInput& input, const std::vector<KeyStrand>& keys, std::size_t i,
                        double* magnified = nullptr) {
  const strands::KeyedStrand& strand = input.fur.strands[i];
  const float first = input.dynamics.first_segment;
  return input.shapes ? naive::shaped(keys, strand, (*input.shapes)[i], first, magnified)
                      : naive::between(keys, strand, first, magnified);
}

/// The skin at the root of strand i at the fraction f of a frame between two frames of the mesh.
naive::SkinPoint skin_point(const strands::SkinFrame& from, const strands::SkinFrame& to, std::size_t i,
                            double f) {
  const auto between = [&](const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    return (1 - f) * glm::dvec3(a[i]) + f * glm::dvec3(b[i]);
  };
  return {between(from.velocity, to.velocity), between(from.acceleration, to.acceleration),
          between(from.rest, to.rest), between(from.normal, to.normal)};
}

/// The colliders at the end of step number `number`.
reference::Colliders colliders_after(const StrandInput& input, long number) {
  return {input.scene, input.contact_fields, double(number + 1) * double(input.scene.dynamics.step)};
}

}  // namespace

std::vector<Check> check_chain_step(const StrandInput& input, const ChainStep& step, std::uint32_t seed) {
  std::vector<double> direction, rate;
  const strands::ChainDynamics dynamics =
      strands::dynamics_of_frame(input, int(step.number / input.scene.dynamics.substeps));
  const reference::Colliders colliders = colliders_after(input, step.number);
  for (const std::size_t i : sample(step.before.size(), chains_compared, seed)) {
    const Chain& chain = input.fur.chains[i];
    const ChainState& found = step.after[i];
    std::optional<naive::SkinPoint> skin;
    if (step.skin) skin = skin_point(step.skin->first, step.skin->second, i, 0.5);
    naive::State exact =
        naive::step(chain, dynamics, naive::in_double(step.before[i]), step.number, skin ? &*skin : nullptr);
    if (!colliders.none()) exact = naive::pushed(chain, dynamics, exact, colliders);
    direction.push_back(std::max(glm::distance(glm::dvec3(found.direction[0]), exact.u),
                                 glm::distance(glm::dvec3(found.direction[1]), exact.w)));
    const double fall = glm::length(glm::dvec3(dynamics.gravity)) / double(chain.length);
    const double unit = std::sqrt(double(chain.stiffness_first) + fall + 1);
    rate.push_back(std::max(glm::distance(glm::dvec3(found.rate[0]), exact.a),
                            glm::distance(glm::dvec3(found.rate[1]), exact.b)) /
                   unit);
  }
  return {{against_reference, "chain_direction_p99.9", p999(direction), tolerance::chain_direction, false},
          {against_reference, "chain_rate_p99.9", p999(rate), tolerance::chain_rate, false}};
}

StrandCheck check_strand_frame(const StrandInput& input, const StrandFrame& frame, std::uint32_t seed) {
  StrandCheck result;
  double worst = 0;
  for (const std::size_t i : sample(frame.curves.size(), curves_compared, seed)) {
    double magnified = 1;
    const DrawnStrand exact = exact_curve(input, frame.keys, i, &magnified);
    worst = std::max(worst, worst_point(frame.curves[i], exact) / std::max(1.0, magnified / 8));
  }
  const double limit =
      strands::has_styles(input.fur.strands) ? tolerance::styled_strand_point : tolerance::strand_point;
  result.checks.push_back({against_reference, "strand_point", worst, limit, false});
  const std::vector<DrawnStrand> drawn = naive::pruned(frame.curves, input.look);
  const std::vector<Entry> order =
      naive::drawing_order(input.camera, input.range, drawn, input.look.back_facing);
  std::size_t different =
      std::max(order.size(), frame.order.size()) - std::min(order.size(), frame.order.size());
  for (std::size_t i = 0; i < std::min(order.size(), frame.order.size()); ++i)
    different += !(order[i] == frame.order[i]);
  result.checks.push_back({against_reference, "order_differences", double(different), 0, false});
  result.agreement = compare(frame.picture, naive::draw(input.camera, input.look, drawn, order,
                                                        frame.skin.get(), &result.fragments));
  for (Check& check : picture_checks(against_reference, result.agreement))
    result.checks.push_back(std::move(check));
  return result;
}

std::vector<DrawnStrand> reference_curves(const StrandInput& input, const std::vector<KeyStrand>& keys) {
  std::vector<DrawnStrand> curves(input.fur.strands.size());
  for_each_index(curves.size(), 256, [&](std::size_t i) {
    curves[i] = exact_curve(input, keys, i);
    curves[i].rank = strands::layer_look(input.look, curves[i].layer).rank;
  });
  return curves;
}

StrandFrame reference_strands(const StrandInput& input, const std::vector<KeyStrand>& keys,
                              std::shared_ptr<const strands::SkinSurface> skin) {
  StrandFrame frame;
  frame.keys = keys;
  frame.curves = reference_curves(input, keys);
  frame.skin = std::move(skin);
  const std::vector<DrawnStrand> drawn = naive::pruned(frame.curves, input.look);
  frame.order = naive::drawing_order(input.camera, input.range, drawn, input.look.back_facing);
  frame.picture = naive::draw(input.camera, input.look, drawn, frame.order, frame.skin.get());
  return frame;
}

std::pair<std::vector<KeyStrand>, std::shared_ptr<const strands::SkinSurface>> reference_keys(
    const StrandInput& input, int frames,
    const std::function<void(const std::vector<strands::KeyStrand>&)>& each) {
  const int substeps = input.scene.dynamics.substeps;
  std::optional<strands::SkinFrames> skin;
  if (!input.mesh->frames.empty()) {
    skin.emplace(input.scene, input.mesh, input.fur, input.skin);
    skin->advance();
  }
  std::vector<naive::State> states;
  for (const Chain& chain : input.fur.chains) states.push_back(naive::at_rest(chain));
  const auto keys_after = [&](int count) {
    const springs::Pose pose =
        springs::pose_at(input.dynamics.motion, double(count) * substeps * double(input.dynamics.step));
    std::vector<KeyStrand> keys = input.fur.keys;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      keys[i].first = glm::vec3(springs::turned(states[i].u, pose.axis, -pose.angle));
      keys[i].second = glm::vec3(springs::turned(states[i].w, pose.axis, -pose.angle));
      if (!skin) continue;
      keys[i].root = skin->frame().root[i];
      keys[i].normal = skin->frame().normal[i];
      keys[i].rest = skin->frame().rest[i];
    }
    return keys;
  };
  // If neither the skin nor a force nor a collider changes, all steps of a chain are computed at once.
  const bool by_frame = skin || forces_change(input.scene) || has_contact(input.scene.contact) || each;
  const int passes = by_frame ? frames : 1, steps = by_frame ? substeps : frames * substeps;
  for (int pass = 0; pass < passes; ++pass) {
    strands::SkinFrame from;
    if (skin) {
      from = skin->frame();
      skin->advance();
    }
    const strands::ChainDynamics dynamics = strands::dynamics_of_frame(input, pass);
    std::vector<reference::Colliders> colliders;
    for (int k = 0; has_contact(input.scene.contact) && k < steps; ++k)
      colliders.push_back(colliders_after(input, long(pass) * steps + k));
    for_each_index(states.size(), 64, [&](std::size_t i) {
      for (int k = 0; k < steps; ++k) {
        std::optional<naive::SkinPoint> point;
        if (skin) point = skin_point(from, skin->frame(), i, double(k + 1) / steps);
        states[i] = naive::step(input.fur.chains[i], dynamics, states[i], long(pass) * steps + k,
                                point ? &*point : nullptr);
        if (!colliders.empty())
          states[i] = naive::pushed(input.fur.chains[i], dynamics, states[i], colliders[std::size_t(k)]);
      }
    });
    if (each) each(keys_after(pass + 1));
  }
  return {keys_after(frames), skin ? skin->surface() : input.skin};
}

StrandFrame reference_strands(const StrandInput& input, int frames) {
  const auto [keys, skin] = reference_keys(input, frames);
  return reference_strands(input, keys, skin);
}

}  // namespace pelage
