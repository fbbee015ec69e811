#include <fmt/format.h>

#include <array>
#include <glm/geometric.hpp>

#include "harness/atomic_file.hpp"
#include "harness/dump/dump.hpp"
#include "harness/error.hpp"
#include "harness/prepare/water.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/reference/layers.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/version/version.hpp"

namespace pelage::dump {
namespace {

std::vector<glm::vec3> sum(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  std::vector<glm::vec3> out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] + b[i];
  return out;
}

/// Returns the surface normal of each vertex (docs/shells.md, section 3). With a mass-spring topology, the
/// normal is the direction at rest of the vertex's stick (the spring from the surface to a moving mass). With
/// Silva's strands, it is the normalized weighted mean of the triangle normals.
std::vector<glm::vec3> vertex_normals(const FrameInput& input) {
  const FaceSprings& strands = input.strands;
  std::vector<glm::vec3> normals(input.mesh->position.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const std::uint32_t point = input.mesh->weld[v];
    if (has_springs(input.scene.dynamics)) {
      normals[v] = input.stick_normal[point];
      continue;
    }
    glm::dvec3 mean(0.0);
    for (std::uint32_t i = strands.row[point]; i < strands.row[point + 1]; ++i) {
      const std::vector<float>& length = input.style.length;
      const double share = length.empty() ? 1.0 : double(length[strands.face[i]]);
      mean += double(strands.weight[i]) * share * glm::dvec3(strands.normal[strands.face[i]]);
    }
    if (glm::length(mean) > 0) normals[v] = glm::vec3(glm::normalize(mean));
  }
  return normals;
}

/// Writes the camera as a view matrix and a projection matrix, for use by other programs.
void write_matrices(Hdf5File& file, const Camera& camera) {
  // The first three rows of the view matrix are the directions right, down and forward. Let w be the view
  // depth of a point. Rows 0 and 1 of the projection matrix give w times the point's offset in pixels from
  // the picture's centre. Row 3 gives w.
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
  file.write(
      "camera/view", {4, 4}, view, "R",
      "row-major matrix; its product with (p, 1) is (x, y, z, 1): the point p is x to the right of the eye, y below and z in front of it");
  file.write(
      "camera/projection", {4, 4}, projection, "pixels R, pixels R, R, R",
      "row-major matrix; its product with the vector (x, y, z, 1) of camera/view is (X, Y, near, w), with X, Y and w as in camera/rows and near = camera/near");
}

/// Writes the datasets that only Silva's strands have: normals, anchors, phases and weights.
void write_strand_rules(Hdf5File& file, const FaceSprings& strands) {
  file.write("strand/normal", strands.normal, "1", "unit normals n of the triangles");
  file.write(
      "strand/anchor", strands.anchor, "R",
      "vectors from the roots to the rest positions of the tips; their length is fur.length, with fur.length_map times style/length");
  file.write("strand/phase", strands.phase, "1",
             "cosine and sine of the wind gust's phase at the root (with keyframes of the wind: at 0 s)");
  file.write("weight/row", strands.row, "1",
             "entries row[p] to row[p + 1] - 1 of weight/strand and weight/value belong to surface point p");
  file.write("weight/strand", strands.face, "1",
             "index of the face spring of each entry; the triangle of this face spring has the same index");
  file.write(
      "weight/value", strands.weight, "1",
      "weight of each entry: area of its triangle, divided by the area of all triangles at the surface point");
}

void write_scene_text(Hdf5File& file, const Scene& scene) {
  const std::string text = write_scene(scene);
  file.write("scene", std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), "UTF-8",
             "the scene as TOML with all keys, as printed by `pelage scene`");
}

/// Writes the attributes of the file: versions, pipeline, number of frames, and hashes of mesh and scene.
void write_notes(Hdf5File& file, const Scene& scene, const Mesh& mesh, const std::string& pipeline,
                 int frames) {
  const BuildInfo& build = build_info();
  file.note("pelage", fmt::format("{} {}{}", build.version, build.revision, build.dirty ? ", modified" : ""));
  file.note("pipeline", pipeline);
  file.note("frames", fmt::format("{}", frames));
  file.note("mesh_hash", mesh.hash);
  file.note("scene_hash", scene_hash(scene));
}

