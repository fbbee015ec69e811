#include "harness/prepare/coat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/error.hpp"
#include "harness/prepare/picture_map.hpp"
#include "harness/prepare/random.hpp"

namespace pelage {
namespace {

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Returns the distance from p to the nearest of a set of random points. Each cell of a grid with cells of
/// size 1 contains one of these points.
double spot_distance(glm::dvec3 p, std::uint32_t seed) {
  const Random random(seed, 0x5907u);
  const glm::dvec3 cell = glm::floor(p);
  double least = 1e30;
  for (int k = 0; k < 27; ++k) {
    const glm::dvec3 c = cell + glm::dvec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    auto word = [](double x) { return std::uint64_t(std::int64_t(x)) & 0x1fffffu; };
    const std::uint64_t id = word(c.x) | word(c.y) << 21 | word(c.z) << 42;
    const glm::dvec3 jitter(random.uniform(id, 0), random.uniform(id, 1), random.uniform(id, 2));
    least = std::min(least, glm::distance(p, c + 0.15 + 0.7 * jitter));
  }
  return least;
}

/// A function that returns the weight of the coat's second colour at a point, 0..1. p: position of the point
/// in units of the pattern's size.
using Pattern = double (*)(glm::dvec3 p, std::uint32_t seed);

double plain(glm::dvec3, std::uint32_t) {
  return 0;
}

double patches(glm::dvec3 p, std::uint32_t seed) {
  return smoothstep(-0.45, 0.45, fractal_noise(p, seed));
}

double stripes(glm::dvec3 p, std::uint32_t seed) {
  const double bent = p.x + 0.35 * fractal_noise(1.5 * p, seed) + 0.12 * noise(6.0 * p, seed + 5u);
  const double wave = std::sin(2.0 * std::numbers::pi * bent);
  return smoothstep(0.1, 0.45, wave + 0.35 * noise(2.0 * p, seed + 9u));
}

double spots(glm::dvec3 p, std::uint32_t seed) {
  const double ragged = spot_distance(p, seed) + 0.08 * noise(5.0 * p, seed + 3u);
  return 1.0 - smoothstep(0.28, 0.36, ragged);
}

double grass(glm::dvec3 p, std::uint32_t seed) {
  return std::clamp(0.5 + 0.9 * fractal_noise(2.0 * p, seed), 0.0, 1.0);
}

Pattern pattern_of(const std::string& name) {
  if (name == "plain") return plain;
  if (name == "patches") return patches;
  if (name == "stripes") return stripes;
  if (name == "spots") return spots;
  if (name == "grass") return grass;
  throw InputError(fmt::format(
      "coat.pattern: '{}' is not known; use \"plain\", \"patches\", \"stripes\", \"spots\" or \"grass\"",
      name));
}

std::uint8_t byte(double value) {
  return std::uint8_t(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

CoatTexture painted(const Mesh& mesh, const CoatScene& coat) {
  const Pattern pattern = pattern_of(coat.pattern);
  const glm::dvec3 first(coat.colour), second(coat.second);
  CoatTexture out;
  out.size = coat.texture;
  for (const glm::vec3& point : surface_map(mesh, coat.texture)) {
    const double share = pattern(glm::dvec3(point) / double(coat.scale), coat.seed);
    const glm::dvec3 colour = first + (second - first) * share;
    out.texel.push_back({byte(colour.x), byte(colour.y), byte(colour.z), 255});
  }
  return out;
}

/// Returns a colour value of the picture as screens show it (Picture::gamma). The intensities of a screen are
/// the values to the power of 2.2.
double shown(const Picture& picture, float value) {
  if (picture.gamma == 0) return double(value);
  return std::pow(double(value), double(picture.gamma) / 2.2);
}

/// Reads a coat texture. The texture is a square. Its side is the longer side of the picture, but at most
/// 4096 texels; a picture that is not square is stretched. The picture's top row is at v = 1.
CoatTexture from_picture(const std::filesystem::path& path) {
  const PictureMap picture(path);
  CoatTexture out;
  out.size = std::min(std::max(picture.width(), picture.height()), 4096);
  for (int j = 0; j < out.size; ++j)
    for (int i = 0; i < out.size; ++i) {
      const glm::vec4 c = picture.at({(i + 0.5) / out.size, (j + 0.5) / out.size});
      const auto value = [&](float stored) { return byte(shown(picture.picture(), stored)); };
      out.texel.push_back({value(c.x), value(c.y), value(c.z), 255});
    }
  return out;
}

}  // namespace

CoatTexture make_coat(const Mesh& mesh, const CoatScene& coat) {
  return coat.image.empty() ? painted(mesh, coat) : from_picture(coat.image);
}

glm::dvec3 coat_colour(const CoatTexture& coat, glm::dvec2 uv) {
  const double px = uv.x * coat.size - 0.5, py = uv.y * coat.size - 0.5;
  const auto wrapped = [&](double place) {
    const int i = int(std::floor(place)) % coat.size;
    return std::size_t(i < 0 ? i + coat.size : i);
  };
  const auto texel = [&](std::size_t x, std::size_t y) {
    const auto& t = coat.texel[y * std::size_t(coat.size) + x];
    return glm::dvec3(t[0], t[1], t[2]);
  };
  const std::size_t x0 = wrapped(px), x1 = wrapped(px + 1), y0 = wrapped(py), y1 = wrapped(py + 1);
  const double u = px - std::floor(px), v = py - std::floor(py);
  const glm::dvec3 low = texel(x0, y0) + u * (texel(x1, y0) - texel(x0, y0));
  const glm::dvec3 high = texel(x0, y1) + u * (texel(x1, y1) - texel(x0, y1));
  return (low + v * (high - low)) / 255.0;
}

}  // namespace pelage
