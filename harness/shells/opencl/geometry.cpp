#include "harness/shells/opencl/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "harness/error.hpp"
#include "harness/prepare/strands.hpp"
#include "kernels/rasterize/params.h"
#include "kernels/simulate/params.h"

namespace pelage::shells {
namespace {

// Returns `count` rounded up to a multiple of 16. Throws InputError if `count` is above 2^28 - 16. The reason
// for this limit is that kernels index tables of up to eight values per vertex or triangle with a 32-bit int.
int padded(std::size_t count) {
  if (count > (std::size_t(1) << 28) - 16)
    throw InputError(fmt::format(
        "{} vertices or triangles to draw, but at most 2^28 - 16 are possible: reduce the mesh (pelage mesh --faces)",
        count));
  return static_cast<int>((count + 15) / 16 * 16);
}

void set_column3(std::vector<float>& table, int first, int stride, int row, glm::vec3 value) {
  for (int k = 0; k < 3; ++k)
    table[std::size_t(first + k) * std::size_t(stride) + std::size_t(row)] = value[k];
}

// Describes a drawn vertex. `copy` is the index of this vertex in the mesh. The strands of the triangles
// `faces` displace the vertex, with the weights `weights`.
struct Vertex {
  std::uint32_t copy;
  std::span<const std::uint32_t> faces;
  std::span<const float> weights;
};

constexpr float whole_weight = 1.0f;

std::vector<Vertex> drawn_vertices(const FrameInput& input) {
  const Mesh& mesh = *input.mesh;
  const FaceSprings& strands = input.strands;
  std::vector<Vertex> vertices;
  if (parts(input.scene)) {
    // No triangle shares a vertex with another triangle. With Silva's strands, a triangle has one strand, and
    // this strand displaces all three vertices. With a mass-spring topology, each vertex has its own stick.
    static_assert(sizeof(std::uint32_t) == 4);
    for (std::size_t f = 0; f < mesh.triangle.size(); ++f)
      for (int k = 0; k < 3; ++k) vertices.push_back({mesh.triangle[f][k], {}, {&whole_weight, 1}});
    return vertices;
  }
  for (std::uint32_t copy = 0; copy < mesh.position.size(); ++copy) {
    const std::uint32_t point = mesh.weld[copy];
    const std::size_t first = strands.row[point],
                      count = has_springs(input.scene.dynamics) ? 0 : strands.row[point + 1] - first;
    vertices.push_back({copy, std::span(strands.face).subspan(first, count),
                        std::span(strands.weight).subspan(first, count)});
  }
  return vertices;
}

void lay_out_corners(const Mesh& mesh, bool separate, Geometry& g) {
  const std::size_t faces = mesh.triangle.size();
  g.triangles = padded(faces);
  // All three corners of a padding triangle are the same padding vertex, so the triangle covers no pixel.
  g.corner.assign(std::size_t(4) * std::size_t(g.triangles), g.vertices - 1);
  for (std::size_t f = 0; f < faces; ++f)
    for (std::size_t k = 0; k < 3; ++k)
      g.corner[4 * f + k] =
          static_cast<std::int32_t>(separate ? 3 * f + k : mesh.triangle[f][static_cast<int>(k)]);
}

void lay_out_strands(const FrameInput& input, Geometry& g) {
  const FaceSprings& strands = input.strands;
  const std::size_t count = strands.root.size();
  g.strands = padded(count);
  g.strand_constants.assign(std::size_t(VIRTUAL_STRAND_COLUMNS) * std::size_t(g.strands), 0.0f);
  for (std::size_t f = 0; f < count; ++f) {
    const int row = static_cast<int>(f);
    set_column3(g.strand_constants, NORMAL_X, g.strands, row, strands.normal[f]);
    set_column3(g.strand_constants, ANCHOR_X, g.strands, row, strands.anchor[f]);
    g.strand_constants[std::size_t(PHASE_COS) * std::size_t(g.strands) + f] = strands.phase[f].x;
    g.strand_constants[std::size_t(PHASE_SIN) * std::size_t(g.strands) + f] = strands.phase[f].y;
  }
  const auto append = [&](const auto& value) {
    for (std::size_t f = 0; f < count; ++f) g.strand_constants.push_back(value(f));
    g.strand_constants.resize(g.strand_constants.size() + std::size_t(g.strands) - count, 0.0f);
  };
  if (!input.style.length.empty())
    append([&](std::size_t f) { return strand_length(input.scene.fur, input.style, f); });
  if (!has_contact(input.scene.contact)) return;
  for (int k = 0; k < 3; ++k) append([&](std::size_t f) { return strands.root[f][k]; });
}

}  // namespace

Geometry lay_out(const FrameInput& input, int lanes) {
  const Mesh& mesh = *input.mesh;
  const FaceSprings& strands = input.strands;
  const bool separate = parts(input.scene), sticks = has_springs(input.scene.dynamics);
  if (sticks && input.stick_normal.size() != mesh.welded)
    throw InputError("FrameInput::stick_normal: a mass-spring topology needs one normal per surface point");
  std::vector<std::uint32_t> own(separate ? mesh.triangle.size() : 0);
  for (std::uint32_t f = 0; f < own.size(); ++f) own[f] = f;
  std::vector<Vertex> vertices = drawn_vertices(input);
  if (separate && !sticks)
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i].faces = std::span(own).subspan(i / 3, 1);