/// Writes positions, triangles, UVs and surface points of the mesh.
void write_shape(Hdf5File& file, const Mesh& mesh) {
  file.write("mesh/position", mesh.position, "R",
             "positions of the vertices; a surface point on a UV seam has one vertex for each of its UVs");
  file.write(
      "mesh/triangle", mesh.triangle, "1",
      "indices of each triangle's three vertices, counter-clockwise seen from outside; triangles are drawn in this order");
  file.write("mesh/uv", mesh.uv, "UV", "texture coordinates (u, v) of each vertex");
  file.write("mesh/point", mesh.weld, "1", "index of each vertex's surface point");
}

/// Writes the normals, the tangents and the frames of the curl.
void write_mesh(Hdf5File& file, const FrameInput& input) {
  file.write("mesh/normal", vertex_normals(input), "1", "unit surface normals at the vertices");
  file.write("tangent/t", input.tangents.t, "R/UV",
             "derivative of the surface position with respect to u, at each vertex");
  file.write("tangent/b", input.tangents.b, "R/UV",
             "derivative of the surface position with respect to v, at each vertex");
  file.write("curl/u", input.curl.u, "1", "first axis of the curl at each surface point, unit length");
  file.write("curl/v", input.curl.v, "1", "second axis of the curl at each surface point, unit length");
  file.write(
      "curl/mask_uv", input.curl.mask_uv, "UV",
      "UV at which the curl at each surface point reads the wetness mask: the UV of the point's first vertex");
}

void write_strands(Hdf5File& file, const FrameInput& input, const FrameOutput& output) {
  std::vector<glm::vec3> root = input.strands.root, rest = sum(root, input.strands.anchor);
  if (has_springs(input.scene.dynamics)) {
    const springs::SpringNetwork network = springs::network_of(input);
    const auto tops = network.mass.begin() + std::ptrdiff_t(network.sticks());
    root.assign(network.mass.begin(), tops);
    rest.assign(tops, network.mass.end());
  }
  file.write("strand/root", root, "R", "roots: centroids of the triangles, or bases of the sticks");
  file.write(
      "strand/rest", rest, "R",
      "positions of the tips at rest: strand/root + strand/anchor, or for sticks strand/root + fur.length stick/normal");
  file.write("strand/tip", sum(root, output.tips), "R",
             "positions of the tips in this frame: strand/root + strand/offset");
  file.write("strand/offset", output.tips, "R",
             "q of this frame: positions of the tips relative to the roots");
  file.write("strand/velocity", output.velocities, "R/s", "v of this frame: velocities of the tips");
  if (has_springs(input.scene.dynamics))
    file.write("stick/normal", input.stick_normal, "1",
               "direction at rest of the sticks at each surface point, unit length");
  else
    write_strand_rules(file, input.strands);
}

