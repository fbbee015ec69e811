#include "harness/strands/drawing/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "harness/error.hpp"
#include "harness/prepare/coat.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage::strands {
namespace {

constexpr double depth_steps = 1 << 24;

void in_range(const char* what, float value, float least, float most) {
  if (!(value >= least && value <= most))  // also true for NaN
    throw InputError(fmt::format("{}: {}; it must be from {} to {}", what, value, least, most));
}

}  // namespace

DepthRange depth_range(const Camera& camera, float radius) {
  const double centre = camera.row_w.w;  // view depth of the object's origin
  const double nearest = std::max(double(camera.near), centre - double(radius));
  const double furthest = std::max(centre + double(radius), nearest + 1e-3 * double(radius));
  return {float(nearest), float((depth_steps - 1) / (furthest - nearest))};
}

std::array<double, 9> basis_at(glm::dvec3 n) {
  return {1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z, n.x * n.x - n.y * n.y};
}

bool has_lights(const Look& look) {
  return !look.fills.empty() || look.rim != glm::vec3(0) || look.skin_shadow != 0 || !look.film.empty() ||
         has_layer_looks(look);
}

bool has_layer_looks(const Look& look) {
  return std::ranges::any_of(look.layers, &LayerLook::has_own_look);
}

Irradiance irradiance_of(const Look& look) {
  using std::numbers::pi;
  // A_l times the square of the normalization of Y_lm, for each polynomial of basis_at().
  static constexpr std::array<double, 9> scale{
      pi / (4 * pi),          2 * pi / 3 * 3 / (4 * pi), 2 * pi / 3 * 3 / (4 * pi), 2 * pi / 3 * 3 / (4 * pi),
      pi / 4 * 15 / (4 * pi), pi / 4 * 15 / (4 * pi),    pi / 4 * 5 / (16 * pi),    pi / 4 * 15 / (4 * pi),
      pi / 4 * 15 / (16 * pi)};
  std::array<glm::dvec3, 9> sum{};
  for (const FillLight& fill : look.fills) {
    const std::array<double, 9> basis = basis_at(glm::normalize(glm::dvec3(fill.direction)));
    const std::size_t used = look.bands >= 2 ? 9 : 4;
    for (std::size_t i = 0; i < used; ++i) sum[i] += scale[i] * basis[i] * glm::dvec3(fill.colour);
  }
  Irradiance sh{};
  for (std::size_t i = 0; i < 9; ++i) sh[i] = glm::vec3(sum[i]);
  return sh;
}

LayerLook layer_look(const Look& look, int layer) {
  if (std::size_t(layer) < look.layers.size()) return look.layers[std::size_t(layer)];
  return {layer, 0, std::max(1, int(look.film.size()))};
}

int segments_of_part(const Look& look, float from, float to) {
  const float whole = float(look.own_segments ? 3 : look.strand_segments);
  // The difference keeps rounding errors of the part from adding a segment.
  const int share = int(std::ceil(whole * (to - from) - 1.0f / 1024));
  return std::min(std::max(share, look.own_segments ? 1 : 2), look.segments);
}

