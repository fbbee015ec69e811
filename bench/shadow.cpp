// pelage-bench-shadow: compares the readings of the opacity map with the transmittance towards the light
// (docs/strands.md, section Shadow), in double precision, for three dense looks of fur.
//
// The transmittance at a fragment of the light's view is the product of 1 - a over the fragments of its texel
// that lie before it. The program prints, over all fragments, the median optical depth of their texels in the
// map, and the mean and the 95th percentile of the error of each reading. An error is the absolute difference
// of the light, where 1 is the unshadowed light. It also compares the mean transmittance at random fragments
// with that of random rays: such a ray is parallel to the light, passes through a random point of the
// fragment's texel, and meets the exact shapes of all strips. At last, the program times the phases of
// pictures without and with a shadow on the device.
//
// Usage: pelage-bench-shadow [MODEL [SIZE [RAYS]]].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <random>

#include "bench/program.hpp"
#include "bench/timing.hpp"
#include "harness/compare/dense_fur.hpp"
#include "harness/prepare/camera.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/strands/opencl/drawer.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "harness/strands/reference/opacity_map.hpp"
#include "harness/strands/reference/strip.hpp"

namespace {

using namespace pelage;
using namespace pelage::strands;

/// Transmittance of a ray parallel to the light, at the place `at` (texels) and down to the depth z, through
/// the strips of all strands.
double along_ray(const Look& look, const LightView& view, const std::vector<DrawnStrand>& strands,
                 glm::dvec2 at, double z) {
  double through = 1;
  for (std::uint32_t i = 0; i < strands.size(); ++i) {
    const DrawnStrand& strand = strands[i];
    reference::Curve curve;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec4 p(strand.point[k], 1);
      curve.p[k] = {glm::dot(view.row_x, p) + 0.5f * float(view.size),
                    glm::dot(view.row_y, p) + 0.5f * float(view.size), glm::dot(view.row_z, p)};
    }
    const double wide = double(strand.width) / double(view.texel);
    const glm::dvec3 low = glm::min(curve.p[0], glm::min(curve.p[1], curve.p[2])) - wide;
    const glm::dvec3 high = glm::max(curve.p[0], glm::max(curve.p[1], curve.p[2])) + wide;
    if (at.x < low.x || at.y < low.y || at.x > high.x || at.y > high.y) continue;
    for (int k = 0; k < look.segments; ++k) {
      const double t0 = double(k) / look.segments, t1 = double(k + 1) / look.segments;
      const glm::dvec3 a = curve.at(t0), b = curve.at(t1);
      const glm::dvec2 step = glm::dvec2(b) - glm::dvec2(a), from = at - glm::dvec2(a);
      const double s = glm::dot(from, step) / glm::dot(step, step);
      if (!(s >= 0 && s < 1)) continue;
      const double across = std::abs(from.x * step.y - from.y * step.x) / glm::length(step);
      if (across > 0.5 * wide * (1 - double(look.taper) * (t0 + s * (t1 - t0)))) continue;
      if (a.z + s * (b.z - a.z) >= z) continue;
      const double first = reference::alpha_of(look, strand, i, t0),
                   last = reference::alpha_of(look, strand, i, t1);
      through *= 1 - (first + s * (last - first));
    }
  }
  return through;
}

/// The differences between a reading of the map and the transmittance.
struct Errors {
  std::vector<double> all;
  void print(const char* name) {
    double sum = 0, size = 0;
    for (double& e : all) {
      sum += e;
      e = std::abs(e);
      size += e;
    }
    std::sort(all.begin(), all.end());
    fmt::print("  {}: mean error {:.1f}%, 95th percentile {:.1f}%; mean with sign {:+.1f}%\n", name,
               100 * size / double(all.size()), 100 * all[all.size() * 95 / 100],
               100 * sum / double(all.size()));
  }
};

