#include "harness/strands/scene/strand_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/prepare/coat.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/strands/drawing/detail.hpp"
#include "harness/strands/groom/fur.hpp"

namespace pelage::strands {
namespace {

/// Lengths of the strands, R.
struct Lengths {
  float longest = 0;  ///< no point of a strand is further from its root
  float mean = 0;
};

/// Returns the strands; of strands of a file, the curves at the roots, one of each.
std::vector<KeyedStrand> at_roots(const Fur& fur) {
  if (!fur.shapes) return fur.strands;
  std::vector<KeyedStrand> roots;
  for (std::size_t i = 0; i < fur.strands.size(); ++i)
    if ((*fur.shapes)[i].from == 0) roots.push_back(fur.strands[i]);
  return roots;
}

Lengths lengths_of(const Fur& fur, const std::vector<KeyedStrand>& roots) {
  float longest = 0;
  double sum = 0;
  for (std::size_t i = 0; i < fur.strands.size(); ++i) {
    const float length = fur.strands[i].length;
    float offset = 0;
    if (fur.shapes)
      for (const glm::vec3& o : (*fur.shapes)[i].offset) offset = std::max(offset, glm::length(o));
    longest = std::max(longest, length + offset);
  }
  for (const KeyedStrand& root : roots) sum += double(root.length);
  return {longest, float(sum / double(roots.size()))};
}

/// Returns the greatest distance of a surface point from the origin in any frame of the mesh, R. The result
/// is at least 1.
float reach_of(const Mesh& mesh) {
  float reach = 1;
  for (const std::vector<glm::vec3>& frame : mesh.frames)
    for (const glm::vec3& p : frame) reach = std::max(reach, glm::length(p));
  return reach;
}

/// Throws InputError if the scene has keys that do not agree with the frames of the mesh.
void check_frames(const Scene& scene) {
  const MotionScene still, &m = scene.dynamics.motion;
  if (m.velocity != still.velocity || m.shake != still.shake || m.spin != still.spin ||
      m.swing != still.swing)
    throw InputError(
        "dynamics.motion: the frames of the mesh (mesh.frames) contain the motion, so the object must not move; leave out dynamics.motion");
  if (scene.strands.chain.collision == "body")
    throw InputError(
        "strands.chain.collision: \"body\" needs a mesh that does not deform, but mesh.frames is above 1; give \"plane\"");
}

/// Divides the segments of a strand of a file among its curves.
void divide_segments(StrandInput& input) {
  Look& look = input.look;
  look.strand_segments = look.segments;
  if (look.own_segments) return;
  int most = 1;
  for (const StrandShape& s : *input.shapes) most = std::max(most, segments_of_part(look, s.from, s.to));
  look.segments = most;
}

/// Sets the camera, the look and the depth range of the scene. The other members of `input` are known.
void set_view(StrandInput& input) {
  const Scene& scene = input.scene;
  const Mesh& mesh = *input.mesh;
  input.look = look_of(scene);
  input.look.film = input.fur.film;
  if (mesh.strands && !mesh.strands->lines.width.empty()) input.look.taper = 0;  // the file has its own
  const std::vector<KeyedStrand> roots = at_roots(input.fur);
  const auto [length, mean_length] = lengths_of(input.fur, roots);
  input.look.shadow = {shadow_named(scene.strands.shadow), scene.strands.shadow_size, mean_length,
                       reach_of(mesh) + length};
  std::vector<glm::vec3> extent(mesh.position.begin(), mesh.position.end());
  for (const std::vector<glm::vec3>& frame : mesh.frames)
    extent.insert(extent.end(), frame.begin(), frame.end());
  if (mesh.strands)
    extent.insert(extent.end(), mesh.strands->lines.point.begin(), mesh.strands->lines.point.end());
  else
    for (const KeyStrand& key : input.fur.keys) extent.push_back(key.root + length * key.rest);
  input.camera = make_camera(scene.camera, scene.image, extent, mesh.frames.empty() ? 0 : length);
  std::vector<float> biases;
  std::vector<int> offsets;
  for (const StrandLayerScene& layer : scene.strands.layers) {
    biases.push_back(layer.order_bias);
    offsets.push_back(layer.order_offset);
  }
  const std::vector<std::uint8_t> ranks = layer_ranks(input.fur.bounds, input.camera, biases, offsets);
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    input.look.layers[i].first_frame = input.fur.layers[i].first_frame;
    input.look.layers[i].frames = input.fur.layers[i].frames;
    input.look.layers[i].rank = ranks[i];
  }
  input.range = depth_range(input.camera, reach_of(mesh) + length);
  const Spread spread = spread_of(roots, mesh);
  input.look.fraction =
      std::min(input.look.fraction, fraction_on_screen(input.camera, spread, scene.strands.least_width));
  input.look.width_factor = overlap_factor(input.camera, input.look, spread);
  if (scene.strands.subdivision == "screen")
    input.look.segments = segments_on_screen(input.camera, input.range, length, scene.strands.segments);
  if (input.shapes) divide_segments(input);
}

}  // namespace