void check(const Look& look) {
  in_range("part of the strands that is drawn", look.fraction, 1e-6f, 1);
  in_range("factor of the widths", look.width_factor, 1e-6f, 1);
  in_range("number of segments", float(look.segments), 1, 7);
  in_range("number of segments of a whole strand", float(look.strand_segments), 1, 7);
  in_range("taper", look.taper, 0, 1);
  in_range("opacity", look.opacity, 0, 1);
  in_range("intensity of the key light", look.intensity, 0, 1000);
  in_range("ambient light", look.ambient, 0, 100);
  in_range("exponent of the highlight", look.exponent, 1, 10000);
  for (int axis = 0; axis < 3; ++axis) {
    in_range("specular colour", look.specular[axis], 0, 100);
    in_range("background", look.background[axis], 0, 1);
    in_range("direction of the key light", look.light[axis], -1e6f, 1e6f);
  }
  in_range("length of the direction of the key light", glm::length(look.light), 1e-6f, 1e7f);
  in_range("highest degree of the spherical harmonics", float(look.bands), 1, 2);
  in_range("exponent of the rim light", look.rim_exponent, 1, 1000);
  in_range("shadow of the skin", look.skin_shadow, 0, 1);
  in_range("height of the shadow of the skin", look.skin_shadow_height, 1e-3f, 1000);
  if (look.shadow.reading != Shadow::none) {
    in_range("texels per side of the opacity map", float(look.shadow.size), 16, 8192);
    in_range("mean length of the strands", look.shadow.length, 1e-6f, 1000);
    in_range("radius of the opacity map", look.shadow.radius, 1e-6f, 1e6f);
  }
  in_range("number of frames of the film strips", float(look.film.size()), 0, float(most_frames));
  in_range("number of fur layers", float(look.layers.size()), 0, float(most_layers));
  const int frames = std::max(1, int(look.film.size()));
  for (const LayerLook& layer : look.layers) {
    in_range("rank of a fur layer", float(layer.rank), 0, look.back_facing == BackFacing::last ? 254 : 255);
    in_range("opacity of a fur layer", look.opacity * layer.opacity, 0, 1);
    in_range("taper of a fur layer", look.taper * layer.taper, 0, 1);
    in_range("factor of the highlight of a fur layer", layer.gloss, 0, 1000);
    in_range("exponent of the highlight of a fur layer", look.exponent * layer.exponent, 1, 10000);
    for (int axis = 0; axis < 3; ++axis)
      in_range("factor of the rim light of a fur layer", layer.rim[axis], 0, 1000);
    in_range("exponent of the rim light of a fur layer", look.rim_exponent * layer.rim_exponent, 1, 1000);
    in_range("shadow of the skin of a fur layer", look.skin_shadow * layer.skin_shadow, 0, 1);
    in_range("first film frame of a fur layer", float(layer.first_frame), 0, float(frames - 1));
    in_range("number of film frames of a fur layer", float(layer.frames), 1,
             float(frames - layer.first_frame));
  }
  for (const FillLight& fill : look.fills)
    in_range("length of the direction of a fill light", glm::length(fill.direction), 1e-6f, 1e7f);
  for (int axis = 0; axis < 3; ++axis) {
    in_range("colour of the rim light", look.rim[axis], 0, 100);
    for (const FillLight& fill : look.fills) in_range("colour of a fill light", fill.colour[axis], 0, 1000);
  }
}

LightView light_view(const Look& look) {
  constexpr int margin = 2;  // texels
  const glm::dvec3 forward = -glm::normalize(glm::dvec3(look.light));
  const glm::dvec3 up = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, up)), down = glm::cross(forward, right);
  const double texel = 2 * double(look.shadow.radius) / (look.shadow.size - 2 * margin);
  LightView view;
  view.row_x = glm::vec4(glm::dvec4(right / texel, 0));
  view.row_y = glm::vec4(glm::dvec4(down / texel, 0));
  view.row_z = glm::vec4(glm::dvec4(forward, 0));
  view.texel = float(texel);
  view.size = look.shadow.size;
  return view;
}

MapRows map_rows(const Camera& camera, const Look& look) {
  const LightView light = light_view(look);
  // The columns of a matrix of GLM are the rows of the camera, so `camera_of` transposed maps (p, 1) to
  // (X, Y, W, 1).
  const glm::dmat4 camera_of(glm::dvec4(camera.row_x), glm::dvec4(camera.row_y), glm::dvec4(camera.row_w),
                             glm::dvec4(0, 0, 0, 1));
  const glm::dmat4 inverse = glm::inverse(camera_of);
  // row . (p, 1) = (row M^-1) . (X, Y, W, 1), with the matrix M whose rows are those of the camera.
  const auto from_view = [&](glm::dvec4 row) { return inverse * row; };
  const glm::dvec4 centre(0, 0, 0, 0.5 * light.size - 0.5);
  return {glm::vec4(from_view(glm::dvec4(light.row_x)) + centre),
          glm::vec4(from_view(glm::dvec4(light.row_y)) + centre),
          glm::vec4(from_view(glm::dvec4(light.row_z)))};
}

SkinSurface skin_surface(const Mesh& mesh, const CoatTexture& coat, glm::vec3 factor) {
  const Skin skin = weld(mesh);
  SkinSurface surface{mesh.position, {}, {}, mesh.triangle};
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    surface.normal.emplace_back(skin.normal[mesh.weld[v]]);
    surface.colour.emplace_back(coat_colour(coat, glm::dvec2(mesh.uv[v])) * glm::dvec3(factor));
  }
  return surface;
}

}  // namespace pelage::strands
