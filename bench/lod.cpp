// pelage-bench-lod: measures the level of detail of pictures of strands (docs/strands.md, section "Level of
// detail").
//
// 1. The change of the mean coverage of the picture with 50, 25 and 10% of the strands, relative to all
//    strands, at the distance at which the dolly has this fraction, and at the distance 1, where the object
//    fills the picture. The times of these pictures.
// 2. The mean coverage for 1 to 7 segments per strand.
// 3. A dolly of 120 frames in which the camera moves away, and the fraction of the strands falls from 100% to
//    10%, because the drawn strands keep the width LEAST (scene key strands.least_width). Let e be a picture
//    minus the reference: the picture of all strands with 4 x 4 times as many pixels, of which each 4 x 4
//    pixels are averaged. Popping is the root mean square of e[t + 1] - e[t], for red, green and blue. The
//    program compares the clip with the same clip of all strands. It prints the popping of the whole clip and
//    of each quarter.
//
// Usage: pelage-bench-lod [MODEL [STRANDS [WIDTHxHEIGHT [LEAST [PICTURES]]]]]. LEAST is in pixels. The dolly
// begins at the distance at which the mean width of all strands is LEAST, and ends ten times as far away.
// PICTURES is a prefix of names of PNG files: the first, middle and last frame of the clip.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <optional>

#include "bench/program.hpp"
#include "bench/timing.hpp"
#include "harness/picture/png.hpp"
#include "harness/prepare/camera.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/strands/drawing/detail.hpp"
#include "harness/strands/groom/fur.hpp"
#include "harness/strands/opencl/drawer.hpp"

namespace {

using namespace pelage;

constexpr int frames = 120, finer = 4;

struct Options {
  std::string model;
  std::size_t strands = 0;
  int width = 0, height = 0;
  double least = 0.125;
  std::string pictures;
};

/// A picture that is `finer` times as wide and high, averaged.
Picture averaged(const Picture& fine) {
  Picture picture{fine.width / finer, fine.height / finer, {}};
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      glm::vec4 sum(0);
      for (int i = 0; i < finer * finer; ++i)
        sum += fine.pixel[std::size_t(y * finer + i / finer) * std::size_t(fine.width) +
                          std::size_t(x * finer + i % finer)];
      picture.pixel.push_back(sum / float(finer * finer));
    }
  return picture;
}

std::vector<glm::vec4> difference(const Picture& a, const Picture& b) {
  std::vector<glm::vec4> e;
  for (std::size_t i = 0; i < a.pixel.size(); ++i) e.push_back(a.pixel[i] - b.pixel[i]);
  return e;
}

/// The sum of the squares of the differences of two errors, over red, green and blue.
double square_of_change(const std::vector<glm::vec4>& before, const std::vector<glm::vec4>& now) {
  double sum = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double change = double(now[i][c]) - double(before[i][c]);
      sum += change * change;
    }
  return sum;
}

double mean_coverage(const Picture& picture) {
  double sum = 0;
  for (const glm::vec4& pixel : picture.pixel) sum += double(pixel.w);
  return sum / double(picture.pixel.size());
}

class Views {
 public:
  Views(const cl::Queue& queue, const Options& a, const Mesh& mesh, const strands::Fur& fur, float reach,
        int scale)
      : queue_(queue), reach_(reach), spread_(strands::spread_of(fur.strands, mesh)) {
    scene_.image.width = a.width * scale;
    scene_.image.height = a.height * scale;
    framed_ = make_camera(scene_.camera, scene_.image, mesh.position, reach_ - 1);
    drawer_.emplace(queue, at(1, 1), fur.strands, fur.keys.size());
    const std::vector<float> keys = strands::key_records(fur.keys);
    drawer_->keys().write(queue, keys);
  }
  /// Returns the view from `distance` times the distance from which the object fills the picture.
  strands::DrawingScene at(double distance, float fraction) const {
    CameraScene camera = scene_.camera;
    camera.framed = false;
    const glm::dvec3 forward(framed_.ray), eye(framed_.eye);
    const double depth = double(framed_.row_w.w);
    const glm::dvec3 target = eye + depth * forward;
    camera.target = glm::vec3(target);
    camera.eye = glm::vec3(target - distance * depth * forward);
    strands::DrawingScene view;
    view.camera = make_camera(camera, scene_.image, {}, 0);
    view.range = strands::depth_range(view.camera, reach_);
    view.look.fraction = fraction;
    view.look.width_factor = strands::overlap_factor(view.camera, view.look, spread_);
    return view;
  }
  Picture draw(const strands::DrawingScene& view) {
    drawer_->set_view(view);
    drawer_->enqueue(queue_, nullptr);
    return drawer_->read(queue_);
  }
  Picture draw(double distance, float fraction) { return draw(at(distance, fraction)); }
  /// Returns the distance at which the mean width of all strands is `pixels` pixels.
  double distance_of_width(double pixels) const {
    return double(spread_.width) / (double(framed_.pixel) * double(framed_.row_w.w) * pixels);
  }
  /// Returns the part of the strands that the scene key strands.least_width leaves at a distance.
  float fraction(double distance, double least) const {
    return strands::fraction_on_screen(at(distance, 1).camera, spread_, float(least));
  }
  bench::Time time(double distance, float fraction) {
    drawer_->set_view(at(distance, fraction));
    bench::Time least{1e30, 1e30};
    for (int round = 0; round < 7; ++round) {
      const bench::Time t = bench::timed([&] {
        drawer_->enqueue(queue_, nullptr);
        queue_.finish();
      });
      least = {std::min(least.wall_ms, t.wall_ms), std::min(least.cpu_ms, t.cpu_ms)};
    }
    return least;
  }

