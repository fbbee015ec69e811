#include "tests/support/synthetic.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace pelage::synthetic {
namespace {

constexpr double pi = std::numbers::pi;

glm::dvec3 derivative(const Surface& surface, double u, double v, double du, double dv) {
  const double e = 1e-5;
  return (surface.point(u + e * du, v + e * dv) - surface.point(u - e * du, v - e * dv)) / (2 * e);
}

FaceSprings strands(const Scene& scene, const Mesh& mesh) {
  FaceSprings set;
  std::vector<std::vector<std::pair<std::uint32_t, double>>> around(mesh.welded);
  const glm::dvec3 wind = glm::normalize(glm::dvec3(scene.dynamics.wind.direction));
  for (std::uint32_t f = 0; f < mesh.triangle.size(); ++f) {
    const glm::uvec3 t = mesh.triangle[f];
    const glm::dvec3 a(mesh.position[t.x]), b(mesh.position[t.y]), c(mesh.position[t.z]);
    const glm::dvec3 root = (a + b + c) / 3.0, cross = glm::cross(b - a, c - a), n = glm::normalize(cross);
    glm::dvec3 lean(scene.fur.comb_direction);
    lean -= glm::dot(lean, n) * n;
    if (glm::length(lean) > 1e-9) lean = glm::normalize(lean);
    const double phase = 2 * pi * glm::dot(root, wind) / double(scene.dynamics.wind.wavelength);
    set.root.emplace_back(root);
    set.normal.emplace_back(n);
    set.anchor.emplace_back(double(scene.fur.length) * glm::normalize(n + double(scene.fur.comb) * lean));
    set.phase.emplace_back(std::cos(phase), std::sin(phase));
    for (int k = 0; k < 3; ++k) around[mesh.weld[t[k]]].emplace_back(f, glm::length(cross));
  }
  set.row.push_back(0);
  for (const auto& faces : around) {
    double sum = 0;
    for (const auto& [face, area] : faces) sum += area;
    for (const auto& [face, area] : faces) {
      set.face.push_back(face);
      set.weight.push_back(float(area / sum));
    }
    set.row.push_back(std::uint32_t(set.face.size()));
  }
  return set;
}

/// Returns a unit normal for every surface point: the direction of the mean of its triangles' normals,
/// weighted by the areas of the triangles.
std::vector<glm::vec3> normals(const Mesh& mesh) {
  std::vector<glm::dvec3> sum(mesh.welded, glm::dvec3(0.0));
  for (const glm::uvec3& t : mesh.triangle) {
    const glm::dvec3 a(mesh.position[t.x]), b(mesh.position[t.y]), c(mesh.position[t.z]);
    for (int k = 0; k < 3; ++k) sum[mesh.weld[t[k]]] += glm::cross(b - a, c - a);
  }
  std::vector<glm::vec3> unit;
  unit.reserve(sum.size());
  for (const glm::dvec3& n : sum) unit.emplace_back(glm::normalize(n));
  return unit;
}

/// Returns a fur texture of upright cones on a jittered, repeating grid. Each cone has one shade. At the
/// border of a cone the coverage decreases to 0 over one texel.
FurTexture cones(int size, int layers) {
  FurTexture fur{size, layers, {}};
  const int cells = std::max(2, size / 6);
  const double cell = double(size) / cells;
  std::vector<std::array<std::uint8_t, 2>> texels(std::size_t(layers) * std::size_t(size) *
                                                  std::size_t(size));
  for (int n = 0; n < layers; ++n)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        double coverage = 0, shade = 1;
        for (int dj = -1; dj <= 1; ++dj)
          for (int di = -1; di <= 1; ++di) {
            const int i = int(std::floor((x + .5) / cell)) + di, j = int(std::floor((y + .5) / cell)) + dj;
            const auto wrap = [&](int k) { return std::uint32_t((k + cells) % cells); };
            const double cx = (i + noise(wrap(i), wrap(j), 1)) * cell,
                         cy = (j + noise(wrap(i), wrap(j), 2)) * cell;
            const double length = .5 + .5 * noise(wrap(i), wrap(j), 3), h = (1.0 + n) / layers;
            const double radius =
                2.2 * (1 - std::pow(std::min(1.0, h / length), 2)) + (h <= length ? .4 : -1);
            const double a = std::clamp(radius + .5 - std::hypot(x + .5 - cx, y + .5 - cy), 0.0, 1.0);
            if (a > coverage) {
              coverage = a;
              shade = .72 + .56 * noise(wrap(i), wrap(j), 4);
            }
          }
        texels[(std::size_t(n) * std::size_t(size) + std::size_t(y)) * std::size_t(size) + std::size_t(x)] = {
            std::uint8_t(std::lround(255 * coverage)), std::uint8_t(std::lround(127.5 * shade))};
      }
  fur.level.push_back(std::move(texels));
  for (int side = size / 2; side >= 1; side /= 2) {
    const auto& fine = fur.level.back();
    std::vector<std::array<std::uint8_t, 2>> coarse(std::size_t(layers) * std::size_t(side) *
                                                    std::size_t(side));
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      const std::size_t s = std::size_t(side), n = i / (s * s), y = i / s % s, x = i % s;
      const std::size_t corner = (n * 2 * s + 2 * y) * 2 * s + 2 * x;
      for (std::size_t c = 0; c < 2; ++c)
        coarse[i][c] = std::uint8_t((fine[corner][c] + fine[corner + 1][c] + fine[corner + 2 * s][c] +
                                     fine[corner + 2 * s + 1][c] + 2) /
                                    4);
    }
    fur.level.push_back(std::move(coarse));
  }
  return fur;
}

