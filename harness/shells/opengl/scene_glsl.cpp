// Computes the shaders' constants, definitions and layer table from the scene (docs/shells.md, sections 3, 4
// and 6).
#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/prepare/fur_texture.hpp"
#include "harness/scene/shading_models.hpp"
#include "harness/shells/opengl/program.hpp"

namespace pelage::gl {
namespace {

std::vector<float> list(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

/// Returns a row of the camera matrix times `factor`. With the factor 2 / (width or height of the picture),
/// the row gives screen positions in the range -1..1 instead of pixels.
std::vector<float> scaled(const glm::vec4& row, double factor) {
  std::vector<float> out;
  out.reserve(4);
  for (int i = 0; i < 4; ++i) out.push_back(float(double(row[i]) * factor));
  return out;
}

/// The control points of a strand's Bezier curve are the root, root + a and root + b (docs/shells.md, section
/// 3). Returns x and y such that x a + y b is the point of the curve at height h, relative to the root.
glm::dvec2 bezier_at(double h, const std::string& spacing) {
  const double t = spacing == "uniform" ? 1.0 - std::sqrt(1.0 - h) : h;
  return {2.0 * t * (1.0 - t), t * t};
}

std::string upper_case(std::string text) {
  for (char& letter : text) letter = char(std::toupper(static_cast<unsigned char>(letter)));
  return text;
}

}  // namespace

std::vector<Constant> scene_constants(const FrameInput& input) {
  const Scene& scene = input.scene;
  const Camera& camera = input.camera;
  const ShadingScene& shading = scene.shading;
  const double width = double(camera.width), height = double(camera.height);
  const glm::dvec3 ray = glm::dvec3(camera.ray) - 0.5 * width * glm::dvec3(camera.ray_dx) -
                         0.5 * height * glm::dvec3(camera.ray_dy);
  const double footprint = double(scene.fur.tile) * double(input.fur.size) * double(camera.pixel);
  std::vector<Constant> all{
      {"CAMERA_X", scaled(camera.row_x, 2.0 / width)},
      {"CAMERA_Y", scaled(camera.row_y, 2.0 / height)},
      {"CAMERA_W", scaled(camera.row_w, 1.0)},
      {"NEAR", {camera.near}},
      {"GRID", {float(128.0 * width), float(128.0 * height)}},  // half of the picture's size, in 1/256 pixel
      {"RAY", list(glm::vec3(ray))},
      {"RAY_DX", list(camera.ray_dx)},
      {"RAY_DY", list(camera.ray_dy)},
      {"FUR_SCALE", {input.fur_scale.x, input.fur_scale.y}},
      {"LEVEL", {float(std::log2(footprint) + double(scene.fur.lod_bias))}},
      {"FUR_TEXELS", {float(input.fur.size)}},
      {"CLUMP_GAIN", {scene.clump.gain}},
      {"SOAKED", {scene.soaked.threshold}},
      {"FILM_HEIGHT", {scene.soaked.height}},
      {"FILM_GLOSS", {scene.soaked.gloss}},
      {"DENSITY", {scene.fur.density}},
      {"COVERAGE_POWER", {float(coverage_power(scene.fur))}},
      {"SKIN_COLOUR", list(scene.coat.skin)},
      {"SPECULAR", list(shading.specular)},
      {"EXPONENT", {shading.exponent}},
      {"AMBIENT", {shading.ambient}},
      {"WRAP", {shading.wrap}},
      {"SHADOW", {shading.shadow}},
      {"OCCLUSION", {shading.occlusion}},
      {"DARKENING", {shading.darkening}},
      {"WET_SPECULAR", {shading.wet_specular}},
  };
  for (std::size_t i = 0; i < shading.lights.size(); ++i) {
    const glm::dvec3 direction(shading.lights[i].direction);
    all.push_back({fmt::format("LIGHT_{}", i), list(glm::vec3(glm::normalize(direction)))});
    all.push_back({fmt::format("INTENSITY_{}", i), {shading.lights[i].intensity}});
  }
  return all;
}

std::string scene_defines(const FrameInput& input, const OpenGlOptions& options, bool wet) {
  const Scene& scene = input.scene;
  std::string text;
  const auto define = [&text](bool wanted, const std::string& what) {
    if (wanted) text += "#define " + what + "\n";
  };
  define(true, fmt::format("LAYERS {}", scene.fur.layers));
  define(true, fmt::format("LIGHTS {}", scene.shading.lights.size()));
  define(options.draws == "instanced", "INSTANCED");
  define(options.fur == "array", "FUR_ARRAY\n#define FUR_SAMPLER sampler2DArray");
  define(options.fur == "volume", "FUR_VOLUME\n#define FUR_SAMPLER sampler3D");
  define(options.discard == "yes", "DISCARD");
  const float exponent = scene.shading.exponent;
  define(exponent == std::floor(exponent) && exponent >= 1.0f && exponent <= 1024.0f,
         fmt::format("WHOLE_EXPONENT {}", int(exponent)));
  define(scene.curl.radius > 0.0f, "CURLS");
  define(scene.curl.radius > 0.0f && !input.style.curl_turns.empty(), "TURNS_MAP");
  define(scene.fur.density < 1.0f || !input.style.density.value.empty(), "THINNED");
  define(!input.style.density.value.empty(), "DENSITY_MAP");
  define(coverage_power(scene.fur) != 1, "FRAGMENT_CORRECTION");
  define(scene.fur.shade == 0.0f, "EVEN_SHADE");
  define(wet, "CLUMPS");
  define(true, fmt::format("CLUMP_READING CLUMP_{}", upper_case(scene.clump.scale)));
  define(true, fmt::format("TANGENT_READING TANGENT_{}", upper_case(scene.shading.tangent)));
  define(scene.clump.cells == "separate", "SEPARATE_CELLS");
  define(scene.clump.cells == "consistent", "CONSISTENT_CELLS");
  define(wet && scene.soaked.threshold < 1.0f, "SOAKED_FUR");
  define(shading_model(scene.shading.model).surface_light, "WET_MODEL");
  define(scene.shading.sides == "two", "TWO_SIDED");
  return text + contact_defines(input);
}

std::vector<glm::vec4> layer_table(const Scene& scene) {
  const FurScene& fur = scene.fur;
  const double layers = double(fur.layers), w = double(scene.clump.shape);
  const double omega = 2.0 * std::numbers::pi * double(scene.curl.turns);
  const double shadow = double(scene.shading.shadow);
  std::vector<glm::vec4> rows;
  glm::dvec2 bend_below(0.0);
  double rate_below = 0.0;
  for (int n = 0; n < fur.layers; ++n) {
    const double h = (1.0 + double(n)) / layers;
    const glm::dvec2 bend = bezier_at(h, fur.layer_spacing);
    const double rate = (1.0 - w) * h + w * clump_curve(scene.clump.function, h, fur.layers);  // f(h)
    const double gamma = shading_model(scene.shading.model).surface_light
                             ? 1.0 + double(scene.shading.occlusion) * (h - 1.0)
                             : (shadow - 1.0 + h) / shadow;
    rows.emplace_back(bend.x, bend.y, h * std::cos(omega * h), h * std::sin(omega * h));
    rows.emplace_back(bend.x - bend_below.x, bend.y - bend_below.y, 0.0, 0.0);
    rows.emplace_back(rate, rate - rate_below, gamma, double(n));
    bend_below = bend;
    rate_below = rate;
  }
  return rows;
}

}  // namespace pelage::gl
