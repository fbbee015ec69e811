// Scenes with strands of a file.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <memory>

#include "harness/mesh/read/polylines.hpp"
#include "harness/prepare/placed_strands.hpp"
#include "harness/strands/scene/strand_input.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::test {

/// Curly strands of 2 to 12 points that begin near the surface of a torus.
inline Polylines curly(const Mesh& mesh, std::size_t count) {
  Polylines lines;
  for (std::uint32_t i = 0; i < count; ++i) {
    const glm::uvec3 t = mesh.triangle[std::size_t(synthetic::noise(i, 1, 5) * double(mesh.triangle.size()))];
    const glm::dvec3 a(mesh.position[t.x]), b(mesh.position[t.y]), c(mesh.position[t.z]);
    const double s = synthetic::noise(i, 2, 5);
    const glm::dvec3 root = a + s * (b - a) + (1 - s) * synthetic::noise(i, 3, 5) * (c - a);
    const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a)), e = glm::normalize(b - a),
                     f = glm::cross(n, e);
    const auto points = std::uint32_t(2 + 11 * synthetic::noise(i, 4, 5));
    const double turns = 2 * synthetic::noise(i, 5, 5), radius = 0.02,
                 length = 0.1 + 0.2 * synthetic::noise(i, 6, 5);
    lines.count.push_back(points);
    for (std::uint32_t k = 0; k < points; ++k) {
      const double at = double(k) / (points - 1), angle = 2 * glm::pi<double>() * turns * at;
      const glm::dvec3 curl = radius * at * (std::cos(angle) * e + std::sin(angle) * f);
      lines.point.emplace_back(root + at * length * (n + 0.4 * e) + curl + glm::dvec3(0, -0.1 * at * at, 0));
      lines.width.push_back(float(0.004 * (1 - 0.7 * at) * (i % 3 == 0 ? 0.5 + at : 1)));
      lines.colour.emplace_back(0.3 + 0.6 * at, 0.4, 0.9 - 0.6 * at);
    }
  }
  return lines;
}

/// A scene whose strands are those of the file fur.hair, on a torus.
struct FileStrands : InFolder {
  std::shared_ptr<const Mesh> torus = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 40, 24));
  Scene scene;

  FileStrands() {
    scene.model = "torus";
    scene.dynamics.topology = "chains";
    scene.image.width = 200;
    scene.image.height = 150;
    scene.strands.groom = "file";
    scene.strands.file = folder.path / "fur.hair";
    scene.strands.shadow_size = 128;
    write(curly(*torus, 1500));
  }
  void write(const Polylines& lines) const { write_polylines(scene.strands.file, lines, "test"); }
  std::shared_ptr<const strands::StrandInput> input() const {
    return strands::prepare_strands(
        scene, with_strands(scene, read_strands(scene), scene.model == "none" ? nullptr : torus, {}));
  }
};

}  // namespace pelage::test