void write_wetness(Hdf5File& file, const FrameInput& input, const FrameOutput& output) {
  const auto side = static_cast<std::size_t>(input.scene.wetness.size);
  const auto write = [&](const char* name, auto Droplet::*member, const char* units, const char* what) {
    file.write(name, column(input.droplets, member), units, what);
  };
  write("droplet/centre", &Droplet::centre, "UV",
        "centres c_drop of the droplets; docs/shells.md, section 2, defines the order of blending");
  write("droplet/radius", &Droplet::radius, "UV", "radii r_drop of the droplets");
  write("droplet/wetness", &Droplet::wetness, "1", "wetness rho_drop of each droplet when it has soaked in");
  write("droplet/arrival", &Droplet::arrival, "s", "times at which the droplets arrive");
  file.write(
      "droplet/rho", wetness_of_picture(input, output.frames), "1",
      "rho, the wetness of each droplet in this picture; if the water changes (docs/shells.md, section 10), droplets with 0 are not blended into the mask");
  write(
      "droplet/point", &Droplet::point, "R",
      "surface point whose UV is the droplet's centre; a repetition has the point of the droplet that it repeats");
  write("droplet/reach", &Droplet::reach, "R",
        "largest distance from droplet/point at which the droplet wets the surface");
  std::vector<std::uint32_t> number = column(input.droplets, &Droplet::number);
  for (std::uint32_t i = 0; i < number.size(); ++i)
    if (number[i] == Droplet::alone) number[i] = i;
  file.write("droplet/number", number, "1",
             "number of the droplet; adjacent entries of equal number are a droplet and its repetitions");
  file.write("mask_surface", {side, side}, input.mask_surface, "R",
             "surface point at the centre of each texel of the wetness mask; axes: v, u");
  file.write(
      "mask", {side, side}, output.mask, "UV, UV, UV, 1",
      "wetness mask: centre (c_u, c_v), radius r and wetness rho of the clump of each texel, all 0 in a texel that no droplet changed; axes: v, u");
}

void write_textures(Hdf5File& file, const FrameInput& input) {
  const FurTexture& fur = input.fur;
  const auto layers = static_cast<std::size_t>(fur.layers), coat = static_cast<std::size_t>(input.coat.size);
  for (std::size_t level = 0; level < fur.level.size(); ++level) {
    const std::size_t side = static_cast<std::size_t>(fur.size) >> level;
    file.write(level == 0 ? "fur" : fmt::format("fur_mip/{}", level), {layers, side, side}, fur.level[level],
               "1/255, 1/127.5",
               level == 0
                   ? "coverage of the fur, and its shade, a factor of the coat's colour; axes: layer, v, u"
                   : "mip level of fur with the number in the dataset's name");
  }
  file.write(
      "fur_scale", std::array{input.fur_scale.x, input.fur_scale.y}, "1/UV",
      "number of repeats of the fur texture per unit of u and of v: fur.tile times l_u and l_v (docs/shells.md, section 2), rounded to integers of at least 1 if the UV map is periodic");
  file.write("colour", {coat, coat}, input.coat.texel, "1/255",
             "colours of the coat in gamma space (red, green, blue and an unused channel); axes: v, u");
}

/// Writes the displacement of each vertex in each layer: its position in the layer minus its position on the
/// mesh. The double-precision reference computes the displacements from the scene's strands, or from
/// `output.tips` if a mass-spring topology moves the fur.
void write_layers(Hdf5File& file, const FrameInput& input, const FrameOutput& output) {
  const reference::Mask mask = reference::wetness_mask(input, output.frames);
  const bool springs = has_springs(input.scene.dynamics);
  const reference::Geometry geometry(
      input, mask, output.frames, {}, reference::Mutant::none,
      springs ? std::vector<glm::dvec3>(output.tips.begin(), output.tips.end()) : std::vector<glm::dvec3>());
  const auto layers = static_cast<std::size_t>(input.scene.fur.layers);
  std::vector<glm::vec3> offset;
  offset.reserve(layers * geometry.slots());
  for (std::size_t n = 0; n < layers; ++n) {
    for (std::size_t slot = 0; slot < geometry.slots(); ++slot) {
      const glm::dvec3 base(input.mesh->position[geometry.vertex(slot)]);
      offset.push_back(glm::vec3(geometry.position(slot, static_cast<int>(n)) - base));
    }
  }
  file.write(
      "layer/offset", {layers, geometry.slots()}, offset, "R",
      "position of each vertex in each layer, minus mesh/position; one entry per corner of a triangle if the layers of neighbouring triangles are not connected");
}

