#include "harness/commands/frame_dump.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include "harness/atomic_file.hpp"
#include "harness/error.hpp"
#include "harness/picture/hdf5_file.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/reference/layers.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/reference.hpp"
#include "harness/shells/reference/strands.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/springs/reference/some_sticks.hpp"
#include "harness/version/version.hpp"

namespace pelage {
namespace {

/// Vectors of floats (or bytes, or indices) as one flat array.
template <class Scalar, class Vector>
std::span<const Scalar> flat(const std::vector<Vector>& values) {
  static_assert(sizeof(Vector) % sizeof(Scalar) == 0);
  return {reinterpret_cast<const Scalar*>(values.data()), values.size() * (sizeof(Vector) / sizeof(Scalar))};
}

std::vector<glm::vec3> sum(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  std::vector<glm::vec3> out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] + b[i];
  return out;
}

/// The surface normal of docs/frame.md, 3: the direction of A, the mean of the triangles' rest springs.
std::vector<glm::vec3> vertex_normals(const FrameInput& input) {
  const StrandSet& strands = input.strands;
  std::vector<glm::vec3> normals(input.mesh->position.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const std::uint32_t point = input.mesh->weld[v];
    if (has_springs(input.scene.dynamics)) {
      normals[v] = input.stick_normal[point];
      continue;
    }
    glm::dvec3 mean(0.0);
    for (std::uint32_t i = strands.row[point]; i < strands.row[point + 1]; ++i) {
      mean += double(strands.weight[i]) * glm::dvec3(strands.normal[strands.face[i]]);
    }
    if (glm::length(mean) > 0) normals[v] = glm::vec3(glm::normalize(mean));
  }
  return normals;
}

void write_camera(Hdf5File& file, const Camera& camera) {
  // The rows of the view are the picture's right, down and forward; the projection's first two give pixels
  // from the picture's centre times w, the last w itself.
  const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.ray));
  const glm::dvec3 right = glm::normalize(glm::dvec3(camera.ray_dx));
  const glm::dvec3 down = glm::normalize(glm::dvec3(camera.ray_dy));
  const float focal = 1.0f / camera.pixel;
  std::vector<float> view;
  for (const glm::dvec3& axis : {right, down, forward}) {
    for (int i = 0; i < 3; ++i) view.push_back(static_cast<float>(axis[i]));
    view.push_back(static_cast<float>(-glm::dot(axis, glm::dvec3(camera.eye))));
  }
  view.insert(view.end(), {0, 0, 0, 1});
  const std::vector<float> projection{focal, 0, 0, 0, 0, focal, 0, 0, 0, 0, 0, camera.near, 0, 0, 1, 0};
  file.write("camera/view", {4, 4}, view, "R", "row-major; times (p, 1): right, down and forward of the eye");
  file.write(
      "camera/projection", {4, 4}, projection, "pixels",
      "row-major; times the view's result: x w, y w, near, w; x right and y down from the picture's centre");
}

void write_fur(Hdf5File& file, const FurTexture& fur) {
  const auto layers = static_cast<std::size_t>(fur.layers);
  for (std::size_t level = 0; level < fur.level.size(); ++level) {
    const std::size_t side = static_cast<std::size_t>(fur.size) >> level;
    file.write(level == 0 ? "fur" : fmt::format("fur_mip/{}", level), {layers, side, side, 2},
               flat<std::uint8_t>(fur.level[level]), "coverage / 255, shade / 127.5",
               "layer, v, u, (coverage, factor on the coat's colour)");
  }
}

/// B(t_n) + phi of every vertex and layer, by the reference from the scene's own strands.
void write_layers(Hdf5File& file, const FrameInput& input, int frames, const std::vector<glm::vec3>& tips) {
  const reference::Mask mask = reference::wetness_mask(input);
  const bool springs = has_springs(input.scene.dynamics);
  const reference::Geometry geometry(
      input, mask, springs ? 0 : frames, {}, reference::Mutant::none,
      springs ? std::vector<glm::dvec3>(tips.begin(), tips.end()) : std::vector<glm::dvec3>());
  const auto layers = static_cast<std::size_t>(input.scene.fur.layers);
  std::vector<glm::vec3> offset;
  offset.reserve(layers * geometry.slots());
  for (std::size_t n = 0; n < layers; ++n) {
    for (std::size_t slot = 0; slot < geometry.slots(); ++slot) {
      const glm::dvec3 base(input.mesh->position[geometry.vertex(slot)]);
      offset.push_back(glm::vec3(geometry.position(slot, static_cast<int>(n)) - base));
    }
  }
  const bool separate = parts(input.scene);
  file.write(
      "layer/offset", {layers, geometry.slots(), 3}, flat<float>(offset), "R",
      fmt::format("from the mesh's surface, per layer and {}; computed by the double-precision reference",
                  separate ? "triangle corner" : "vertex"));
}