 private:
  const cl::Queue& queue_;
  float reach_;
  strands::Spread spread_;
  Scene scene_;
  Camera framed_;
  std::optional<strands::Drawer> drawer_;
};

void dolly(Views& views, Views& fine, const Options& a) {
  std::array<double, 4> pruned{}, all{};  // sums of squares per quarter of the clip
  std::vector<glm::vec4> pruned_before, all_before;
  const double nearest = views.distance_of_width(a.least);
  for (int t = 0; t < frames; ++t) {
    const double distance = nearest * std::pow(10, double(t) / (frames - 1));
    const float fraction = views.fraction(distance, a.least);
    const Picture reference = averaged(fine.draw(distance, 1));
    const Picture picture = views.draw(distance, fraction);
    const std::vector<glm::vec4> e = difference(picture, reference),
                                 e_all = difference(views.draw(distance, 1), reference);
    if (t > 0) {
      pruned[std::size_t((t - 1) * 4 / (frames - 1))] += square_of_change(pruned_before, e);
      all[std::size_t((t - 1) * 4 / (frames - 1))] += square_of_change(all_before, e_all);
    }
    pruned_before = e;
    all_before = e_all;
    if (!a.pictures.empty() && (t == 0 || t == frames / 2 || t == frames - 1)) {
      write_png(fmt::format("{}-{:03}.png", a.pictures, t), "", picture);
      write_png(fmt::format("{}-{:03}-reference.png", a.pictures, t), "", reference);
    }
  }
  const double values = 3.0 * a.width * a.height * (frames - 1);
  double pruned_sum = 0, all_sum = 0;
  for (std::size_t q = 0; q < 4; ++q) {
    fmt::print("dolly, quarter {}: RMS of the change of the error {:.6f}, all strands {:.6f}, ratio {:.2f}\n",
               q + 1, std::sqrt(4 * pruned[q] / values), std::sqrt(4 * all[q] / values),
               std::sqrt(pruned[q] / all[q]));
    pruned_sum += pruned[q];
    all_sum += all[q];
  }
  fmt::print("dolly: RMS of the change of the error {:.6f}, all strands {:.6f}, ratio {:.2f}\n",
             std::sqrt(pruned_sum / values), std::sqrt(all_sum / values), std::sqrt(pruned_sum / all_sum));
}

int run(const Options& a) {
  Scene scene;
  scene.model = a.model;
  const auto mesh = load_scene_mesh(scene, [](const std::string& text) { fmt::print(stderr, "{}\n", text); });
  StrandLayerScene& layer = scene.strands.layers.front();
  layer.count = int(a.strands);
  const auto input = prepare(scene, mesh);
  const strands::Fur fur = strands::grow(*mesh, scene.strands, input->coat);
  const float reach = 1 + layer.length * (1 + layer.length_spread);
  const cl::Device device = cl::choose_device("");
  const cl::Queue queue(device);
  Views views(queue, a, *mesh, fur, reach, 1), fine(queue, a, *mesh, fur, reach, finer);
  fmt::print("{}, {} strands, {}x{}, least width {} pixels\n", a.model, a.strands, a.width, a.height,
             a.least);
  for (const float fraction : {1.0f, 0.5f, 0.25f, 0.1f}) {
    const double far = views.distance_of_width(a.least) / double(fraction);
    const auto change = [&](double distance) {
      return 100 *
             (mean_coverage(views.draw(distance, fraction)) / mean_coverage(views.draw(distance, 1)) - 1);
    };
    const bench::Time time = views.time(1, fraction);
    fmt::print(
        "fraction {:.0f}%: mean coverage {:+.2f}% at the distance {:.2f}, {:+.2f}% at the distance 1; wall "
        "{:.2f} ms, CPU {:.2f} ms at the distance 1\n",
        100 * fraction, change(far), far, change(1), time.wall_ms, time.cpu_ms);
  }
  for (int segments = 1; segments <= 7; ++segments) {
    strands::DrawingScene view = views.at(4, 1);
    view.look.segments = segments;
    fmt::print("{} segments at 4 times the distance: mean coverage {:.5f} ({} on the screen)\n", segments,
               mean_coverage(views.draw(view)),
               strands::segments_on_screen(view.camera, view.range, layer.length, 7));
  }
  dolly(views, fine, a);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::exit_code("pelage-bench-lod", argc, argv, [](bench::Arguments a) {
    Options o;
    const long strands = std::atol(a.at(2, "100000").c_str());
    o.least = std::atof(a.at(4, "0.125").c_str());
    if (std::sscanf(a.at(3, "320x240").c_str(), "%5dx%5d", &o.width, &o.height) != 2 || a.count > 6 ||
        strands < 1 || strands > 4'000'000 || !(o.least > 0))
      return bench::wrong_usage("pelage-bench-lod [MODEL [STRANDS [WIDTHxHEIGHT [LEAST [PICTURES]]]]]");
    o.model = a.at(1, "bunny");
    o.strands = std::size_t(strands);
    o.pictures = a.at(5, "");
    return run(o);
  });
}
