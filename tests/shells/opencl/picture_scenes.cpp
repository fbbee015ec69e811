#include "tests/shells/opencl/picture_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>

namespace pelage::pictures {

Picture drawn_by_device(const std::shared_ptr<const FrameInput>& input, const std::string& mapping) {
  return drawn_with(input, {mapping, {}});
}

testing::AssertionResult drawn_alike(const std::shared_ptr<const FrameInput>& input,
                                     const std::string& mapping, std::size_t least_pixels) {
  return same(drawn_by_reference(*input), drawn_by_device(input, mapping), least_pixels);
}

Change change(const Picture& a, const Picture& b) {
  Change c;
  for (std::size_t i = 0; i < a.pixel.size(); ++i) {
    const glm::vec3 d = glm::abs(glm::vec3(a.pixel[i]) - glm::vec3(b.pixel[i]));
    c.mean += double(d.x + d.y + d.z) / 3;
    c.most = std::max({c.most, double(d.x), double(d.y), double(d.z)});
  }
  c.mean /= double(a.pixel.size());
  return c;
}

namespace {

// The opacity of the fur is 26/255. The kernels may skip further triangles of a pixel when its transmittance
// is at most 1/512. After 57 triangles with this opacity, the transmittance is still above 1/512.
constexpr int coverage = 26;

/// Returns a frame with the triangles of `flat` in the plane z = 0 and upright strands of length 1. The fur
/// has two layers. The first layer has no fur. The second layer is at z = 1, where the clip coordinate w is
/// exactly 1/2 for the default `row_w`.
FrameInput flat_frame(const Flat& flat) {
  FrameInput input;
  Scene& scene = input.scene;
  scene.fur.length = 1;
  scene.fur.layers = 2;
  scene.fur.binding = "separate";
  scene.fur.comb = 0;
  scene.wetness.size = 1;
  scene.shading.ambient = 1;
  scene.shading.lights = {LightScene{{0, 0, 1}, 0}};
  scene.shading.specular = glm::vec3(0);
  scene.shading.shadow = 1e6f;  // larger values make the shadow weaker; with 1e6 the skin stays white
  scene.coat.skin = glm::vec3(1);
  scene.image = {flat.width, flat.height, glm::vec3(1)};

  Mesh mesh;
  for (const glm::vec2& v : flat.vertex) {
    mesh.position.emplace_back(.5f * v.x, .5f * v.y, 0);
    mesh.uv.emplace_back(.5f, .5f);
    mesh.weld.push_back(mesh.welded++);
  }
  mesh.triangle = flat.triangle;
  const glm::vec3 up(0, 0, 1);
  FaceSprings& strands = input.strands;
  std::vector<std::vector<std::uint32_t>> around(mesh.welded);
  for (std::uint32_t f = 0; f < mesh.triangle.size(); ++f) {
    strands.root.push_back((mesh.position[mesh.triangle[f].x] + mesh.position[mesh.triangle[f].y] +
                            mesh.position[mesh.triangle[f].z]) /
                           3.f);
    strands.normal.push_back(up);
    strands.anchor.push_back(up);
    strands.phase.emplace_back(1, 0);
    for (int c = 0; c < 3; ++c) around[mesh.triangle[f][c]].push_back(f);
  }
  strands.row.push_back(0);
  for (const auto& faces : around) {
    for (const std::uint32_t f : faces) {
      strands.face.push_back(f);
      strands.weight.push_back(1.f / float(faces.size()));
    }
    strands.row.push_back(std::uint32_t(strands.face.size()));
  }
  input.curl = {std::vector<glm::vec3>(mesh.welded, {1, 0, 0}),
                std::vector<glm::vec3>(mesh.welded, {0, 1, 0}),
                std::vector<glm::vec2>(mesh.welded, {.5f, .5f})};
  input.tangents = {input.curl.u, input.curl.v};
  input.fur = {1, 2, {{{0, 0}, {coverage, 0}}}};
  input.coat = {1, {{255, 255, 255, 255}}};
  input.mask_surface = {glm::vec3(0)};
  Camera& camera = input.camera;
  camera.row_x = {1, 0, 0, 0};
  camera.row_y = {0, 1, 0, 0};
  camera.row_w = flat.row_w;
  camera.ray = {0, 0, -1};
  camera.pixel = 1;
  camera.near = .01f;
  camera.width = flat.width;
  camera.height = flat.height;
  input.mesh = std::make_shared<Mesh>(std::move(mesh));
  return input;
}

}  // namespace

std::vector<int> covered_counts(const Flat& flat, const ShellOptions& options) {
  Shells shells(device(), std::make_shared<FrameInput>(flat_frame(flat)), options);
  shells.frame();
  const Picture picture = shells.read();
  std::vector<int> counts;
  counts.reserve(picture.pixel.size());
  for (const glm::vec4& pixel : picture.pixel) {
    const double hits = std::log(double(pixel.x)) / std::log(1.0 - coverage / 255.0);
    const double whole = std::round(hits);
    if (!(std::abs(hits - whole) < .02) || whole < 0 || whole > 50)
      throw std::runtime_error(fmt::format("a pixel of {} is no whole number of hits", pixel.x));
    counts.push_back(int(whole));
  }
  return counts;
}

}  // namespace pelage::pictures