void write_strands(Hdf5File& file, const FrameInput& input, const std::vector<glm::vec3>& tips) {
  std::vector<glm::vec3> root = input.strands.root, rest = sum(root, input.strands.anchor);
  std::string where = "centroids of the triangles";
  if (has_springs(input.scene.dynamics)) {
    const springs::Topology topology = springs::topology_of(input);
    const auto tops = topology.mass.begin() + std::ptrdiff_t(topology.sticks());
    root.assign(topology.mass.begin(), tops);
    rest.assign(tops, topology.mass.end());
    where = parts(input.scene) ? "corners of the triangles" : "surface points";
  }
  const std::size_t count = root.size();
  file.write("strand/root", {count, 3}, flat<float>(root), "R", where);
  file.write("strand/rest", {count, 3}, flat<float>(rest), "R", "tips at rest");
  file.write("strand/tip", {count, 3}, flat<float>(sum(root, tips)), "R", "tips in this frame");
}

}  // namespace

FrameOutput reference_motion(const FrameInput& input, int frames) {
  FrameOutput output{"reference", frames, {}, {}, {}};
  if (has_springs(input.scene.dynamics))
    for (const glm::dvec3& stick : springs::reference_sticks(input, frames))
      output.tips.push_back(glm::vec3(stick));
  else
    for (const reference::Strand& strand : reference::simulate(input, frames))
      output.tips.push_back(glm::vec3(strand.tip));
  for (const reference::Clump& clump : reference::wetness_mask(input).texel) {
    output.mask.push_back(glm::vec4(glm::vec2(clump.centre), clump.radius, clump.wetness));
  }
  return output;
}

FrameOutput reference_output(const FrameInput& input, int frames, bool eight_bit) {
  FrameOutput output = reference_motion(input, frames);
  reference::Options options;
  options.frames = frames;
  options.eight_bit = eight_bit;
  if (has_springs(input.scene.dynamics)) options.sticks.assign(output.tips.begin(), output.tips.end());
  output.image = reference::render(input, options);
  return output;
}

void check_dump_path(const std::filesystem::path& path) {
  if (path.extension() != ".h5" && path.extension() != ".hdf5") {
    throw InputError(fmt::format("{}: a frame is dumped into a file named .h5", path.string()));
  }
  require_place(path);
}

void dump_frame(const std::filesystem::path& path, const FrameInput& input, const FrameOutput& output) {
  check_dump_path(path);
  const Mesh& mesh = *input.mesh;
  const std::size_t vertices = mesh.position.size(), faces = mesh.triangle.size();
  const auto side = static_cast<std::size_t>(input.scene.wetness.size);
  const auto coat = static_cast<std::size_t>(input.coat.size);
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    Hdf5File file(temporary, path.string());
    const BuildInfo& build = build_info();
    file.note("pelage",
              fmt::format("{} {}{}", build.version, build.revision, build.dirty ? ", modified" : ""));
    file.note("pipeline", output.pipeline);
    file.note("frames", fmt::format("{}", output.frames));
    file.note("mesh_hash", mesh.hash);
    file.note("scene_hash", scene_hash(input.scene));
    // HDF5 keeps attributes below 64 KiB.
    if (const std::string scene = write_scene(input.scene); scene.size() < 60000) file.note("scene", scene);

    file.write("mesh/position", {vertices, 3}, flat<float>(mesh.position), "R",
               "vertices, copied along UV seams");
    file.write("mesh/triangle", {faces, 3}, flat<std::uint32_t>(mesh.triangle), "1",
               "vertex numbers, counter-clockwise seen from outside");
    file.write("mesh/uv", {vertices, 2}, flat<float>(mesh.uv), "UV", "texture coordinates");
    file.write("mesh/normal", {vertices, 3}, flat<float>(vertex_normals(input)), "1", "unit surface normals");
    write_strands(file, input, output.tips);
    file.write("mask", {side, side, 4}, flat<float>(output.mask), "UV, UV, UV, 1",
               "v, u, (c_u, c_v, r, rho) of Algorithm 1; all 0 where dry");
    write_fur(file, input.fur);
    file.write("colour", {coat, coat, 4}, flat<std::uint8_t>(input.coat.texel), "1 / 255",
               "v, u, (R, G, B, unused) of the coat, gamma space");
    write_layers(file, input, output.frames, output.tips);
    write_camera(file, input.camera);
    const Picture& image = output.image;
    file.write("image", {static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width), 4},
               flat<float>(image.pixel), "1",
               "top row first, RGBA in gamma space; alpha is the fur's coverage");
    file.close();
  });
}

}  // namespace pelage
