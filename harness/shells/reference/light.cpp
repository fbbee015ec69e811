#include "harness/shells/reference/light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/prepare/fur_texture.hpp"
#include "harness/shells/reference/textures.hpp"
#include "harness/shells/reference/vector.hpp"

namespace pelage::reference {

double light_through(const FrameInput& input, const LightRay& ray) {
  const Scene& scene = input.scene;
  if (scene.shading.self_shadow != "traced") return 1.0;
  const glm::dvec3 light = unit(glm::dvec3(scene.shading.lights.front().direction));
  const double cosine = glm::dot(ray.normal, light);
  double through = std::clamp(0.5 + 2.0 * cosine, 0.0, 1.0);
  const int last = scene.fur.layers - 1;
  // Each sample stands for `every` layers.
  const int every = std::max(1, int(std::ceil(double(last - ray.layer) / 16.0)));
  for (int m = ray.layer + every; through > 0.0 && m <= last; m += every) {
    const glm::dvec3 rise = ray.rise(m);
    const glm::dvec3 delta = glm::dot(rise, ray.normal) / std::max(cosine, 0.25) * light - rise;
    const glm::dvec2 root = ray.root + uv_shares(delta, ray.t, ray.b) + ray.pull(m);
    const double coverage =
        sample_fur(input.fur, root * glm::dvec2(input.fur_scale), m, ray.level, coverage_power(scene.fur))
            .coverage *
        double(scene.fur.density) * sample_density(input.style.density, root);
    through *= std::pow(1.0 - coverage, double(every));
  }
  return through;
}

}  // namespace pelage::reference
