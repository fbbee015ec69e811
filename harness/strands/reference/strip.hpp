// The curve and the strip of a strand in double precision (docs/strands.md, sections Curve and Coverage of a
// segment).
#pragma once
#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace pelage::strands::reference {

/// The curve of one strand.
struct Curve {
  std::array<glm::dvec3, 3> p;  ///< control points
  glm::dvec3 at(double t) const { return (1 - t) * (1 - t) * p[0] + 2 * t * (1 - t) * p[1] + t * t * p[2]; }
  glm::dvec3 tangent(double t) const { return (1 - t) * (p[1] - p[0]) + t * (p[2] - p[1]); }
};

struct Vertex {
  glm::dvec2 place;  ///< pixels from the top left corner of the picture
  double half = 0;   ///< half of the strand's width, pixels
  double alpha = 0;
  glm::dvec3 colour{0};
  double depth = 0;  ///< depth in the view, R
};

struct Fragment {
  double alpha = 0;
  glm::dvec3 colour{0};
  double depth = 0;  ///< R
};

/// Receives a fragment, and the column and the row of its pixel.
using Visit = std::function<void(int x, int y, const Fragment& fragment)>;

/// Visits all fragments of the strip between the vertices, segment by segment, in a picture of the given
/// size.
void each_fragment(const std::vector<Vertex>& vertices, int width, int height, const Visit& visit);

}  // namespace pelage::strands::reference
