// Scenes with maps of the fur's shape and with colliders, for all pipelines.
#pragma once
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>

#include "harness/mesh/mesh.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "tests/support/files.hpp"

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

/// A scalar key of a scene, and the map that multiplies it.
struct MapKey {
  const char* name;
  std::filesystem::path& map;
  float& value;
};
inline std::array<MapKey, 5> map_keys(Scene& s) {
  return {{{"length", s.fur.length_map, s.fur.length},
           {"density", s.fur.density_map, s.fur.density},
           {"comb", s.fur.comb_map, s.fur.comb},
           {"radius", s.curl.radius_map, s.curl.radius},
           {"turns", s.curl.turns_map, s.curl.turns}}};
}
inline void set_maps(Scene& s, const std::filesystem::path& map) {
  for (const MapKey& key : map_keys(s)) key.map = map;
}

/// Returns small_torus() with wavy maps of all these keys.
inline std::shared_ptr<const FrameInput> with_all_maps(const std::function<void(Scene&)>& change) {
  const test::Folder folder;
  const auto map = write_map(folder.path / "wavy.exr", 32, 16, wavy);
  return small_torus([&](Scene& s) {
    set_maps(s, map);
    change(s);
  });
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

/// Returns long_fur() that colliders of all kinds press: a ball, a bar that moves, and a torus in a file.
inline std::shared_ptr<const FrameInput> pressed_fur(const std::function<void(Scene&)>& change = {}) {
  const test::Folder folder;
  const auto torus = folder.path / "torus.ply";
  write_ply(torus, *load_model("torus-24x16"));
  return long_fur([&](Scene& s) {
    ContactSphereScene& ball = s.contact.spheres.emplace_back();
    ball.centre = {0.72f, 0.7f, 0.1f};
    ball.radius = 0.36f;
    ContactCapsuleScene& bar = s.contact.capsules.emplace_back();
    bar.from = {-0.4f, 0.57f, 0.5f};
    bar.to = {0.5f, 0.57f, 0.75f};
    bar.radius = 0.22f;
    bar.motion.velocity = {0.1f, 0, 0};
    s.contact.mesh.file = torus;
    s.contact.mesh.position = {-0.5f, 0.5f, 0.5f};
    s.contact.mesh.scale = 0.4f;
    s.contact.mesh.cells = 32;
    if (change) change(s);
  });
}

/// Returns pressed_fur() whose torus turns, and deforms over three files that repeat.
inline std::shared_ptr<const FrameInput> kneaded_fur(const std::function<void(Scene&)>& change = {}) {
  const test::Folder folder;
  Mesh torus = *load_model("torus-24x16");
  for (const char* name : {"torus-0.ply", "torus-1.ply", "torus-2.ply"}) {
    write_ply(folder.path / name, torus);
    for (glm::vec3& p : torus.position) p *= glm::vec3(1.05f, 1.3f, 0.95f);
  }
  return pressed_fur([&](Scene& s) {
    s.contact.mesh.file = folder.path / "torus-0.ply";
    s.contact.mesh.axis = {1, 0.5f, -0.25f};
    s.contact.mesh.spin = 4;
    s.contact.mesh.frames = 3;
    s.contact.mesh.after_frames = "repeat";
    if (change) change(s);
  });
}

}  // namespace pelage::style_scenes
