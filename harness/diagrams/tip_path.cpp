#include <algorithm>
#include <glm/geometric.hpp>

#include "harness/compare/strands.hpp"
#include "harness/diagrams/diagrams.hpp"
#include "harness/prepare/strands.hpp"
#include "harness/shells/reference/strands.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/springs/reference/reference.hpp"

namespace pelage::diagrams {
namespace {

/// Tips relative to their roots, in the object's frame, in R.
using Tips = std::vector<glm::dvec3>;

/// A strand at rest.
struct AtRest {
  glm::dvec3 tip, normal;  // relative to the root, R; unit vector
  double length;           // R
};

/// Returns `count` indices at equal distances below `size`.
std::vector<std::size_t> spread_over(std::size_t size, std::size_t count) {
  std::vector<std::size_t> index(std::min(size, count));
  for (std::size_t i = 0; i < index.size(); ++i) index[i] = i * size / index.size();
  return index;
}

/// `simulate` calls its argument with the tips of all strands after each frame. It is called twice, so that
/// the memory does not grow with the number of strands times that of frames.
template <class Simulate>
Section path_of(const std::vector<AtRest>& rest, double frame, const Simulate& simulate) {
  std::size_t chosen = 0;
  double greatest = 0;
  glm::dvec3 displacement(0);
  simulate([&](const Tips& tips) {
    for (std::size_t i = 0; i < tips.size(); ++i) {
      const glm::dvec3 d = tips[i] - rest[i].tip;
      if (!(glm::length(d) > greatest * rest[i].length)) continue;
      greatest = glm::length(d) / rest[i].length;
      chosen = i;
      displacement = d;
    }
  });
  const AtRest& strand = rest.at(chosen);
  const glm::dvec3 level = displacement - glm::dot(displacement, strand.normal) * strand.normal;
  const glm::dvec3 across = glm::length(level) > 0 ? glm::normalize(level) : glm::dvec3(0);
  Section section{{"t", "x", "y", "rest_x", "rest_y", "apart"}, {}};
  simulate([&](const Tips& tips) {
    const glm::dvec3& tip = tips[chosen];
    section.rows.push_back({double(section.rows.size()) * frame, glm::dot(tip, across),
                            glm::dot(tip, strand.normal), glm::dot(strand.tip, across),
                            glm::dot(strand.tip, strand.normal),
                            glm::distance(tip, strand.tip) / strand.length});
  });
  return section;
}

double frame_seconds(const DynamicsScene& dynamics) {
  return double(dynamics.step) * dynamics.substeps;
}

Section stick_path(const FrameInput& input, std::size_t most) {
  const int frames = frames_before(input.scene.dynamics) + 1;
  const springs::SpringNetwork network = springs::network_of(input);
  std::vector<AtRest> rest;
  for (const std::uint32_t stick : springs::some_reference_sticks(input, 0, most).stick) {
    const glm::dvec3 normal(network.normal[stick]);
    rest.push_back({double(network.length) * normal, normal, double(network.length)});
  }
  return path_of(rest, frame_seconds(input.scene.dynamics),
                 [&](const auto& each) { springs::some_reference_sticks(input, frames, most, each); });
}

}  // namespace

Section path_section(const FrameInput& input, std::size_t most) {
  const Scene& scene = input.scene;
  if (has_springs(scene.dynamics)) return stick_path(input, most);
  const int frames = frames_before(scene.dynamics) + 1;
  const std::vector<std::size_t> faces = spread_over(input.strands.anchor.size(), most);
  std::vector<AtRest> rest;
  rest.reserve(faces.size());
  for (const std::size_t face : faces)
    rest.push_back({glm::dvec3(input.strands.anchor[face]), glm::dvec3(input.strands.normal[face]),
                    double(strand_length(scene.fur, input.style, face))});
  const reference::FrameForces forces(input, 0, frames);
  const auto simulate = [&](const auto& each) {
    std::vector<reference::Strand> strands;
    strands.reserve(faces.size());
    for (const std::size_t face : faces) strands.push_back(reference::rest(input, face));
    Tips tips(strands.size());
    const auto substeps = std::size_t(scene.dynamics.substeps);
    for (std::size_t k = 0; k < std::size_t(frames) * substeps; ++k) {
      for (std::size_t i = 0; i < strands.size(); ++i) {
        strands[i] = reference::substep(input, forces, faces[i], strands[i], k);
        tips[i] = strands[i].tip;
      }
      if ((k + 1) % substeps == 0) each(tips);
    }
  };
  return path_of(rest, frame_seconds(scene.dynamics), simulate);
}

Section path_section(const strands::StrandInput& input, std::size_t most) {
  const std::vector<std::size_t> chosen = spread_over(input.fur.keys.size(), most);
  strands::StrandInput some = input;
  some.fur.keys.clear(), some.fur.chains.clear(), some.fur.points.clear();
  std::vector<AtRest> rest;
  for (const std::size_t i : chosen) {
    some.fur.keys.push_back(input.fur.keys[i]);
    some.fur.chains.push_back(input.fur.chains[i]);
    some.fur.points.push_back(input.fur.points[i]);
    const strands::Chain& chain = input.fur.chains[i];
    rest.push_back(
        {double(chain.length) * glm::dvec3(chain.rest), glm::dvec3(chain.normal), double(chain.length)});
  }
  const double first = double(input.dynamics.first_segment);
  const auto simulate = [&](const auto& each) {
    Tips tips(chosen.size());
    reference_keys(
        some, frames_before(input.scene.dynamics) + 1, [&](const std::vector<strands::KeyStrand>& keys) {
          for (std::size_t i = 0; i < keys.size(); ++i)
            tips[i] = rest[i].length *
                      (first * glm::dvec3(keys[i].first) + (1 - first) * glm::dvec3(keys[i].second));
          each(tips);
        });
  };
  return path_of(rest, frame_seconds(input.scene.dynamics), simulate);
}

}  // namespace pelage::diagrams
