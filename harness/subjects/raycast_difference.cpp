#include "harness/compare/metrics.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/subjects/in_turns.hpp"
#include "harness/system/strands/backends.hpp"

namespace pelage {
namespace {

constexpr int coarse = 8;  // pixels per side of the squares whose means are compared

/// The ray-cast picture of the strands that a picture of all strands shows.
struct Truth {
  Picture picture;
  double hits_per_ray = 0;  ///< over the rays of fur pixels
};

double luma(const glm::vec4& p) {
  return 0.2126 * double(p.x) + 0.7152 * double(p.y) + 0.0722 * double(p.z);
}

std::size_t fur_pixels(const Picture& picture) {
  std::size_t count = 0;
  for (const glm::vec4& pixel : picture.pixel) count += pixel.w > 0;
  return count;
}

/// Returns the means of squares of `side` x `side` pixels that are entirely inside the picture.
Picture block_means(const Picture& picture, int side) {
  Picture means{picture.width / side, picture.height / side, {}};
  for (int y = 0; y < means.height; ++y)
    for (int x = 0; x < means.width; ++x) {
      glm::vec4 sum(0);
      for (int i = 0; i < side * side; ++i) sum += picture.at(x * side + i % side, y * side + i / side);
      means.pixel.push_back(sum / float(side * side));
    }
  return means;
}

/// Returns the mean of the luma of `a` minus that of `b`, over the pixels that have fur in one of them.
double mean_difference(const Picture& a, const Picture& b) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixel.size(); ++i) {
    if (!(a.pixel[i].w > 0 || b.pixel[i].w > 0)) continue;
    sum += luma(a.pixel[i]) - luma(b.pixel[i]);
    ++count;
  }
  return count > 0 ? sum / double(count) : 0;
}

Truth ray_cast(const Scene& scene, const std::shared_ptr<const Mesh>& mesh) {
  const strands::RaycastResult result = strands::raycast_strands(*strands::prepare_strands(scene, mesh));
  constexpr int samples = strands::rays.samples;
  const double all = double(fur_pixels(result.picture)) * samples * samples;
  return {result.picture, all > 0 ? double(result.hits) / all : 0};
}

class RaycastDifference : public Subject {
 public:
  RaycastDifference(std::unique_ptr<Subject> inner, std::function<Truth()> truth)
      : inner_(std::move(inner)), make_truth_(std::move(truth)) {}

  FrameSample frame() override { return inner_->frame(); }
  Picture read() override { return inner_->read(); }
  std::vector<Check> check(const Picture& timed) override {
    std::vector<Check> checks = inner_->check(timed);
    const Truth truth = make_truth_();
    psnr_ = compare(timed, truth.picture).psnr;
    coarse_psnr_ = compare(block_means(timed, coarse), block_means(truth.picture, coarse)).psnr;
    mean_ = mean_difference(timed, truth.picture);
    hits_ = truth.hits_per_ray;
    pixels_ = double(fur_pixels(timed));
    return checks;
  }
  void describe(Row& row) override {
    inner_->describe(row);
    row.metrics["raycast_psnr"] = {psnr_, "dB"};
    row.metrics["raycast_coarse_psnr"] = {coarse_psnr_, "dB"};
    row.metrics["raycast_mean"] = {mean_, "1"};
    row.metrics["raycast_overdraw"] = {hits_, "strands"};
    if (row.metrics.contains("covered_fragments") && pixels_ > 0)
      row.metrics["overdraw"] = {row.metrics["covered_fragments"].value / pixels_, "fragments"};
  }

 private:
  std::unique_ptr<Subject> inner_;
  std::function<Truth()> make_truth_;
  double psnr_ = 0, coarse_psnr_ = 0, mean_ = 0, hits_ = 0, pixels_ = 0;
};

}  // namespace

std::unique_ptr<Subject> against_raycast(SubjectContext& context, const Case& which,
                                         std::unique_ptr<Subject> drawn) {
  Scene scene = scene_of(context.experiment, which);
  scene.strands.fraction = 1;  // the ray-cast picture shows all strands
  scene.strands.least_width = 0;
  scene.fur = {};  // strands use no key of the fur of layers
  const auto mesh = context.mesh_of(scene);
  strands::refuse_frames(*mesh);
  // Cases that differ only in the fraction or in the layers share the ray-cast picture.
  const std::string key = "raycast " + scene_hash(scene) + mesh->hash;
  return std::make_unique<RaycastDifference>(std::move(drawn), [&context, scene, mesh, key] {
    std::any& kept = context.shared[key];
    if (!kept.has_value()) kept = ray_cast(scene, mesh);
    return std::any_cast<Truth>(kept);
  });
}

}  // namespace pelage