CoatTexture smooth_coat(int size) {
  CoatTexture coat{size, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double u = 2 * pi * (x + .5) / size, v = 2 * pi * (y + .5) / size;
      const auto byte = [](double c) { return std::uint8_t(std::lround(255 * std::clamp(c, 0.0, 1.0))); };
      coat.texel.push_back({byte(.65 + .2 * std::sin(2 * u + std::cos(v))),
                            byte(.55 + .2 * std::cos(3 * v - u)), byte(.4 + .15 * std::sin(u + 2 * v)), 255});
    }
  return coat;
}

}  // namespace

double noise(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint32_t h = a * 0x9e3779b1u ^ (b * 0x85ebca77u + 0x27d4eb2fu) ^ (c * 0xc2b2ae3du + 0x165667b1u);
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return double((h ^ (h >> 15)) >> 8) / double(1u << 24);
}

Surface square(double side) {
  return {[side](double u, double v) { return glm::dvec3(side * (u - .5), side * (v - .5), 0.0); }, false};
}

Surface torus() {
  return {[](double u, double v) {
            const double tube = .3, ring = .7 + tube * std::cos(2 * pi * v);
            return glm::dvec3(ring * std::cos(2 * pi * u), -tube * std::sin(2 * pi * v),
                              ring * std::sin(2 * pi * u));
          },
          true};
}

Mesh grid(const Surface& surface, int nu, int nv) {
  Mesh mesh;
  mesh.name = "synthetic";
  mesh.periodic_uv = surface.periodic;
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i) {
      const double u = double(i) / nu, v = double(j) / nv;
      mesh.position.emplace_back(surface.point(u, v));
      mesh.uv.emplace_back(u, v);
      const int wi = surface.periodic ? i % nu : i, wj = surface.periodic ? j % nv : j;
      mesh.weld.push_back(std::uint32_t(wj * (surface.periodic ? nu : nu + 1) + wi));
    }
  mesh.welded = std::uint32_t(surface.periodic ? nu * nv : (nu + 1) * (nv + 1));
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const std::uint32_t a = std::uint32_t(j * (nu + 1) + i), b = a + 1, d = a + std::uint32_t(nu + 1),
                          c = d + 1;
      mesh.triangle.emplace_back(a, b, c);
      mesh.triangle.emplace_back(a, c, d);
    }
  // Vertex copies of one surface point must have exactly the same position.
  for (std::size_t v = 0; v < mesh.weld.size(); ++v)
    for (std::size_t w = 0; w < v; ++w)
      if (mesh.weld[w] == mesh.weld[v]) {
        mesh.position[v] = mesh.position[w];
        break;
      }
  mesh.length_per_uv = {float(glm::length(derivative(surface, .5, .5, 1, 0))),
                        float(glm::length(derivative(surface, .5, .5, 0, 1)))};
  return mesh;
}

Scene upright_scene() {
  Scene scene = lively_scene();
  scene.fur.comb = 0;
  scene.curl.radius = 0;
  scene.dynamics = {};
  return scene;
}