Shadow shadow_named(const std::string& name) {
  return name == "none" ? Shadow::none : name == "linear" ? Shadow::linear : Shadow::exponential;
}

Look look_of(const Scene& scene) {
  const StrandsScene& strands = scene.strands;
  const ShadingScene& shading = scene.shading;
  Look look;
  look.segments = strands.segments;
  look.own_segments = strands.subdivision == "strand";
  look.back_facing = strands.back_facing == "removed" ? BackFacing::removed
                     : strands.back_facing == "last"  ? BackFacing::last
                                                      : BackFacing::drawn;
  look.fraction = strands.fraction;
  look.taper = strands.taper;
  look.opacity = strands.opacity;
  look.light = shading.lights.front().direction;
  look.intensity = shading.lights.front().intensity;
  look.ambient = shading.ambient;
  look.specular = shading.specular;
  look.exponent = std::max(1.0f, shading.exponent);
  for (std::size_t i = 1; i < shading.lights.size(); ++i)
    look.fills.push_back({shading.lights[i].direction, glm::vec3(shading.lights[i].intensity)});
  for (const StrandFillScene& fill : strands.fills) look.fills.push_back({fill.direction, fill.colour});
  for (std::size_t i = 0; i < strands.layers.size(); ++i) {
    const StrandLayerScene& layer = strands.layers[i];
    const auto need = [&](const char* key, float factor, const char* of, float all, float least, float most) {
      if (!(factor * all >= least && factor * all <= most))
        throw InputError(
            fmt::format("strands.layer[{}].{}: {} times {} is {}; the product must be from {} to {}", i + 1,
                        key, factor, of, factor * all, least, most));
    };
    need("opacity", layer.opacity, "strands.opacity", strands.opacity, 0, 1);
    need("taper", layer.taper, "strands.taper", strands.taper, 0, 1);
    need("exponent", layer.exponent, "shading.exponent", look.exponent, 1, 10000);
    need("rim_exponent", layer.rim_exponent, "strands.rim_exponent", strands.rim_exponent, 1, 1000);
    need("skin_shadow", layer.skin_shadow, "strands.skin_shadow", strands.skin_shadow, 0, 1);
    look.layers.push_back({.rank = int(i),
                           .opacity = layer.opacity,
                           .taper = layer.taper,
                           .gloss = layer.gloss,
                           .exponent = layer.exponent,
                           .rim = layer.rim,
                           .rim_exponent = layer.rim_exponent,
                           .skin_shadow = layer.skin_shadow});
  }
  look.bands = strands.bands;
  look.rim = strands.rim;
  look.rim_exponent = strands.rim_exponent;
  look.skin_shadow = strands.skin_shadow;
  look.skin_shadow_height = strands.skin_shadow_height;
  look.background = scene.image.background;
  return look;
}

namespace {

springs::Wind wind_on_chains(const DynamicsScene& dynamics, float drag) {
  if (dynamics.wind.strength > 0 && !(drag > 0))
    throw InputError(
        "dynamics.wind.strength: the wind has no effect on strands without drag; give strands.chain.drag above 0");
  return springs::wind_of(dynamics.wind, dynamics.mass * drag);
}

}  // namespace

ChainDynamics chain_dynamics(const Scene& scene) {
  const DynamicsScene& d = scene.dynamics;
  const ChainScene& chain = scene.strands.chain;
  ChainDynamics dynamics;
  dynamics.step = d.step;
  dynamics.first_segment = chain.first_segment;
  dynamics.tip_mass = chain.tip_mass;
  dynamics.drag = chain.drag;
  dynamics.damping_first = chain.damping;
  dynamics.damping_second = chain.damping_joint;
  dynamics.gravity = d.gravity;
  dynamics.wind = wind_on_chains(d, chain.drag);
  dynamics.motion = springs::motion_of(d.motion);
  return dynamics;
}

