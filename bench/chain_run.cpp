// pelage-bench-chain-run: simulates the key strands of a model for a long time, and prints the largest errors
// of all frames. The object shakes and turns in gusts of wind. Then the object and the air stop for 10 s.
//
// The exit status is 0 if these limits hold: relative error of lengths 1e-3, cosines of angle limits 1e-6,
// joint and tip at most 1e-2 of the length below the plane of the skin, at most 0.1% of the tips faster than
// 0.01 lengths a second after the 10 s, and a rise of the energy of at most 1e-6 (k1 + m g L) in a frame
// after the stop.
//
// Usage: pelage-bench-chain-run [MODEL [FACES [SECONDS [CELLS]]]]. FACES: number of triangles of the mesh; 0:
// those of the model. SECONDS: duration of the motion. CELLS: cells of the body's distance field along its
// longest side; 0: the strands collide with the plane of their own skin only.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "bench/program.hpp"
#include "harness/distance/closed_surface.hpp"
#include "harness/distance/field.hpp"
#include "harness/prepare/camera.hpp"
#include "harness/prepare/coat.hpp"
#include "harness/prepare/random.hpp"
#include "harness/strands/groom/fur.hpp"
#include "harness/strands/opencl/chains.hpp"
#include "harness/strands/opencl/drawer.hpp"
#include "harness/strands/reference/chain.hpp"

namespace {

using namespace pelage;
using strands::Chain;
using strands::ChainDynamics;
using strands::ChainState;
using Vec = glm::dvec3;

constexpr int substeps = 4, frames_per_second = 60;

/// The largest errors of all frames. Lengths are relative; depths are in lengths of the strand.
struct Worst {
  double length = 0, first = 0, second = 0, joint = 0, tip = 0;   // key strands
  double between_length = 0, between_joint = 0, between_tip = 0;  // strands between key strands
  double touching = 0, in_body = 0;                               // sums over the frames
  long frames = 0;
  void raise(double& value, double found) { value = std::isfinite(found) ? std::max(value, found) : 1e9; }
};

struct Scene {
  std::shared_ptr<const Mesh> mesh;
  strands::Fur fur;
  std::vector<Chain> chains;
  ChainDynamics dynamics;
};

/// Fur with different stiffnesses, and strands between the key strands with different styles.
Scene scene_of(const std::string& model, std::uint32_t faces, int cells) {
  Scene s;
  MeshOptions options;
  if (faces > 0) options.faces = faces;
  options.progress = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
  s.mesh = load_model(model, options);
  StrandsScene fur;
  fur.layers.front().count = 20'000;
  s.fur = strands::grow(*s.mesh, fur, make_coat(*s.mesh, {}));
  const Random random(1, 2);
  for (std::size_t i = 0; i < s.fur.keys.size(); ++i) {
    Chain c = s.fur.chains[i];
    c.length = 0.07f + 0.06f * float(random.uniform(i, 0));
    c.stiffness_first = 50 * std::pow(100.0f, float(random.uniform(i, 1)));
    c.stiffness_second = 0.5f * c.stiffness_first;
    c.limit_first = 70, c.limit_second = 60;
    s.chains.push_back(c);
  }
  for (std::size_t i = 0; i < s.fur.strands.size(); ++i) {
    strands::KeyedStrand& strand = s.fur.strands[i];
    strand.response = float(2 * random.uniform(i, 2));
    strand.twist = float(180 * random.symmetric(i, 3));
    strand.curvature = float(90 * random.symmetric(i, 4));
  }
  ChainDynamics& d = s.dynamics;
  d.wind = {.direction = {1, 0.2f, 0}, .speed = 3, .gust = 0.8f, .frequency = 1, .wavelength = 2};
  d.motion.shake = {0, 0.15f, 0.1f};
  d.motion.shake_frequency = 2;
  d.motion.axis = {0.2f, 1, 0};
  d.motion.swing = 0.8f;
  d.motion.swing_frequency = 0.5f;
  if (cells > 0) d.body = kept_distance_field(s.mesh, cells);
  return s;
}

/// Rotates vectors between the world and the object's frame after `steps` time steps.
struct Frame {
  springs::Pose pose;
  Frame(const ChainDynamics& d, long steps)
      : pose(springs::pose_at(d.motion, double(steps) * double(d.step))) {}
  Vec world(glm::vec3 v) const { return springs::turned(Vec(v), pose.axis, pose.angle); }
  Vec object(glm::vec3 v) const { return springs::turned(Vec(v), pose.axis, -pose.angle); }
};

void look(Worst& worst, const Scene& s, const std::vector<ChainState>& states, long steps) {
  const Frame frame(s.dynamics, steps);
  const double l1 = double(s.dynamics.first_segment), l2 = 1 - l1;
  const auto cosine = [](float degrees) { return std::cos(double(degrees) * std::numbers::pi / 180); };
  long touching = 0, in_body = 0;
  for (std::size_t i = 0; i < s.chains.size(); ++i) {
    const Vec rest = frame.world(s.chains[i].rest), n = frame.world(s.chains[i].normal),
              u(states[i].direction[0]), w(states[i].direction[1]);
    worst.raise(worst.length, std::max(std::abs(glm::length(u) - 1), std::abs(glm::length(w) - 1)));
    worst.raise(worst.first, cosine(s.chains[i].limit_first) - glm::dot(u, rest));
    worst.raise(worst.second, cosine(s.chains[i].limit_second) - glm::dot(u, w));
    worst.raise(worst.joint, -l1 * glm::dot(n, u));
    worst.raise(worst.tip, -glm::dot(n, l1 * u + l2 * w));
    const auto& stop = states[i].stop;
    touching += std::any_of(stop.begin(), stop.end(), [](float impulse) { return impulse > 0; });
    in_body += states[i].body[0] > 0 || states[i].body[1] > 0;
  }
  worst.touching += double(touching) / double(s.chains.size());
  worst.in_body += double(in_body) / double(s.chains.size());
  ++worst.frames;
}

/// The key strands in the object's frame.
std::vector<strands::KeyStrand> keys_of(const Scene& s, const std::vector<ChainState>& states, long steps) {
  const Frame frame(s.dynamics, steps);
  std::vector<strands::KeyStrand> keys = s.fur.keys;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    keys[i].first = glm::vec3(frame.object(states[i].direction[0]));
    keys[i].second = glm::vec3(frame.object(states[i].direction[1]));
  }
  return keys;
}

