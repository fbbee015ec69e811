#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numeric>

#include "harness/shells/opengl/program.hpp"

namespace pelage::gl {
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

/// A base vertex: homogeneous position in pixels from the image centre, and the rounded position in 1/256
/// pixel.
struct Placed {
  glm::vec3 homogeneous;
  std::int32_t x = 0, y = 0;
  bool inside = false;  ///< beyond the near plane and within the guard band
};

constexpr float guard = 16384;

Placed placed(const Camera& camera, const glm::vec3& p) {
  // The same operations as in kernels/rasterize/geometry/transform.clh, so that both round equally.
  const auto affine = [&](const glm::vec4& row) {
    return std::fma(row.x, p.x, std::fma(row.y, p.y, std::fma(row.z, p.z, row.w)));
  };
  Placed v;
  v.homogeneous = {affine(camera.row_x), affine(camera.row_y), affine(camera.row_w)};
  const float w = v.homogeneous.z, reach = guard * w;
  v.inside = w >= camera.near && std::abs(v.homogeneous.x) <= reach && std::abs(v.homogeneous.y) <= reach;
  if (!v.inside) return v;
  const float inverse = 1 / w;
  v.x = std::int32_t(std::rint(v.homogeneous.x * inverse * 256.0f));
  v.y = std::int32_t(std::rint(v.homogeneous.y * inverse * 256.0f));
  return v;
}

bool faces_away(const Placed& a, const Placed& b, const Placed& c) {
  if (a.inside && b.inside && c.inside)
    return std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(c.x - a.x) * (b.y - a.y) > 0;
  return glm::determinant(glm::dmat3(a.homogeneous, b.homogeneous, c.homogeneous)) > 0;
}

}  // namespace

/// Returns the weighted mean of of_strand(f) over the triangles f around a vertex. of_strand(f) returns a
/// value of the strand of triangle f. With fur.binding "separate", returns the value of the vertex's own
/// triangle.
template <class OfStrand>
glm::dvec3 Vertices::mean(std::size_t vertex, const OfStrand& of_strand) const {
  if (separate_) return glm::dvec3(of_strand(vertex / 3));
  const FaceSprings& strands = input_->strands;
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

SeenTriangles::SeenTriangles(const std::string& defines, const std::vector<Constant>& constants)
    : program_(scene_program("shell.vert", "seen.frag", defines, constants)) {}

void SeenTriangles::find(const std::vector<std::uint32_t>& index, const std::vector<glm::vec4>& layers,
                         const std::vector<std::vector<std::uint32_t>>& sweeps) {
  const std::size_t triangles = index.size() / 3, count = layers.size() / 3;
  std::vector<std::uint32_t> seen(triangles * count, 0);
  const gl::Object flags = gl::make_buffer(seen);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, flags.id());
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GEQUAL);
  program_.use();
  const GLint place = program_.place("layer"), first = program_.place("first");
  for (std::size_t n = 0; n < count; ++n) {
    glUniform4fv(place, 3, &layers[3 * n].x);
    glUniform1ui(first, GLuint(n * triangles));
    glDrawElements(GL_TRIANGLES, GLsizei(index.size()), GL_UNSIGNED_INT, nullptr);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(flags.id(), 0, GLsizeiptr(seen.size() * sizeof(std::uint32_t)), seen.data());

  std::vector<std::uint32_t> elements;
  parts_.clear();
  for (const std::vector<std::uint32_t>& sweep : sweeps)
    for (std::size_t n = 0; n < count; ++n) {
      SeenPart part{int(n), 0, elements.size()};
      for (const std::uint32_t t : sweep)
        if (seen[n * triangles + t])
          elements.insert(elements.end(), index.begin() + 3 * std::ptrdiff_t(t),
                          index.begin() + 3 * std::ptrdiff_t(t) + 3);
      part.corners = GLsizei(elements.size() - part.first);
      parts_.push_back(part);
    }
  if (!elements.empty()) buffer_ = gl::make_buffer(elements);
}

Facing facing(const Camera& camera, const Mesh& mesh) {
  std::vector<Placed> place;
  place.reserve(mesh.position.size());
  for (const glm::vec3& p : mesh.position) place.push_back(placed(camera, p));
  Facing found;
  for (std::size_t f = 0; f < mesh.triangle.size(); ++f) {
    const glm::uvec3& t = mesh.triangle[f];
    (faces_away(place[t.x], place[t.y], place[t.z]) ? found.away : found.towards).push_back(std::uint32_t(f));
  }
  return found;
}

std::vector<std::uint32_t> elements_of(const std::vector<std::uint32_t>& list,
                                       const std::vector<std::uint32_t>& index) {
  std::vector<std::uint32_t> elements;
  elements.reserve(3 * list.size());
  for (const std::uint32_t f : list)
    for (std::size_t corner = 0; corner < 3; ++corner) elements.push_back(index[3 * std::size_t(f) + corner]);
  return elements;
}

}  // namespace pelage::gl
