#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>

#include "harness/error.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {
namespace {

constexpr double panel = 360, margin = 16, title = 26;  // pixels
// Part of its distance from the centre of its triangle by which a corner of a separable topology is moved.
constexpr double pulled_in = 0.16;
// Masses are drawn as dots only if the topology has at most this many sticks.
constexpr std::size_t most_dots = 300;

// Unit vectors: the direction from the mesh to the eye, and the right and up axes of the drawing plane.
const glm::dvec3 towards = glm::normalize(glm::dvec3(0.35, 0.45, 1.0));
const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), towards));
const glm::dvec3 up = glm::cross(towards, right);

glm::dvec3 seen(glm::dvec3 p) {
  return {glm::dot(p, right), glm::dot(p, up), glm::dot(p, towards)};
}

struct Item {
  double depth;
  std::string svg;
};

class Panel {
 public:
  Panel(const SpringNetwork& network, const Mesh& mesh) : network_(network), place_(network.mass.size()) {
    for (std::size_t i = 0; i < place_.size(); ++i) place_[i] = seen(glm::dvec3(network.mass[i]));
    if (network.kind.separable) pull_in();
    for (const glm::dvec3& p : place_) low_ = glm::min(low_, p), high_ = glm::max(high_, p);
    const glm::dvec3 size = high_ - low_;
    scale_ = (panel - 2 * margin) / std::max({size.x, size.y, 1e-9});
    for (const glm::uvec3& t : mesh.triangle) surface(mesh, t);
    for (const glm::uvec2& s : network.spring) spring(s);
    if (network.sticks() <= most_dots)
      for (std::size_t i = 0; i < place_.size(); ++i) mass(i);
  }

  std::string svg(double x, double y) {
    std::stable_sort(items_.begin(), items_.end(),
                     [](const Item& a, const Item& b) { return a.depth < b.depth; });
    std::string text = fmt::format(
        "<g transform=\"translate({:.0f} {:.0f})\" stroke-width=\"{:.2f}\">\n<text x=\"{:.0f}\" y=\"16\" text-anchor=\"middle\">{}: {} masses, {} springs</text>\n",
        x, y, std::clamp(25 / std::sqrt(double(network_.spring.size())), 0.35, 1.2), panel / 2,
        network_.kind.name, network_.mass.size(), network_.spring.size());
    for (const Item& item : items_) text += item.svg;
    return text + "</g>\n";
  }

 private:
  void pull_in() {
    for (const glm::uvec3& corner : network_.corner)
      for (const std::size_t level : {std::size_t{0}, network_.sticks()}) {
        glm::dvec3 centre(0);
        for (int c = 0; c < 3; ++c) centre += place_[level + corner[c]] / 3.0;
        for (int c = 0; c < 3; ++c) {
          glm::dvec3& p = place_[level + corner[c]];
          p += pulled_in * (centre - p);
        }
      }
  }

  glm::dvec2 at(glm::dvec3 p) const {
    const glm::dvec3 middle = 0.5 * (low_ + high_);
    return {panel / 2 + scale_ * (p.x - middle.x), title + panel / 2 - scale_ * (p.y - middle.y)};
  }

  void surface(const Mesh& mesh, const glm::uvec3& triangle) {
    glm::dvec3 corner[3], centre(0);
    for (int c = 0; c < 3; ++c) {
      corner[c] = seen(glm::dvec3(mesh.position[triangle[c]]));
      centre += corner[c] / 3.0;
    }
    const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double lit = glm::length(normal) > 0 ? std::abs(normal.z) / glm::length(normal) : 1;
    const auto grey = int(205 + 45 * lit);
    const glm::dvec2 a = at(corner[0]), b = at(corner[1]), c = at(corner[2]);
    items_.push_back(
        {centre.z,
         fmt::format(
             "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z\" class=\"skin\" fill=\"#{:02x}{:02x}{:02x}\"/>\n",
             a.x, a.y, b.x, b.y, c.x, c.y, grey, grey, grey - 8)});
  }

  void spring(const glm::uvec2& masses) {
    const glm::dvec3 from = place_[masses.x], to = place_[masses.y];
    const bool stick = masses.x < network_.sticks();
    const glm::dvec2 a = at(from), b = at(to);
    items_.push_back(
        {0.5 * (from.z + to.z), fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" class=\"{}\"/>\n", a.x,
                                            a.y, b.x, b.y, stick ? "stick" : "edge")});
  }

  void mass(std::size_t i) {
    const glm::dvec2 p = at(place_[i]);
    items_.push_back(
        {place_[i].z, fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.2\"/>\n", p.x, p.y)});
  }

  const SpringNetwork& network_;
  std::vector<glm::dvec3> place_;  // view positions of the masses: x points right, y up, z towards the eye
  glm::dvec3 low_{std::numeric_limits<double>::max()}, high_{std::numeric_limits<double>::lowest()};
  double scale_ = 1;
  std::vector<Item> items_;
};

}  // namespace

std::string drawing_of(const Mesh& mesh, float length) {
  if (mesh.triangle.size() > most_drawn)
    throw InputError(fmt::format(
        "{}: the mesh has {} triangles; a drawing shows at most {}. Reduce the mesh, for instance with --faces 2000",
        mesh.name, mesh.triangle.size(), most_drawn));
  const double row = panel + title;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"13\">\n<style>.skin{{stroke:#b4b0a4;stroke-width:.4}}.stick{{stroke:#8a4b12}}.edge{{stroke:#0072b2}}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      2 * panel, 2 * row);
  for (std::size_t i = 0; i < std::size(kinds); ++i) {
    const SpringNetwork network = build(kinds[i], mesh, length);
    const std::size_t line = i / 2;
    svg += Panel(network, mesh).svg(double(i % 2) * panel, double(line) * row);
  }
  return svg + "</svg>\n";
}

}  // namespace pelage::springs