namespace {

CoatTexture plain_coat(glm::vec3 colour) {
  const auto byte = [](float value) {
    return std::uint8_t(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
  };
  return {1, {{byte(colour.x), byte(colour.y), byte(colour.z), 255}}};
}

/// Throws InputError if colliders and strands would move in different frames.
void check_contact(const Scene& scene, const Mesh& mesh) {
  if (!has_contact(scene.contact)) return;
  const MotionScene& m = scene.dynamics.motion;
  if (!mesh.frames.empty() || m.velocity != glm::vec3(0) || m.shake != glm::vec3(0) || m.spin != 0 ||
      m.swing != 0)
    throw InputError(
        "contact: colliders push strands only on an object that stays; leave out dynamics.motion and mesh.frames");
}

}  // namespace

std::shared_ptr<const StrandInput> prepare_strands(const Scene& scene, std::shared_ptr<const Mesh> mesh) {
  if (!mesh || (mesh->triangle.empty() && !mesh->strands))
    throw InputError("mesh: no triangles; give a mesh with at least one triangle");
  if (!mesh->frames.empty()) check_frames(scene);
  check_contact(scene, *mesh);
  auto input = std::make_shared<StrandInput>();
  input->scene = scene;
  input->contact_fields = contact_fields(scene.contact.mesh);
  const bool bare = mesh->triangle.empty();  // strands of a file without a mesh
  const CoatTexture coat = bare ? plain_coat(scene.coat.colour) : kept_coat(*mesh, scene.coat);
  input->fur =
      mesh->strands ? fur_of_file(*mesh->strands, scene.strands, coat) : kept_fur(*mesh, scene.strands, coat);
  input->shapes = input->fur.shapes;
  if (scene.strands.skin && !bare)
    input->skin = std::make_shared<SkinSurface>(skin_surface(*mesh, coat, scene.coat.skin));
  input->dynamics = chain_dynamics(scene);
  input->first_segment = input->dynamics.first_segment;
  const ChainScene& chain = scene.strands.chain;
  if (chain.collision == "body") input->dynamics.body = kept_distance_field(mesh, chain.body_cells);
  input->mesh = std::move(mesh);
  set_view(*input);
  return input;
}

std::shared_ptr<const StrandInput> with_view(const StrandInput& input, const Scene& scene) {
  auto changed = std::make_shared<StrandInput>(input);
  changed->scene = scene;
  set_view(*changed);
  return changed;
}

bool is_view_key(std::string_view key) {
  if (key.starts_with("strands."))
    return key != "strands.skin" && !key.starts_with("strands.chain.") && key != "strands.groom" &&
           !key.starts_with("strands.file");
  return key.starts_with("camera.") || key.starts_with("shading.") || key == "image.background";
}

namespace {

std::vector<glm::vec3> rest_of(const Fur& fur) {
  std::vector<glm::vec3> rest;
  for (const KeyStrand& key : fur.keys) rest.push_back(key.rest);
  return rest;
}

}  // namespace

ChainDynamics dynamics_of_frame(const StrandInput& input, int frame) {
  ChainDynamics dynamics = input.dynamics;
  if (!forces_change(input.scene)) return dynamics;
  const DynamicsScene forces = pelage::dynamics_of_frame(input.scene, frame);
  dynamics.gravity = forces.gravity;
  dynamics.wind = wind_on_chains(forces, dynamics.drag);
  return dynamics;
}

SkinFrames::SkinFrames(const Scene& scene, std::shared_ptr<const Mesh> mesh, const Fur& fur,
                       std::shared_ptr<const SkinSurface> surface)
    : mesh_(std::move(mesh)),
      skin_(weld(*mesh_)),
      motion_(*mesh_, fur.points, rest_of(fur)),
      surface_(std::move(surface)),
      duration_(double(scene.dynamics.step) * scene.dynamics.substeps),
      repeat_(scene.mesh.after_frames == "repeat") {}

void SkinFrames::advance() {
  // The first drawn frame shows the first frame of the mesh, as the skin at rest does.
  if (calls_++ == 1) return;
  const std::size_t count = mesh_->frames.size();
  if (!repeat_ && next_ == count) {
    frame_.velocity.assign(frame_.velocity.size(), glm::vec3(0));
    frame_.acceleration.assign(frame_.acceleration.size(), glm::vec3(0));
    return;
  }
  const std::vector<glm::vec3>& position = mesh_->frames[next_ % count];
  ++next_;
  frame_ = motion_.next(position, duration_);
  if (!surface_) return;
  auto surface = std::make_shared<SkinSurface>(*surface_);
  const std::vector<glm::dvec3> normals = normals_of(skin_, position);
  for (std::size_t v = 0; v < surface->position.size(); ++v) {
    surface->position[v] = position[mesh_->weld[v]];
    surface->normal[v] = glm::vec3(normals[mesh_->weld[v]]);
  }
  surface_ = std::move(surface);
}

}  // namespace pelage::strands
