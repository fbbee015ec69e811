#include "harness/shells/opencl/params.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>

#include "harness/cl/program.hpp"
#include "harness/scene/shading_models.hpp"
#include "harness/shells/opencl/style_table.hpp"

namespace pelage::shells {
namespace {

/// Returns the index of a name in a list. The enumerations of kernels/rasterize/params.h have the same order.
template <class List>
int place_of(const std::string& name, const List& list) {
  return int(std::find(std::begin(list), std::end(list), name) - std::begin(list));
}

using cl::copy;

}  // namespace

SimulateParams simulate_params(const Scene& scene, const Geometry& geometry) {
  const DynamicsScene& d = scene.dynamics;
  const glm::vec3 wind =
      d.wind.strength == 0.0f ? glm::vec3(0.0f) : d.wind.strength * glm::normalize(d.wind.direction);
  SimulateParams p{};
  p.length = scene.fur.length;
  p.stiffness = d.stiffness;
  p.drag = d.drag;
  p.inverse_mass = 1.0f / d.mass;
  p.step = d.step;
  p.weight_x = d.mass * d.gravity.x;
  p.weight_y = d.mass * d.gravity.y;
  p.weight_z = d.mass * d.gravity.z;
  p.wind_x = wind.x;
  p.wind_y = wind.y;
  p.wind_z = wind.z;
  p.gust = d.wind.gust;
  p.stride = geometry.strands;
  p.substeps = d.substeps;
  return p;
}

std::vector<float> gust_table(const DynamicsScene& dynamics, int frame) {
  std::vector<float> table;
  for (int i = 0; i < dynamics.substeps; ++i) {
    const double time = (double(frame) * dynamics.substeps + i) * double(dynamics.step);
    const double angle = 2.0 * std::numbers::pi * double(dynamics.wind.frequency) * time;
    table.push_back(float(std::sin(angle)));
    table.push_back(float(std::cos(angle)));
  }
  return table;
}

std::vector<float> layer_table(const Scene& scene) {
  const int layers = scene.fur.layers;
  const double omega = 2.0 * std::numbers::pi * double(scene.curl.turns);
  const double power = scene.dynamics.bend == "linear" ? 1.0 : double(scene.dynamics.bend_power);
  std::vector<float> table(std::size_t(LAYER_COLUMNS) * std::size_t(layers));
  for (int n = 0; n < layers; ++n) {
    const double h = (1.0 + n) / layers;
    float* row = &table[std::size_t(LAYER_COLUMNS) * std::size_t(n)];
    row[LAYER_H] = float(h);
    row[LAYER_COS] = float(std::cos(omega * h));
    row[LAYER_SIN] = float(std::sin(omega * h));
    row[LAYER_LOG] = float(std::log(h));
    row[LAYER_POWER] = float(std::pow(h, power));
  }
  return table;
}

RasterParams raster_params(const FrameInput& input, const Geometry& geometry) {
  const Scene& scene = input.scene;
  const Camera& camera = input.camera;
  RasterParams p{};
  p.width = camera.width;
  p.height = camera.height;
  copy(p.row_x, camera.row_x);
  copy(p.row_y, camera.row_y);
  copy(p.row_w, camera.row_w);
  copy(p.ray, camera.ray);
  copy(p.ray_dx, camera.ray_dx);
  copy(p.ray_dy, camera.ray_dy);
  p.near_depth = camera.near;
  p.vertices = geometry.vertices;
  p.triangles = geometry.triangles;
  p.layers = scene.fur.layers;
  p.uniform_spacing = scene.fur.layer_spacing == "uniform";
  p.sticks = has_springs(scene.dynamics);
  p.faces = place_of(scene.blend.faces, face_orders);
  if (by_depth(scene.blend) && p.faces == FACES_BACK_THEN_FRONT) p.faces = FACES_ALL;  // the depth decides
  p.sweeps = p.end_sweep = p.faces == FACES_BACK_THEN_FRONT ? 2 : 1;
  p.length = scene.fur.length;
  p.curl_radius = scene.curl.radius;
  p.mask_size = scene.wetness.size;
  p.clump_shape = scene.clump.shape;
  p.clump_gain = scene.clump.gain;
  p.clump_reading = place_of(scene.clump.scale, clump_scales);
  p.clump_cells = place_of(scene.clump.cells, clump_borders);
  p.film = scene.soaked.threshold < 1.0f;
  p.soaked = scene.soaked.threshold;
  p.film_height = scene.soaked.height;
  p.film_gloss = scene.soaked.gloss;
  p.log_layers = float(std::log(double(scene.fur.layers)));
  place_maps(input, geometry, p);
  p.fur_size = input.fur.size;
  p.fur_levels = int(input.fur.level.size());
  p.fur_scale[0] = input.fur_scale.x;
  p.fur_scale[1] = input.fur_scale.y;
  p.footprint = camera.pixel * scene.fur.tile * float(input.fur.size) * std::exp2(scene.fur.lod_bias);
  p.substeps = scene.fur.substeps;
  p.coat_size = input.coat.size;
  const ShadingModel& model = shading_model(scene.shading.model);
  p.surface_light = model.surface_light;
  p.two_sided = scene.shading.sides == "two";
  p.shadow = scene.shading.shadow;
  copy(p.specular, scene.shading.specular);
  p.exponent = scene.shading.exponent;
  p.whole_exponent = p.surface_light ? 0 : cl::whole_exponent(p.exponent);
  p.ambient = scene.shading.ambient;
  p.wrap = scene.shading.wrap;
  p.occlusion = scene.shading.occlusion;
  p.darkening = scene.shading.darkening;
  p.wet_specular = scene.shading.wet_specular;
  p.tangent = place_of(scene.shading.tangent, tangent_readings);
  p.lights = int(scene.shading.lights.size());
  for (std::size_t i = 0; i < scene.shading.lights.size() && i < 2; ++i) {
    copy(p.light[i], glm::normalize(scene.shading.lights[i].direction));
    p.intensity[i] = scene.shading.lights[i].intensity;
  }
  // The shading model of Banisch and Wüthrich (2006), section 3, is the model "wet" without three of its
  // terms: the highlight, the wrapped light and the darkening by wetness.
  if (model.plain) {
    copy(p.specular, glm::vec3(0.0f));
    p.wrap = 0;
    p.darkening = 0;
  }
  copy(p.skin, scene.coat.skin);
  copy(p.background, scene.image.background);
  return p;
}

}  // namespace pelage::shells
