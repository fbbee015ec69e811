// Meshes, pictures and comparisons that the tests in tests/strands/groom use.
#pragma once
#include <functional>
#include <string>

#include "harness/picture/image_io.hpp"
#include "harness/strands/groom/fur.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic.hpp"
#include "tests/support/texts.hpp"

namespace pelage::strands::test {

/// A square with the corners (-1, -1, 0) and (1, 1, 0). Its UV is ((x + 1) / 2, (y + 1) / 2).
inline Mesh square() {
  return synthetic::grid(synthetic::square(2), 16, 16);
}

/// A coat of one colour.
inline CoatTexture plain_coat(std::array<std::uint8_t, 3> colour = {200, 100, 50}) {
  return {1, {{colour[0], colour[1], colour[2], 255}}};
}

/// Writes a PNG file in the folder. `colour` returns the bytes of the pixel (x, y); (0, 0) is the top left
/// pixel.
inline std::filesystem::path picture(const pelage::test::Folder& folder, const std::string& name, int width,
                                     int height, const std::function<glm::ivec3(int, int)>& colour) {
  Picture p{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) p.pixel.emplace_back(glm::vec3(colour(x, y)) / 255.0f, 1.0f);
  write_picture(folder.path / name, p);
  return folder.path / name;
}
inline std::filesystem::path grey(const pelage::test::Folder& folder, int value) {
  return picture(folder, "grey" + std::to_string(value) + ".png", 3, 2,
                 [&](int, int) { return glm::ivec3(value); });
}

/// A scene with one layer without random values.
inline StrandsScene even(int count = 500) {
  StrandsScene scene;
  StrandLayerScene& layer = scene.layers.front();
  layer.count = count;
  layer.length_spread = layer.colour_spread = 0;
  return scene;
}

inline glm::vec3 root_of(const Fur& fur, const KeyedStrand& s) {
  return (1 - s.weight.x - s.weight.y) * fur.keys[s.key[0]].root + s.weight.x * fur.keys[s.key[1]].root +
         s.weight.y * fur.keys[s.key[2]].root;
}

/// Returns what differs between two furs; "" if all their values are equal.
inline std::string difference(const Fur& a, const Fur& b) {
  if (a.keys.size() != b.keys.size() || a.chains.size() != b.chains.size()) return "number of key strands";
  for (std::size_t i = 0; i < a.keys.size(); ++i) {
    const KeyStrand &k = a.keys[i], &l = b.keys[i];
    if (k.root != l.root || k.normal != l.normal || k.first != l.first || k.second != l.second ||
        k.rest != l.rest)
      return "key strand";
    const Chain &c = a.chains[i], &d = b.chains[i];
    if (c.root != d.root || c.rest != d.rest || c.normal != d.normal) return "place of a chain";
    if (c.length != d.length) return "length of a chain";
    if (c.stiffness_first != d.stiffness_first || c.stiffness_second != d.stiffness_second)
      return "stiffness of a chain";
    if (c.limit_first != d.limit_first || c.limit_second != d.limit_second) return "limit of a chain";
    if (c.drag != d.drag || c.damping != d.damping) return "damping of a chain";
  }
  if (a.strands.size() != b.strands.size()) return "number of strands";
  for (std::size_t i = 0; i < a.strands.size(); ++i) {
    const KeyedStrand &s = a.strands[i], &t = b.strands[i];
    if (s.key != t.key || s.weight != t.weight) return "root of a strand";
    if (s.length != t.length) return "length of a strand";
    if (s.width != t.width) return "width of a strand";
    if (s.colour != t.colour) return "colour of a strand";
    if (s.response != t.response) return "response of a strand";
    if (s.twist != t.twist) return "twist of a strand";
    if (s.curvature != t.curvature) return "curvature of a strand";
    if (s.layer != t.layer) return "layer of a strand";
  }
  if (a.layers != b.layers || a.film.size() != b.film.size()) return "film strip";
  return {};
}

/// Returns the error text of grow().
inline std::string refusal(const Mesh& mesh, const StrandsScene& scene) {
  return pelage::test::refusal([&] { grow(mesh, scene, plain_coat()); }, "no error");
}

}  // namespace pelage::strands::test
