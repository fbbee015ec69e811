// Strands on a sphere, for tests of pictures of strands.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "harness/prepare/prepare.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands {

inline constexpr float longest = 0.35f;  // R

/// Key strands on the unit sphere, with directions up to 100 degrees from the normal, and strands between
/// three neighbouring key strands.
struct Ball {
  std::vector<KeyStrand> keys;
  std::vector<KeyedStrand> strands;

  explicit Ball(std::size_t count, int layers = 1) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 1);
    const auto direction = [&] {
      const float z = 2 * unit(random) - 1, angle = 2 * std::numbers::pi_v<float> * unit(random);
      const float across = std::sqrt(1 - z * z);
      return glm::vec3(across * std::cos(angle), across * std::sin(angle), z);
    };
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec3 root = direction();
      for (int corner = 0; corner < 3; ++corner) {
        KeyStrand key;
        key.root = key.normal = glm::normalize(root + 0.03f * direction());
        key.first = glm::normalize(key.normal + 0.9f * direction());
        key.second = glm::normalize(key.first + 1.1f * direction());
        key.rest = glm::normalize(key.normal + 0.5f * direction());
        keys.push_back(key);
      }
      KeyedStrand s;
      for (std::uint32_t k = 0; k < 3; ++k) s.key[k] = std::uint32_t(3 * i) + k;
      s.weight.x = unit(random);
      s.weight.y = (1 - s.weight.x) * unit(random);
      s.length = longest * (0.2f + 0.8f * unit(random));
      s.width = 0.002f + 0.02f * unit(random) * unit(random);
      for (std::uint8_t& c : s.colour) c = std::uint8_t(random() & 255);
      s.layer = std::uint8_t(random() % unsigned(layers));
      strands.push_back(s);
    }
  }
};

/// The sum of the coverages of all pixels.
inline double covered(const Picture& picture) {
  double sum = 0;
  for (const glm::vec4& pixel : picture.pixel) sum += double(pixel.w);
  return sum;
}

/// A straight strand from `root` to `tip`.
inline DrawnStrand straight(glm::vec3 root, glm::vec3 tip, float width) {
  DrawnStrand s;
  s.point = {root, 0.5f * (root + tip), tip};
  s.width = width;
  return s;
}

/// A camera that looks at the sphere's centre. `near` is the distance of the near plane, R.
inline Camera camera_at(int width, int height, glm::vec3 eye = {0.5f, 0.6f, 3.4f}, float near = 0.01f) {
  CameraScene camera;
  camera.near = near;
  camera.framed = false;
  camera.eye = eye;
  camera.target = {0, 0, 0};
  ImageScene image;
  image.width = width;
  image.height = height;
  return make_camera(camera, image, {}, 0);
}

/// A picture of a Ball.
inline DrawingScene ball_scene(int width, int height, glm::vec3 eye = {0.5f, 0.6f, 3.4f},
                               float near = 0.01f) {
  DrawingScene scene;
  scene.camera = camera_at(width, height, eye, near);
  scene.range = depth_range(scene.camera, 1 + longest);
  scene.first_segment = 0.45f;
  return scene;
}

}  // namespace pelage::strands