/// Writes the factors of the scene's maps (docs/shells.md, section 8) and the distance field of the mesh
/// among its colliders (docs/colliders.md). Writes nothing if the scene has none.
void write_style(Hdf5File& file, const FrameInput& input, int frames) {
  const Style& style = input.style;
  const auto write = [&](const char* name, const std::vector<float>& values, const char* what) {
    if (!values.empty()) file.write(name, values, "1", what);
  };
  write("style/length", style.length, "factor of fur.length of each face spring");
  write("style/comb", style.comb, "factor of fur.comb at each surface point");
  write("style/radius", style.curl_radius, "factor of curl.radius at each surface point");
  write("style/turns", style.curl_turns, "factor of curl.turns at each surface point");
  const Style::Density& density = style.density;
  if (!density.value.empty())
    file.write("style/density", {std::size_t(density.height), std::size_t(density.width)}, density.value, "1",
               "factor of fur.density at the centres of the map's pixels, top row (v = 1) first");
  if (input.contact_fields.empty()) return;
  const DistanceField field =
      contact_field_at(input.contact_fields, input.scene.contact.mesh, input.scene.dynamics,
                       reference::time_after(input.scene.dynamics, frames));
  file.write(
      "contact/field", {std::size_t(field.nodes.z), std::size_t(field.nodes.y), std::size_t(field.nodes.x)},
      field.distance, "1",
      "distance of each node of a grid from the surface of contact.mesh, negative inside, divided by contact.mesh_scale; axes: z, y, x");
  file.write(
      "contact/grid", std::array{field.origin.x, field.origin.y, field.origin.z, field.cell}, "1",
      "position of the field's first node relative to the centre of the mesh, and distance of adjacent nodes, both divided by contact.mesh_scale");
}

}  // namespace

void write_camera(Hdf5File& file, const Camera& camera) {
  file.write(
      "camera/rows", std::array{camera.row_x, camera.row_y, camera.row_w}, "pixels R, pixels R, R",
      "row_x, row_y and row_w; their dot products with (p, 1) are X, Y and w: the point p is X / w pixels to the right of the picture's centre and Y / w below it, at the view depth w");
  file.write("camera/eye", {}, std::array{camera.eye}, "R", "position of the eye");
  file.write(
      "camera/ray", std::array{camera.ray, camera.ray_dx, camera.ray_dy}, "1, 1/pixel, 1/pixel",
      "direction of the ray through the picture's centre, and its change per pixel in x and in y; not normalized");
  file.write("camera/pixel", std::array{camera.pixel}, "1",
             "width of a pixel at the view depth w, divided by w");
  file.write("camera/near", std::array{camera.near}, "R", "view depth of the near plane");
  file.write("camera/size", std::array{std::uint32_t(camera.width), std::uint32_t(camera.height)}, "pixels",
             "width and height of the picture");
  write_matrices(file, camera);
}

void write_shells(Hdf5File& file, const FrameInput& input, const FrameOutput& output) {
  write_mesh(file, input);
  write_strands(file, input, output);
  write_wetness(file, input, output);
  write_textures(file, input);
  write_layers(file, input, output);
  write_camera(file, input.camera);
  write_style(file, input, output.frames);
}

}  // namespace pelage::dump

namespace pelage {

void check_dump_path(const std::filesystem::path& path) {
  if (path.extension() != ".h5" && path.extension() != ".hdf5")
    throw InputError(fmt::format("{}: the name of a dump must end in .h5 or .hdf5", path.string()));
  require_place(path);
}

void write_dump(const std::filesystem::path& path, const DumpedFrame& frame,
                const std::function<void(Hdf5File&)>& arrays) {
  check_dump_path(path);
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    Hdf5File file(temporary, path.string());
    dump::write_notes(file, frame.scene, frame.mesh, frame.title, frame.frames);
    dump::write_scene_text(file, frame.scene);
    dump::write_shape(file, frame.mesh);
    arrays(file);
    const Picture& image = frame.picture;
    file.write(
        "image", {static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width)}, image.pixel,
        "1",
        "RGBA in gamma space, top row first; alpha is 1 where the base surface covers the pixel, else the combined coverage of the fur");
    file.close();
  });
}

}  // namespace pelage
