#include "harness/shells/opencl/params.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>

#include "harness/cl/program.hpp"
#include "harness/prepare/fur_texture.hpp"
#include "harness/scene/shading_models.hpp"

namespace pelage::shells {
namespace {

/// Returns the index of a name in a list. The enumerations of kernels/rasterize/params.h have the same order.
template <class List>
int place_of(const std::string& name, const List& list) {
  return int(std::find(std::begin(list), std::end(list), name) - std::begin(list));
}

using cl::copy;

// Packs four bytes into one word. `a` is the lowest byte.
std::int32_t word_of(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
  return static_cast<std::int32_t>(std::uint32_t(a) | std::uint32_t(b) << 8 | std::uint32_t(c) << 16 |
                                   std::uint32_t(d) << 24);
}

/// The factors of curl.turns of a scene's vertices: multiples of 1 / turn_steps from `first` to `last`.
struct Turns {
  int first, last;
  explicit Turns(const std::vector<float>& shares) {
    const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
    first = int(std::lround(*least * turn_steps));
    last = int(std::lround(*most * turn_steps));
  }
};

/// Appends the number of each vertex's factor of curl.turns, and the cosine and sine of the curl's angle for
/// each layer and factor.
void append_turns(const Scene& scene, const std::vector<float>& shares, std::vector<float>& table) {
  const Turns turns(shares);
  for (const float share : shares) table.push_back(float(std::lround(share * turn_steps) - turns.first));
  for (int n = 0; n < scene.fur.layers; ++n)
    for (int level = turns.first; level <= turns.last; ++level) {
      const float number = scene.curl.turns * (float(level) / turn_steps);
      const double angle = 2.0 * std::numbers::pi * double(number) * ((1.0 + n) / scene.fur.layers);
      table.push_back(float(std::cos(angle)));
      table.push_back(float(std::sin(angle)));
    }
}

}  // namespace

void set_forces(const DynamicsScene& d, SimulateParams& p) {
  const glm::vec3 wind =
      d.wind.strength == 0.0f ? glm::vec3(0.0f) : d.wind.strength * glm::normalize(d.wind.direction);
  p.weight_x = d.mass * d.gravity.x;
  p.weight_y = d.mass * d.gravity.y;
  p.weight_z = d.mass * d.gravity.z;
  p.wind_x = wind.x;
  p.wind_y = wind.y;
  p.wind_z = wind.z;
  p.gust = d.wind.gust;
}

SimulateParams simulate_params(const Scene& scene, const Geometry& geometry) {
  const DynamicsScene& d = scene.dynamics;
  SimulateParams p{};
  p.length = scene.fur.length;
  p.stiffness = d.stiffness;
  p.drag = d.drag;
  p.inverse_mass = 1.0f / d.mass;
  p.step = d.step;
  set_forces(d, p);
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
    row[LAYER_CURVE] = float(clump_curve(scene.clump.function, h, layers));
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
  p.arcs = p.sticks && scene.dynamics.bend == "trigonometric";
  p.faces = place_of(scene.blend.faces, face_orders);
  if (by_depth(scene.blend) && p.faces == FACES_BACK_THEN_FRONT) p.faces = FACES_ALL;  // the depth decides
  p.sweeps = p.end_sweep = p.faces == FACES_BACK_THEN_FRONT ? 2 : 1;
  p.length = scene.fur.length;
  p.curl_radius = scene.curl.radius;
  p.mask_size = scene.wetness.size;
  p.clump_shape = scene.clump.shape;
  p.clump_gain = scene.clump.gain;
  p.clump_scale = place_of(scene.clump.scale, clump_scales);
  p.clump_cells = place_of(scene.clump.cells, clump_cells);
  p.film = scene.soaked.threshold < 1.0f;
  p.soaked = scene.soaked.threshold;
  p.film_height = scene.soaked.height;
  p.film_gloss = scene.soaked.gloss;
  place_maps(input, geometry, p);
  p.fur_size = input.fur.size;
  p.fur_levels = int(input.fur.level.size());
  p.shaded = scene.fur.shade > 0;
  p.fur_scale[0] = input.fur_scale.x;
  p.fur_scale[1] = input.fur_scale.y;
  p.footprint = camera.pixel * scene.fur.tile * float(input.fur.size) * std::exp2(scene.fur.lod_bias);
  p.substeps = scene.fur.substeps;
  p.coat_size = input.coat.size;
  const ShadingModel& model = shading_model(scene.shading.model);
  p.surface_light = model.surface_light;
  p.self_shadow = place_of(scene.shading.self_shadow, self_shadows);
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

std::vector<std::int32_t> packed_fur(const FurTexture& fur) {
  std::size_t texels = 0;
  for (std::size_t l = 0; l < fur.level.size(); ++l)
    texels += fur.level[l].size() + fur.level[l].size() / std::size_t(fur.size >> l);
  std::vector<std::int32_t> words(texels);
  auto next = words.begin();
  const auto word = [](const auto& here, const auto& below) {
    return word_of(here[0], here[1], below[0], below[1]);
  };
  for (std::size_t l = 0; l < fur.level.size(); ++l) {
    const auto side = std::size_t(fur.size >> l);
    for (std::size_t n = 0; n < std::size_t(fur.layers); ++n) {
      const auto* slice = &fur.level[l][n * side * side];
      for (std::size_t y = 0; y < side; ++y) {
        const auto *here = slice + y * side, *below = slice + (y + 1) % side * side;
        for (std::size_t x = 0; x < side; ++x) *next++ = word(here[x], below[x]);
        *next++ = word(here[0], below[0]);
      }
    }
  }
  return words;
}

std::vector<std::int32_t> packed_coat(const CoatTexture& coat) {
  const auto side = std::size_t(coat.size);
  std::vector<std::int32_t> words;
  words.reserve(2 * (side + 2) * (side + 2));
  for (std::size_t y = 0; y < side + 2; ++y) {
    const auto *here = &coat.texel[(y + side - 1) % side * side], *below = &coat.texel[y % side * side];
    for (std::size_t x = 0; x < side + 2; ++x) {
      const auto &t = here[(x + side - 1) % side], &u = below[(x + side - 1) % side];
      words.push_back(word_of(t[0], t[1], u[0], u[1]));
      words.push_back(word_of(t[2], 0, u[2], 0));
    }
  }
  return words;
}

void place_maps(const FrameInput& input, const Geometry& geometry, RasterParams& params) {
  int end = LAYER_COLUMNS * params.layers;
  if (!geometry.turns.empty()) {
    const Turns turns(geometry.turns);
    params.turn_levels = turns.last - turns.first + 1;
    params.turn_points = end;
    params.turn_angles = end + int(geometry.turns.size());
    end = params.turn_angles + 2 * params.turn_levels * params.layers;
  }
  params.density = input.scene.fur.density;
  params.coverage_power = float(coverage_power(input.scene.fur));
  params.density_width = input.style.density.width;
  params.density_height = input.style.density.height;
  params.density_map = end;
}

std::vector<float> styled_layer_table(const FrameInput& input, const Geometry& geometry) {
  std::vector<float> table = layer_table(input.scene);
  if (!geometry.turns.empty()) append_turns(input.scene, geometry.turns, table);
  const std::vector<float>& density = input.style.density.value;
  table.insert(table.end(), density.begin(), density.end());
  return table;
}

}  // namespace pelage::shells