/// Prints the times of the phases of a picture of 800 x 600 pixels.
void time_phases(const cl::Queue& queue, const Mesh& mesh, const Fur& fur, const Look& look,
                 const char* name) {
  Scene scene;
  scene.image.width = 800;
  scene.image.height = 600;
  DrawingScene drawing;
  drawing.camera = make_camera(scene.camera, scene.image, mesh.position, look.shadow.radius - 1);
  drawing.range = depth_range(drawing.camera, look.shadow.radius);
  drawing.look = look;
  Drawer drawer(queue, drawing, fur.strands, fur.keys.size());
  const std::vector<float> keys = key_records(fur.keys);
  drawer.keys().write(queue, keys);
  std::map<std::string, std::vector<double>> phases;
  std::vector<double> cpu;
  for (int round = 0; round < 9; ++round) {
    cl::PhaseEvents events;
    cpu.push_back(bench::timed([&] {
                    drawer.enqueue(queue, &events);
                    queue.finish();
                  }).cpu_ms);
    std::map<std::string, double> sums;
    for (const auto& [phase, event] : events) sums[phase] += event.milliseconds(queue.device()).value_or(0);
    for (const auto& [phase, ms] : sums) phases[phase].push_back(ms);
  }
  fmt::print("  {}, 800x600: CPU {:.1f} ms, the least of 9;", name,
             *std::min_element(cpu.begin(), cpu.end()));
  for (const auto& [phase, times] : phases)
    fmt::print(" {} {:.2f} ms", phase, *std::min_element(times.begin(), times.end()));
  fmt::print("\n");
}

void measure(const cl::Queue& queue, const Mesh& mesh, const DenseLook& c, int size, int rays) {
  const auto [fur, strands, look] = dense_fur(mesh, c, size);
  const LightView view = light_view(look);
  const reference::LightColumns columns = reference::light_columns(look, view, strands);
  const reference::OpacityMap map = reference::opacity_map(columns);
  Look linear = look;
  linear.shadow.reading = Shadow::linear;
  Errors exponential_errors, linear_errors;
  std::vector<double> depths;
  const std::vector<LightSample> samples = light_samples(columns);
  for (const LightSample& s : samples) {
    exponential_errors.all.push_back(reference::texel_light(look, map[s.texel], s.depth) - s.through);
    linear_errors.all.push_back(reference::texel_light(linear, map[s.texel], s.depth) - s.through);
    depths.push_back(-std::log(std::max(map[s.texel].through, 1e-12)));
  }
  fmt::print(
      "{}: {} strands, length {}, width {}, lean {} degrees, {} fragments, median optical depth {:.1f}\n",
      c.name, c.strands, c.length, c.width, c.lean, samples.size(), bench::median(depths));
  exponential_errors.print("exp");
  linear_errors.print("linear");
  Look none = look;
  none.shadow.reading = Shadow::none;
  time_phases(queue, mesh, fur, none, "no shadow");
  time_phases(queue, mesh, fur, linear, "linear");
  time_phases(queue, mesh, fur, look, "exp");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  double column_sum = 0, ray_sum = 0;
  for (int ray = 0; ray < rays; ++ray) {
    const LightSample& s = samples[std::size_t(unit(random) * double(samples.size()))];
    const std::size_t column = s.texel % std::size_t(size), row = s.texel / std::size_t(size);
    const auto x = double(column), y = double(row);
    column_sum += s.through;
    ray_sum += along_ray(look, view, strands, {x + unit(random), y + unit(random)}, s.depth);
  }
  if (rays > 0)
    fmt::print("  mean transmittance at {} fragments: columns {:.4f}, random rays {:.4f}\n", rays,
               column_sum / rays, ray_sum / rays);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::exit_code("pelage-bench-shadow", argc, argv, [](bench::Arguments a) {
    Scene scene;
    scene.model = a.at(1, "bunny");
    const int size = std::atoi(a.at(2, "512").c_str()), rays = std::atoi(a.at(3, "500").c_str());
    if (a.count > 4 || size < 16 || size > 8192 || rays < 0)
      return bench::wrong_usage("pelage-bench-shadow [MODEL [SIZE [RAYS]]]; SIZE is 16 to 8192");
    const auto mesh =
        load_scene_mesh(scene, [](const std::string& text) { fmt::print(stderr, "{}\n", text); });
    const cl::Device device = cl::choose_device("");
    const cl::Queue queue(device);
    for (const DenseLook& look : dense_looks) measure(queue, *mesh, look, size, rays);
    return 0;
  });
}