Camera camera(const CameraScene& scene, int width, int height) {
  Camera result;
  const glm::dvec3 eye(scene.eye), forward = glm::normalize(glm::dvec3(scene.target) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(scene.up))),
                   up = glm::cross(right, forward);
  const double focal = .5 * height / std::tan(.5 * double(scene.fov) * pi / 180);
  const auto row = [&](const glm::dvec3& v) { return glm::vec4(glm::dvec4(v, -glm::dot(v, eye))); };
  result.row_x = row(focal * right);
  result.row_y = row(-focal * up);
  result.row_w = row(forward);
  result.eye = scene.eye;
  result.ray = forward;
  result.ray_dx = right / focal;
  result.ray_dy = -up / focal;
  result.pixel = float(1 / focal);
  result.near = scene.near;
  result.width = width;
  result.height = height;
  return result;
}

FrameInput frame(const Scene& scene, const Surface& surface, int nu, int nv, int droplets) {
  FrameInput input;
  input.scene = scene;
  const Mesh mesh = grid(surface, nu, nv);
  input.strands = strands(scene, mesh);
  if (has_springs(scene.dynamics)) input.stick_normal = normals(mesh);
  input.curl.u.resize(mesh.welded);
  input.curl.v.resize(mesh.welded);
  input.curl.mask_uv.resize(mesh.welded);
  // Several vertices can belong to one surface point. The loop runs backwards, so that the first of these
  // vertices is processed last and its values remain.
  for (std::size_t i = mesh.position.size(); i-- > 0;) {
    const glm::dvec2 uv(mesh.uv[i]);
    const glm::dvec3 t = derivative(surface, uv.x, uv.y, 1, 0), b = derivative(surface, uv.x, uv.y, 0, 1);
    const glm::dvec3 u = glm::normalize(t), n = glm::normalize(glm::cross(t, b));
    input.curl.u[mesh.weld[i]] = u;
    input.curl.v[mesh.weld[i]] = glm::cross(n, u);
    input.curl.mask_uv[mesh.weld[i]] = mesh.uv[i];
  }
  for (const glm::vec2& uv : mesh.uv) {
    input.tangents.t.emplace_back(derivative(surface, uv.x, uv.y, 1, 0));
    input.tangents.b.emplace_back(derivative(surface, uv.x, uv.y, 0, 1));
  }
  input.fur = cones(scene.fur.texture, scene.fur.layers);
  input.coat = smooth_coat(64);
  const int size = scene.wetness.size;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i)
      input.mask_surface.emplace_back(surface.point((i + .5) / size, (j + .5) / size));
  for (std::uint32_t i = 0; i < std::uint32_t(droplets); ++i) {
    const double u = noise(i, 0, 11), v = noise(i, 1, 11);
    const WetnessScene& wet = scene.wetness;
    input.droplets.push_back(
        {glm::vec2(u, v), wet.radius * float(1 + wet.radius_spread * (2 * noise(i, 2, 11) - 1)),
         std::clamp(wet.wetness + wet.wetness_spread * float(2 * noise(i, 3, 11) - 1), 0.f, 1.f),
         glm::vec3(surface.point(u, v)), 4.f});
  }
  input.fur_scale = scene.fur.tile * mesh.length_per_uv;
  input.camera = camera(scene.camera, scene.image.width, scene.image.height);
  input.mesh = std::make_shared<Mesh>(mesh);
  return input;
}

Scene lively_scene() {
  Scene scene;
  scene.fur.layers = 16;
  scene.fur.texture = 64;
  scene.fur.length = .12f;
  scene.fur.comb = .5f;
  scene.curl.radius = .02f;
  scene.curl.turns = 1.3f;
  scene.shading.specular = {.25f, .15f, .08f};
  scene.coat.skin = {.6f, .45f, .3f};
  scene.clump.shape = .6f;
  scene.clump.gain = 33.f;
  scene.wetness.size = 64;
  scene.wetness.radius = .06f;
  scene.dynamics.gravity = {0, -9.8f, 0};
  scene.dynamics.wind.strength = .02f;
  scene.dynamics.wind.gust = .5f;
  scene.camera.framed = false;
  scene.camera.eye = {1.1f, 1.5f, 2.0f};
  scene.image.width = 160;
  scene.image.height = 100;
  return scene;
}

}  // namespace pelage::synthetic
