// Scenes with maps of the fur's shape and with colliders, for all pipelines.
#pragma once
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>

#include "harness/picture/image_io.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"

namespace pelage::style_scenes {

/// Writes a grey float picture: value(uv) at the centre of each pixel, top row at v = 1. Returns its path.
inline std::filesystem::path write_map(const std::filesystem::path& file, int width, int height,
                                       const std::function<float(glm::vec2)>& value) {
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float v = value({(float(x) + 0.5f) / float(width), 1 - (float(y) + 0.5f) / float(height)});
      picture.pixel.emplace_back(v, v, v, 1.0f);
    }
  write_picture(file, picture);
  return file;
}

/// A small torus with combed, curly, wet and windy fur, as prepare() makes it. `change` changes the scene.
inline std::shared_ptr<const FrameInput> small_torus(const std::function<void(Scene&)>& change) {
  Scene scene;
  scene.model = "torus-40x24";
  scene.fur.length = 0.16f;
  scene.fur.layers = 16;
  scene.fur.texture = 64;
  scene.fur.strands = 300;
  scene.fur.undercoat = 200;
  scene.fur.locks = 40;
  scene.curl.radius = 0.03f;
  scene.curl.turns = 1.5f;
  scene.wetness.size = 64;
  scene.wetness.random = 40;
  scene.wetness.radius = 0.05f;
  scene.dynamics.wind = {{1, .1f, -.4f}, .008f, .6f, 1, 2};
  scene.shading.model = "wet";
  scene.image.width = 160;
  scene.image.height = 100;
  change(scene);
  return prepare(scene, load_scene_mesh(scene, {}));
}

/// A map that varies in u and v, from 0.1 to 1.
inline float wavy(glm::vec2 uv) {
  return 0.55f + 0.45f * std::sin(6.2831853f * uv.x) * std::cos(12.566371f * uv.y);
}

/// A torus with long fur, without colliders unless `change` adds some. Its axis is y. The circle in its tube
/// has the radius 0.71, and the radius of the tube is 0.29.
inline std::shared_ptr<const FrameInput> long_fur(const std::function<void(Scene&)>& change = {}) {
  return small_torus([&](Scene& s) {
    s.model = "torus-60x36";
    s.mesh.rotate = {-25, 0, 0};  // the torus of load_model() is tilted by 25 degrees
    s.fur.length = 0.26f;
    s.fur.comb = 0.2f;
    if (change) change(s);
  });
}

/// Adds colliders of all kinds that press long_fur(): a ball, a bar that moves, and the mesh in the file
/// `body`.
inline void press(Scene& s, const std::filesystem::path& body) {
  ContactSphereScene& ball = s.contact.spheres.emplace_back();
  ball.centre = {0.72f, 0.7f, 0.1f};
  ball.radius = 0.36f;
  ContactCapsuleScene& bar = s.contact.capsules.emplace_back();
  bar.from = {-0.4f, 0.57f, 0.5f};
  bar.to = {0.5f, 0.57f, 0.75f};
  bar.radius = 0.22f;
  bar.motion.velocity = {0.1f, 0, 0};
  s.contact.mesh.file = body;
  s.contact.mesh.position = {-0.5f, 0.5f, 0.5f};
  s.contact.mesh.scale = 0.4f;
  s.contact.mesh.cells = 32;
}

}  // namespace pelage::style_scenes