  Geometry g;
  g.vertices = padded(vertices.size() + 1);
  const auto stride = std::size_t(g.vertices);
  g.vertex.assign(VERTEX_COLUMNS * stride, 0.0f);
  g.uv.assign(2 * stride, 0.0f);
  const bool copies = input.scene.dynamics.springs.vertices == "copies";
  const bool radii = !input.style.curl_radius.empty();
  g.mask_uv.assign((radii ? 3 : 2) * stride, 0.0f);
  if (!input.style.curl_turns.empty()) g.turns.assign(stride, 0.0f);
  g.tangent.assign(RECORD * stride, 0.0f);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vertex& v = vertices[i];
    const std::uint32_t point = mesh.weld[v.copy];
    const int row = static_cast<int>(i);
    glm::dvec3 a(0.0);
    for (std::size_t e = 0; e < v.faces.size(); ++e)
      a += double(v.weights[e]) * double(share_of(input.style.length, v.faces[e])) *
           glm::dvec3(strands.normal[v.faces[e]]);
    if (sticks) {
      a = input.stick_normal[point];
      g.stick.push_back(separate ? std::uint32_t(i) : copies ? v.copy : point);
    }
    set_column3(g.vertex, VERTEX_X, g.vertices, row, mesh.position[v.copy]);
    set_column3(g.vertex, ROOT_X, g.vertices, row, glm::vec3(double(input.scene.fur.length) * a));
    set_column3(g.vertex, CURL_UX, g.vertices, row, input.curl.u[point]);
    set_column3(g.vertex, CURL_VX, g.vertices, row, input.curl.v[point]);
    g.mask_uv[i] = input.curl.mask_uv[point].x;
    g.mask_uv[stride + i] = input.curl.mask_uv[point].y;
    if (radii) g.mask_uv[2 * stride + i] = input.style.curl_radius[point];
    if (!g.turns.empty()) g.turns[i] = input.style.curl_turns[point];
    for (std::size_t k = 0; k < 2; ++k) g.uv[2 * i + k] = mesh.uv[v.copy][static_cast<int>(k)];
    for (std::size_t k = 0; k < 3; ++k) {
      g.tangent[RECORD * i + k] = input.tangents.t[v.copy][static_cast<int>(k)];
      g.tangent[RECORD * i + 3 + k] = input.tangents.b[v.copy][static_cast<int>(k)];
    }
  }

  const int blocks = g.vertices / lanes;
  g.slice.push_back(0);
  for (int block = 0; block < blocks; ++block) {
    std::size_t longest = 0;
    const auto first = std::size_t(block) * std::size_t(lanes);
    const std::size_t last = std::min(first + std::size_t(lanes), vertices.size());
    for (std::size_t i = first; i < last; ++i) longest = std::max(longest, vertices[i].faces.size());
    for (std::size_t e = 0; e < longest; ++e)
      for (std::size_t i = first; i < first + std::size_t(lanes); ++i) {
        const bool real = i < vertices.size() && e < vertices[i].faces.size();
        g.strand.push_back(real ? static_cast<std::int32_t>(vertices[i].faces[e]) : 0);
        g.weight.push_back(real ? vertices[i].weights[e] : 0.0f);
      }
    g.slice.push_back(g.slice.back() + static_cast<std::int32_t>(longest));
  }
  lay_out_corners(mesh, separate, g);
  lay_out_strands(input, g);
  return g;
}

}  // namespace pelage::shells