/// Looks at the strands between the key strands as the device draws them.
void look_between(Worst& worst, const Scene& s, const std::vector<strands::DrawnStrand>& drawn) {
  const double l1 = double(s.dynamics.first_segment);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Vec root(drawn[i].point[0]), joint(drawn[i].point[1]), tip(drawn[i].point[2]), n(drawn[i].normal);
    const double length = double(s.fur.strands[i].length);
    worst.raise(worst.between_length,
                std::max(std::abs(glm::distance(root, joint) / (l1 * length) - 1),
                         std::abs(glm::distance(joint, tip) / ((1 - l1) * length) - 1)));
    worst.raise(worst.between_joint, -glm::dot(n, joint - root) / length);
    worst.raise(worst.between_tip, -glm::dot(n, tip - root) / length);
  }
}

/// Draws the strands between the key strands. Only their curves are of interest, so the view does not matter.
strands::Drawer drawer_of(const cl::Queue& queue, const Scene& s) {
  strands::DrawingScene drawing;
  drawing.camera = make_camera({}, {}, {s.mesh->position.begin(), s.mesh->position.end()}, 0);
  drawing.look.layers = s.fur.layers;
  drawing.look.film = s.fur.film;
  drawing.range = strands::depth_range(drawing.camera, 2);
  drawing.first_segment = s.dynamics.first_segment;
  return {queue, drawing, s.fur.strands, s.fur.keys.size()};
}

/// Prints how deep joints and tips lie in the true mesh.
void print_penetration(const char* when, const Scene& s, const ClosedSurface* surface,
                       const std::vector<strands::KeyStrand>& keys) {
  if (!surface) return;
  std::array<std::vector<glm::vec3>, 2> ends;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const float l1 = s.dynamics.first_segment, length = s.chains[i].length;
    ends[0].push_back(keys[i].root + l1 * length * keys[i].first);
    ends[1].push_back(ends[0].back() + (1 - l1) * length * keys[i].second);
  }
  for (const std::size_t k : {0u, 1u}) {
    const Penetration p = penetration(*surface, ends[k]);
    fmt::print("{}, {}: {:.2f}% inside the mesh, mean depth {:.4f} R, deepest {:.4f} R\n", when,
               k == 0 ? "joints" : "tips", 100.0 * double(p.inside) / double(p.points), p.mean, p.deepest);
  }
}

