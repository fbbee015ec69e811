// pelage-bench-strands: times pictures of strands (harness/strands/opencl/drawer.hpp), and the OpenGL
// baseline (harness/strands/opengl/ribbons.hpp) in turns with them. It prints the medians of wall time and
// CPU time, of the phases, and of the ratios within a turn, and the PSNR between the two pictures.
//
// Usage: pelage-bench-strands [MODEL [STRANDS [WIDTHxHEIGHT [ROUNDS [EXPAND:TARGET [PICTURE.png]]]]]].
// EXPAND:TARGET are options of the baseline (RibbonOptions), for instance instanced:rgba8; "-": no baseline.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>

#include "bench/program.hpp"
#include "bench/timing.hpp"
#include "harness/compare/metrics.hpp"
#include "harness/picture/png.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/strands/groom/fur_cache.hpp"
#include "harness/strands/opencl/drawer.hpp"
#include "harness/strands/opengl/ribbons.hpp"

namespace {

using namespace pelage;
using bench::median;
using bench::Time;
using bench::timed;

struct Times {
  std::vector<double> wall, cpu;
  void add(const std::function<void()>& work) {
    const Time time = timed(work);
    wall.push_back(time.wall_ms);
    cpu.push_back(time.cpu_ms);
  }
};

struct Options {
  std::string model;
  std::size_t strands = 0;
  int width = 0, height = 0, rounds = 0;
  std::string baseline, file;
};

int run(const Options& a) {
  Scene scene;
  scene.model = a.model;
  scene.image.width = a.width;
  scene.image.height = a.height;
  const auto mesh = load_scene_mesh(scene, [](const std::string& text) { fmt::print(stderr, "{}\n", text); });
  const auto input = prepare(scene, mesh);
  StrandLayerScene& layer = scene.strands.layers.front();
  layer.count = int(a.strands);
  const strands::Fur fur = strands::kept_fur(*mesh, scene.strands, input->coat);
  strands::DrawingScene drawing;
  drawing.camera = input->camera;
  drawing.range = strands::depth_range(input->camera, 1 + layer.length * (1 + layer.length_spread));
  const cl::Device device = cl::choose_device("");
  const cl::Queue queue(device);
  strands::Drawer drawer(queue, drawing, fur.strands, fur.keys.size());
  const std::vector<float> keys = strands::key_records(fur.keys);
  drawer.keys().write(queue, keys);
  std::function<void()> baseline;
  std::function<Picture()> baseline_picture;
  std::optional<strands::Ribbons> ribbons;
  if (a.baseline != "-") {
    const auto colon = a.baseline.find(':');
    strands::RibbonOptions options{a.baseline.substr(0, colon),
                                   colon == std::string::npos ? "rgba32f" : a.baseline.substr(colon + 1)};
    ribbons.emplace(strands::RibbonScene{drawing.camera, drawing.look, drawing.range, drawing.first_segment},
                    fur.strands, options);
    baseline = [&] { ribbons->frame(fur.keys); };
    baseline_picture = [&] { return ribbons->read(); };
  }
  Times ours, theirs;
  std::map<std::string, std::vector<double>> phases;
  for (int round = -2; round < a.rounds; ++round) {  // the first two rounds are not timed
    if (round == 0) ours = theirs = {};
    cl::PhaseEvents events;
    ours.add([&] {
      drawer.enqueue(queue, &events);
      queue.finish();
    });
    if (baseline) theirs.add(baseline);
    std::map<std::string, double> sums;
    for (const auto& [phase, event] : events) sums[phase] += event.milliseconds(device).value_or(0);
    for (const auto& [phase, ms] : sums)
      if (round >= 0) phases[phase].push_back(ms);
  }
  fmt::print("{} {} strands {}x{}: {} drawn, {} in tiles; wall {:.2f} ms, CPU {:.2f} ms (least {:.2f});",
             a.model, a.strands, a.width, a.height, drawer.order(queue).size(), drawer.listed(),
             median(ours.wall), median(ours.cpu), *std::min_element(ours.cpu.begin(), ours.cpu.end()));
  for (const auto& [phase, times] : phases) fmt::print(" {} {:.2f}", phase, median(times));
  if (baseline) {
    std::vector<double> wall, cpu;
    for (std::size_t i = 0; i < ours.wall.size(); ++i) {
      wall.push_back(theirs.wall[i] / ours.wall[i]);
      cpu.push_back(theirs.cpu[i] / ours.cpu[i]);
    }
    fmt::print("; OpenGL {}: wall {:.1f} ms, CPU {:.1f} ms; ratio wall {:.2f}, CPU {:.2f}; {:.1f} dB",
               a.baseline, median(theirs.wall), median(theirs.cpu), median(wall), median(cpu),
               compare(drawer.read(queue), baseline_picture()).psnr);
  }
  fmt::print("\n");
  if (!a.file.empty()) write_png(a.file, a.file, drawer.read(queue));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::exit_code("pelage-bench-strands", argc, argv, [](bench::Arguments a) {
    Options o;
    const long strands = std::atol(a.at(2, "100000").c_str());
    o.rounds = std::atoi(a.at(4, "9").c_str());
    if (std::sscanf(a.at(3, "800x600").c_str(), "%5dx%5d", &o.width, &o.height) != 2 || a.count > 7 ||
        strands < 1 || strands > 4'000'000 || o.rounds < 1)
      return bench::wrong_usage(
          "pelage-bench-strands [MODEL [STRANDS [WIDTHxHEIGHT [ROUNDS [EXPAND:TARGET [PICTURE.png]]]]]]");
    o.model = a.at(1, "bunny");
    o.strands = std::size_t(strands);
    o.baseline = a.at(5, "-");
    o.file = a.at(6, "");
    return run(o);
  });
}
