#include "harness/shells/opengl/vertices.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace pelage::rivals {
namespace {

/// Returns the wetness rho of the mask's texel that contains `uv`. The mask repeats outside 0..1. `discs`:
/// the wetness falls to 0 in the ring around the clump's disc (docs/shells.md, section 2, "consistent").
float wetness_at(const std::vector<glm::vec4>& mask, int size, const glm::vec2& uv, bool discs) {
  const auto texel = [size](float u) {
    return std::size_t(std::min(int((u - std::floor(u)) * float(size)), size - 1));
  };
  const glm::vec4& clump = mask[texel(uv.y) * std::size_t(size) + texel(uv.x)];
  if (!discs) return clump.w;
  const float depth = clump.z - glm::distance(uv, glm::vec2(clump));
  return clump.w * std::clamp(1.0f + depth * 2.0f * float(size), 0.0f, 1.0f);
}

/// Returns an entry of a map of `Style`, or 1 if the scene has no such map.
float share_of(const std::vector<float>& map, std::size_t entry) {
  return map.empty() ? 1.0f : map[entry];
}

}  // namespace

/// Returns the weighted mean of of_strand(f) over the triangles f around a vertex. of_strand(f) returns a
/// value of the strand of triangle f. With fur.binding "separate", returns the value of the vertex's own
/// triangle.
template <class OfStrand>
glm::dvec3 Vertices::mean(std::size_t vertex, const OfStrand& of_strand) const {
  if (separate_) return glm::dvec3(of_strand(vertex / 3));
  const StrandSet& strands = input_->strands;
  const std::uint32_t point = input_->mesh->weld[copy_[vertex]];
  glm::dvec3 sum(0.0);
  for (std::uint32_t i = strands.row[point]; i < strands.row[point + 1]; ++i)
    sum += double(strands.weight[i]) * glm::dvec3(of_strand(strands.face[i]));
  return sum;
}

Vertices::Vertices(const FrameInput& input, const std::vector<glm::vec4>& mask)
    : input_(&input), separate_(input.scene.fur.binding == "separate") {
  const Mesh& mesh = *input.mesh;
  for (const glm::uvec3& t : mesh.triangle) index_.insert(index_.end(), {t.x, t.y, t.z});
  if (separate_) {
    copy_ = index_;
    std::iota(index_.begin(), index_.end(), 0u);
  } else {
    copy_.resize(mesh.position.size());
    std::iota(copy_.begin(), copy_.end(), 0u);
  }
  const double length = double(input.scene.fur.length);
  for (std::size_t i = 0; i < copy_.size(); ++i) {
    const std::uint32_t copy = copy_[i], point = mesh.weld[copy];
    const glm::dvec3 normal =
        mean(i, [&](std::size_t f) { return share_of(input.style.length, f) * input.strands.normal[f]; });
    fixed_.push_back({mesh.position[copy],
                      mesh.uv[copy],
                      glm::vec3(length * normal),
                      {},
                      {},
                      input.tangents.t[copy],
                      input.tangents.b[copy],
                      share_of(input.style.curl_turns, point) * float(turn_steps)});
  }
  set_mask(mask);
}

void Vertices::set_mask(const std::vector<glm::vec4>& mask) {
  const Scene& scene = input_->scene;
  const CurlFrame& curl = input_->curl;
  const bool discs = scene.clump.cells == "consistent";
  for (std::size_t i = 0; i < copy_.size(); ++i) {
    const std::uint32_t point = input_->mesh->weld[copy_[i]];
    const float radius = scene.curl.radius * share_of(input_->style.curl_radius, point) *
                         (1.0f - wetness_at(mask, scene.wetness.size, curl.mask_uv[point], discs));
    fixed_[i].curl_u = radius * curl.u[point];
    fixed_[i].curl_v = radius * curl.v[point];
  }
}

std::vector<glm::vec3> Vertices::bent(const std::vector<glm::vec3>& tips) const {
  std::vector<glm::vec3> b(copy_.size());
  for (std::size_t i = 0; i < b.size(); ++i)
    b[i] = glm::vec3(mean(i, [&](std::size_t f) { return tips[f]; }));
  return b;
}

}  // namespace pelage::rivals