bool run(const std::string& model, std::uint32_t faces, int seconds, int cells) {
  Scene s = scene_of(model, faces, cells);
  const cl::Device device = cl::choose_device("");
  const cl::Queue queue(device);
  strands::Chains simulated(queue, s.chains, s.dynamics);
  std::optional<ClosedSurface> surface;
  if (is_closed(*s.mesh))
    surface.emplace(s.mesh);
  else
    fmt::print("the mesh is not closed: no penetration is measured\n");
  fmt::print("{}, {} faces: {} key strands, {} strands between them, {} steps a second, {} s\n", model,
             s.mesh->triangle.size(), s.chains.size(), s.fur.strands.size(), substeps * frames_per_second,
             seconds);
  if (s.dynamics.body)
    fmt::print("body: field with {} x {} x {} nodes, cell {:.4f} R\n", s.dynamics.body->nodes.x,
               s.dynamics.body->nodes.y, s.dynamics.body->nodes.z, double(s.dynamics.body->cell));
  print_penetration("at rest", s, surface ? &*surface : nullptr, s.fur.keys);

  Worst worst;
  strands::Drawer drawer = drawer_of(queue, s);
  const auto look_at_curves = [&] {
    simulated.write_keys(queue, drawer.keys());
    look_between(worst, s, drawer.curves(queue));
  };
  for (int frame = 0; frame < seconds * frames_per_second; ++frame) {
    simulated.enqueue(queue, substeps);
    const std::vector<ChainState> states = simulated.states(queue);
    look(worst, s, states, simulated.steps());
    if (frame % 20 == 19) look_at_curves();
  }
  const auto last_keys = [&] { return keys_of(s, simulated.states(queue), simulated.steps()); };
  print_penetration("in motion", s, surface ? &*surface : nullptr, last_keys());
  fmt::print("share of strands that touch: limits or own skin {:.1f}%, body {:.2f}%\n",
             100 * worst.touching / double(worst.frames), 100 * worst.in_body / double(worst.frames));

  ChainDynamics& d = s.dynamics;
  d.motion = {};
  d.wind.speed = 0;
  simulated.retarget(d);
  std::vector<double> energy(s.chains.size(), 1e300);
  double rise = 0;
  for (int frame = 0; frame < 10 * frames_per_second; ++frame) {
    simulated.enqueue(queue, substeps);
    const std::vector<ChainState> states = simulated.states(queue);
    look(worst, s, states, simulated.steps());
    for (std::size_t i = 0; i < states.size(); ++i) {
      const strands::reference::State state{Vec(states[i].direction[0]),
                                            Vec(states[i].direction[1]),
                                            Vec(states[i].rate[0]),
                                            Vec(states[i].rate[1]),
                                            {},
                                            {}};
      const double now = strands::reference::energy(s.chains[i], d, state, 0);
      const double unit = double(s.chains[i].stiffness_first) + 9.81 / double(s.chains[i].length);
      if (frame > 0) rise = std::max(rise, (now - energy[i]) / unit);
      energy[i] = now;
    }
  }
  std::size_t moving = 0;
  for (const ChainState& state : simulated.states(queue)) {
    const double l1 = double(d.first_segment);
    moving += glm::length(l1 * Vec(state.rate[0]) + (1 - l1) * Vec(state.rate[1])) > 0.01;
  }
  look_at_curves();
  print_penetration("10 s after the stop", s, surface ? &*surface : nullptr, last_keys());
  fmt::print(
      "key strands: relative error of the lengths {:.1e}; limits exceeded by {:.1e} and {:.1e} in cosine\n",
      worst.length, worst.first, worst.second);
  fmt::print("key strands below the plane of their skin, in strand lengths: joint {:.1e}, tip {:.1e}\n",
             worst.joint, worst.tip);
  fmt::print(
      "strands between: relative error of the lengths {:.1e}; below the plane: joint {:.1e}, tip {:.1e}\n",
      worst.between_length, worst.between_joint, worst.between_tip);
  fmt::print("10 s after the stop: {} of {} tips ({:.3f}%) are faster than 0.01 L/s\n", moving,
             s.chains.size(), 100.0 * double(moving) / double(s.chains.size()));
  fmt::print("largest rise of the energy in a frame after the stop: {:.1e} of k1 + m g L\n", rise);
  const double length = std::max(worst.length, worst.between_length),
               limit = std::max(worst.first, worst.second),
               below = std::max({worst.joint, worst.tip, worst.between_joint, worst.between_tip});
  const bool good = length < 1e-3 && limit < 1e-6 && below < 1e-2 && rise < 1e-6 &&
                    double(moving) <= 1e-3 * double(s.chains.size());
  fmt::print("{}\n", good ? "all limits hold" : "a limit does not hold");
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::exit_code("pelage-bench-chain-run", argc, argv, [](bench::Arguments a) {
    const long faces = std::atol(a.at(2, "5000").c_str()), seconds = std::atol(a.at(3, "60").c_str()),
               cells = std::atol(a.at(4, "64").c_str());
    if (a.count > 5 || faces < 0 || faces > 10'000'000 || seconds < 1 || seconds > 3600 || cells < 0 ||
        cells > 256)
      return bench::wrong_usage("pelage-bench-chain-run [MODEL [FACES [SECONDS [CELLS]]]]");
    return run(a.at(1, "bunny"), std::uint32_t(faces), int(seconds), int(cells)) ? 0 : 1;
  });
}
