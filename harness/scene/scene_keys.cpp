// The table of all keys of a scene. In the help texts of the keys, R is the radius of the model's bounding
// sphere, L0 is fur.length, S and W are the papers of Silva et al. 2010 about curling fur and about wet fur,
// and B is the paper of Banisch and Wuethrich 2006 (docs/shells.md).
#include "harness/scene/scene_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/error.hpp"
#include "harness/scene/pipelines.hpp"
#include "harness/scene/shading_models.hpp"
#include "harness/scene/spring_kinds.hpp"

namespace pelage {
namespace {

template <class Row>
std::vector<std::string_view> names_of(std::span<const Row> table) {
  std::vector<std::string_view> names;
  for (const Row& row : table) names.push_back(row.name);
  return names;
}

std::string_view shading_help() {
  static const std::string text = [] {
    std::string list = "lighting model: ";
    for (const ShadingModel& model : shading_models())
      list += fmt::format("{}\"{}\" is {}", &model == &shading_models().front() ? "" : ", ", model.name,
                          model.what);
    return list;
  }();
  return text;
}

std::string_view pipeline_help() {
  static const std::string text =
      "the pipeline that draws the scene, unless --pipeline names another: " + pipelines_help();
  return text;
}

/// Returns "silva", "chains" and the names of the mass-spring topologies.
std::vector<std::string_view> topology_names() {
  std::vector<std::string_view> names = names_of(springs::kinds);
  names.insert(names.begin(), {"silva", "chains"});
  return names;
}

// clang-format off
std::vector<Key> droplet_keys(DropletScene& droplet) {
  return {
      {"uv", &droplet.uv, "UV units", -1e6, 1e6, "centre in UV space; give either uv or point"},
      {"point", &droplet.point, "R", -1e6, 1e6, "centre in space, moved to the nearest surface point; give either uv or point"},
      {"radius", &droplet.radius, "UV units or R", 0.0001, 1, "r_drop, the radius of the droplet, in the unit wetness.unit"},
      {"wetness", &droplet.wetness, "", 0, 1, "rho_drop, the wetness of the droplet"},
      {"time", &droplet.time, "s", 0, 3600, "time at which the droplet arrives (docs/shells.md, section 10)"},
  };
}

std::vector<Key> light_keys(LightScene& light) {
  return {
      {"direction", &light.direction, "direction", -1e6, 1e6, "direction towards the light"},
      {"intensity", &light.intensity, "", 0, 1000, "intensity of the light"},
  };
}

std::vector<Key> motion_keys(ContactMotion& motion) {
  return {
      {"velocity", &motion.velocity, "R/s", -1000, 1000, "velocity of the collider"},
      {"begin", &motion.begin, "s", 0, longest_contact, "time at which the collider appears, at the given position"},
      {"end", &motion.end, "s", 0, longest_contact, "time at which the collider disappears"},
  };
}

std::vector<Key> joined(std::vector<Key> keys, const std::vector<Key>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}
// clang-format on

/// Returns the description of the list `entries`.
template <class Entry, class Keys>
KeyList list_of(std::string_view name, std::string_view entry, std::size_t least, std::size_t most,
                std::vector<Entry>& entries, Keys keys) {
  return {name,
          entry,
          least,
          most,
          [&entries] { return entries.size(); },
          [&entries](std::size_t size) { entries.resize(size); },
          [&entries, keys](std::size_t i) { return keys(entries[i]); }};
}

// clang-format off
std::vector<Key> contact_keys(ContactScene& c) {
  ContactMeshScene& mesh = c.mesh;
  ContactMotion& motion = mesh.motion;
  return {
      {.name = "contact.mesh", .slot = &mesh.file, .unit = "", .help = "mesh file of a collider, which must be closed; pelage scales it to a bounding sphere of radius 1 around the origin, and contact.mesh_scale and contact.mesh_position then scale and move it; \"\": no such collider"},
      {"contact.mesh_position", &mesh.position, "R", -1000, 1000, "position of the mesh's centre at the time contact.mesh_begin"},
      {"contact.mesh_scale", &mesh.scale, "R", 0.001, 100, "radius of the mesh's bounding sphere"},
      {"contact.mesh_cells", &mesh.cells, "", 4, 256, "number of cells of the signed distance field along the longest side of the mesh"},
      {"contact.mesh_velocity", &motion.velocity, "R/s", -1000, 1000, "velocity of the mesh's centre"},
      {"contact.mesh_axis", &mesh.axis, "direction", -1e6, 1e6, "axis of the mesh's rotation, through its centre"},
      {"contact.mesh_spin", &mesh.spin, "rad/s", -1000, 1000, "angular velocity of the mesh; at the time contact.mesh_begin it has not yet turned"},
      {"contact.mesh_frames", &mesh.frames, "", 1, most_mesh_frames, "number of files of a mesh that deforms; contact.mesh is the first, the number in its name counts up, and the next file follows after dynamics.substeps time steps; 1: the mesh does not deform"},
      {.name = "contact.mesh_after_frames", .slot = &mesh.after_frames, .unit = "", .help = "what follows the last file: \"hold\" keeps its shape, \"repeat\" begins again with the first file", .choices = {"hold", "repeat"}},
      {"contact.mesh_begin", &motion.begin, "s", 0, longest_contact, "time at which the mesh appears"},
      {"contact.mesh_end", &motion.end, "s", 0, longest_contact, "time at which the mesh disappears"},
  };
}

std::vector<Key> contact_sphere_keys(ContactSphereScene& s) {
  return joined({
      {"centre", &s.centre, "R", -1000, 1000, "centre of the sphere at the time begin"},
      {"radius", &s.radius, "R", 0.001, 100, "radius of the sphere"},
  }, motion_keys(s.motion));
}

std::vector<Key> contact_capsule_keys(ContactCapsuleScene& c) {
  return joined({
      {"from", &c.from, "R", -1000, 1000, "first end of the capsule's axis at the time begin"},
      {"to", &c.to, "R", -1000, 1000, "second end of the capsule's axis at the time begin"},
      {"radius", &c.radius, "R", 0.001, 100, "radius of the capsule"},
  }, motion_keys(c.motion));
}

}  // namespace

std::vector<Key> scene_keys(Scene& s) {
  MeshScene& mesh = s.mesh;
  FurScene& fur = s.fur;
  CurlScene& curl = s.curl;
  WetnessScene& wetness = s.wetness;
  ClumpScene& clump = s.clump;
  DynamicsScene& dynamics = s.dynamics;
  WindScene& wind = s.dynamics.wind;
  SpringsScene& springs = s.dynamics.springs;
  MotionScene& motion = s.dynamics.motion;
  PokeScene& poke = s.dynamics.poke;
  ShadingScene& shading = s.shading;
  CoatScene& coat = s.coat;
  CameraScene& camera = s.camera;
  ImageScene& image = s.image;
  std::vector<Key> keys{
      {.name = "model", .slot = &s.model, .unit = "", .help = "the name of a model in experiments/models.toml, or the path of a mesh file; \"none\": strands of a file without a mesh"},
      {.name = "pipeline", .slot = &s.pipeline, .unit = "", .help = pipeline_help(), .choices = names_of(drawing_pipelines())},

      {.name = "mesh.up", .slot = &mesh.up, .unit = "", .help = "the axis that points up in the mesh file; in a scene y points up, so \"z\" rotates the model by -90 degrees about x before mesh.rotate", .choices = {"y", "z"}},
      {"mesh.rotate", &mesh.rotate, "degrees", -360, 360, "rotation of the model about the fixed axes x, then y, then z"},
      {.name = "mesh.components", .slot = &mesh.components, .unit = "", .help = "components of a mesh file that are kept: \"all\" keeps every component that is closed or large, each with its own chart in the UV map; \"largest\" keeps the component with the most faces", .choices = {"all", "largest"}},
      {"mesh.frames", &mesh.frames, "", 1, most_mesh_frames, "number of frames of a mesh that moves and deforms, for strands and for layers on sticks; the model is then the mesh file of the first frame, the number in its name counts up, and a new frame begins every dynamics.substeps time steps; 1: the mesh does not deform"},
      {.name = "mesh.after_frames", .slot = &mesh.after_frames, .unit = "", .help = "what follows after the last frame: \"hold\" keeps the last frame, \"repeat\" begins again with the first frame", .choices = {"hold", "repeat"}},

      {"fur.length", &fur.length, "R", 0.001, 1, "strand length L0"},
      {"fur.layers", &fur.layers, "", 2, 512, "N, the number of layers above the base surface"},
      {.name = "fur.texture", .slot = &fur.texture, .unit = "texels", .least = 16, .most = 1024, .help = "number of texels per side of a slice of the fur volume texture", .power_of_two = true},
      {"fur.tile", &fur.tile, "per R", 0.01, 100, "number of repeats of the fur texture along the surface"},
      {"fur.strands", &fur.strands, "", 0, 200000, "number of guard hairs in one slice"},
      {"fur.radius", &fur.radius, "texels", 0.1, 32, "mean radius of a guard hair at its root, in texels of a 256 x 256 slice"},
      {"fur.width", &fur.width, "times its thickness", 1, 16, "width of a guard hair, measured perpendicular to the direction in which it bends; 1: round hair; above 1: flat blade of grass"},
      {"fur.undercoat", &fur.undercoat, "", 0, 200000, "number of undercoat hairs in one slice"},
      {"fur.undercoat_length", &fur.undercoat_length, "of L0", 0, 1, "greatest length of an undercoat hair"},
      {"fur.least_length", &fur.least_length, "of L0", 0, 1, "length of the shortest guard hair"},
      {"fur.taper", &fur.taper, "", 0.01, 16, "exponent p of the taper of a hair: at the fraction t of the hair's length, the radius is 1 - (1 - fur.tip_radius) * t^p times the radius at the root, before the widening by fur.sweep"},
      {"fur.tip_radius", &fur.tip_radius, "of the root's", 0, 1, "radius of a hair at its tip"},
      {"fur.locks", &fur.locks, "", 0, 100000, "number of locks of hair in one slice; 0: no locks"},
      {"fur.lock_pull", &fur.lock_pull, "", 0, 1, "displacement of a hair towards the centre of its lock at the height fur.length, as a fraction of the distance from the hair's root to this centre"},
      {"fur.lock_power", &fur.lock_power, "", 0.01, 16, "exponent p: at the height h (0 at the root, 1 at fur.length), the displacement by fur.lock_pull is multiplied by h^p"},
      {"fur.bend", &fur.bend, "texels", 0, 256, "sideways offset of the tip of a blade of grass, in texels of a 256 x 256 slice"},
      {"fur.bend_exponent", &fur.bend_exponent, "", 0.01, 16, "exponent c of a blade's bend: at the fraction t of the blade's length, the sideways offset is fur.bend * (e^(c t) - 1) / (e^c - 1); a larger c moves the bend towards the tip"},
      {"fur.bend_spread", &fur.bend_spread, "of the exponent", 0, 0.99, "greatest random deviation of a blade's bend exponent from fur.bend_exponent"},
      {"fur.sweep", &fur.sweep, "", 0, 4, "tangent of an angle between view ray and hair; pelage widens all hairs so that view rays at this angle see no gaps between the layers; fur of 16 layers then looks like fur of 64 layers; 0: hairs are not widened"},
      {"fur.shade", &fur.shade, "", 0, 1, "greatest deviation of a hair's shade from 1; the shade is a random factor of the hair's colour"},
      {"fur.comb", &fur.comb, "", 0, 10, "tangent of the angle by which strands at rest tilt in the direction fur.comb_direction; 0: upright, as in S"},
      {"fur.comb_noise", &fur.comb_noise, "", 0, 10, "size of a random tilt of strands at rest, as the tangent of an angle; pelage adds this tilt to the tilt by fur.comb; the random tilt varies smoothly over the surface"},
      {"fur.comb_direction", &fur.comb_direction, "direction", -1e6, 1e6, "direction in which the fur is combed, projected onto the surface"},
      {"fur.lod_bias", &fur.lod_bias, "mip levels", -16, 16, "value added to the mip level of the fur texture lookup"},
      {.name = "fur.substeps", .slot = &fur.substeps, .unit = "", .least = 1, .most = 8, .help = "number of samples of the fur texture per fragment along the view ray within a layer; with few layers, more samples make curls smooth; 1: as in S and W", .power_of_two = true},
      {"fur.density", &fur.density, "", 0, 1, "factor of the fur's coverage: 0 is no fur, 1 is all fur"},
      {.name = "fur.layer_correction", .slot = &fur.layer_correction, .unit = "", .help = "where the coverage is corrected for a number of layers other than 16: in each \"texel\" before filtering; or in each \"fragment\" after the lookup, so that pictures converge as the number of layers grows", .choices = {"texel", "fragment"}},
      {.name = "fur.length_map", .slot = &fur.length_map, .unit = "", .help = "picture in UV space whose luma, 0 to 1, is a factor of fur.length (docs/shells.md, section 8); \"\": no map"},
      {.name = "fur.density_map", .slot = &fur.density_map, .unit = "", .help = "picture in UV space whose luma, 0 to 1, is a factor of fur.density; \"\": no map"},
      {.name = "fur.comb_map", .slot = &fur.comb_map, .unit = "", .help = "picture in UV space whose luma, 0 to 1, is a factor of fur.comb; \"\": no map"},
      {"fur.seed", &fur.seed, "", 0, most_seed, "random seed of the fur volume texture"},
      {.name = "fur.layer_spacing", .slot = &fur.layer_spacing, .unit = "", .help = "positions of the layers at rest: \"paper\" spaces the layers equally in the Bezier parameter t, as in S; \"uniform\" spaces them equally in height", .choices = {"paper", "uniform"}},
      {.name = "fur.binding", .slot = &fur.binding, .unit = "", .help = "displacement of the corners of a triangle: with \"shared\", a corner has the weighted mean of the displacements of the strands of all triangles around it; with \"separate\", all three corners have the displacement of the triangle's own strand", .choices = {"shared", "separate"}},
      {.name = "fur.uv", .slot = &fur.uv, .unit = "", .help = "UV map for fur, coat and wetness: \"computed\" by pelage; \"even\", computed with a separate chart for each part of the surface that the map would shrink or enlarge by much, so that the density of the fur varies less; or stored in the mesh \"file\"", .choices = {"computed", "even", "file"}},

      {"curl.radius", &curl.radius, "R", 0, 1, "K_alpha of S Eq. 4, the radius of the curl"},
      {"curl.turns", &curl.turns, "", -64, 64, "number of turns of the curl from root to tip; omega / (2 pi) in S Eq. 4"},
      {"curl.variation", &curl.variation, "turns", 0, 8, "greatest random shift of a curl's phase; the shift varies smoothly over the surface; used only if curl.frame is \"smooth\""},
      {.name = "curl.frame", .slot = &curl.frame, .unit = "", .help = "tangent frame of the curl: \"smooth\" uses a smoothed vector field, \"uv\" uses the gradient of the UV map", .choices = {"smooth", "uv"}},
      {.name = "curl.radius_map", .slot = &curl.radius_map, .unit = "", .help = "picture in UV space whose luma, 0 to 1, is a factor of curl.radius (docs/shells.md, section 8); \"\": no map"},
      {.name = "curl.turns_map", .slot = &curl.turns_map, .unit = "", .help = "picture in UV space whose luma, 0 to 1, is a factor of curl.turns; \"\": no map"},

      {"wetness.size", &wetness.size, "texels", 8, 4096, "number of texels per side of the wetness mask"},
      {"wetness.random", &wetness.random, "", 0, 100000, "maximum number of random droplets"},
      {"wetness.seed", &wetness.seed, "", 0, most_seed, "random seed of the droplets"},
      {"wetness.radius", &wetness.radius, "UV units or R", 0.0001, 1, "mean radius of random droplets, in the unit wetness.unit"},
      {.name = "wetness.unit", .slot = &wetness.unit, .unit = "", .help = "unit of the droplets' radii: \"uv\" is UV units; \"surface\" is R, so that the disc of a droplet has the same area on the surface wherever the droplet lies", .choices = {"uv", "surface"}},
      {"wetness.radius_spread", &wetness.radius_spread, "of the radius", 0, 0.99, "greatest random deviation from the mean radius"},
      {"wetness.wetness", &wetness.wetness, "", 0, 1, "mean wetness of random droplets"},
      {"wetness.wetness_spread", &wetness.wetness_spread, "", 0, 1, "greatest random deviation from the mean wetness"},
      {"wetness.spacing", &wetness.spacing, "radii", 0, 100, "least distance between the centres of random droplets"},
      {"wetness.patch_cover", &wetness.patch_cover, "", 0, 1, "fraction of the surface on which random droplets may be placed; 1: everywhere"},
      {"wetness.patch_size", &wetness.patch_size, "R", 0.01, 10, "approximate width of the areas on which random droplets may be placed (wetness.patch_cover); wetness fades towards the borders of an area"},
      {.name = "wetness.blend", .slot = &wetness.blend, .unit = "", .help = "which wet texels of its disc a droplet is blended with (S and W, Algorithm 1): \"near\" those whose clump's centre is at most the droplet's radius from the droplet's centre; \"overlap\" all, so that overlapping droplets form a new clump where they overlap; the droplet overwrites the other texels", .choices = {"near", "overlap"}},
      {.name = "wetness.seams", .slot = &wetness.seams, .unit = "", .help = "droplets whose disc reaches a seam of the UV map: \"joined\" ends the disc at the seam and repeats the droplet on the other side; \"ignored\" draws the disc in the mask, as in S, so that it may cover parts of other charts", .choices = {"ignored", "joined"}},
      {.name = "wetness.image", .slot = &wetness.image, .unit = "", .help = "picture in UV space: random droplets are placed only where its luma is at least 0.5; \"\": everywhere"},
      {"wetness.rate", &wetness.rate, "droplets/s", 0, 1e6, "number of random droplets that arrive per second, at equal intervals; 0: all arrive at wetness.begin (docs/shells.md, section 10)"},
      {"wetness.begin", &wetness.begin, "s", 0, 3600, "time at which the first random droplet arrives"},
      {"wetness.end", &wetness.end, "s", 0, 3600, "random droplets that would arrive after this time do not arrive"},
      {"wetness.soak", &wetness.soak, "s", 0, 3600, "time in which a droplet soaks into the fur; its wetness grows linearly from 0; 0: at once"},
      {"wetness.drying", &wetness.drying, "s", 0, 3600, "time constant of evaporation: without dripping, the wetness of a soaked droplet falls to 1/e in this time; 0: no evaporation"},
      {"wetness.drip", &wetness.drip, "1/s", 0, 1000, "wetness that a soaked droplet loses per second because water drips off, until it is dry"},
      {.name = "wetness.text", .slot = &wetness.text, .unit = "", .help = "text in UV space: random droplets are placed only in its letters; printable ASCII characters; \"\": everywhere", .may_be_empty = true},
      {"wetness.text_u", &wetness.text_u, "UV units", 0, 1, "u of the centre of wetness.text"},
      {"wetness.text_v", &wetness.text_v, "UV units", 0, 1, "v of the centre of wetness.text"},
      {"wetness.text_height", &wetness.text_height, "UV units", 0.01, 1, "height of the capital letter H in wetness.text"},
      {.name = "wetness.text_font", .slot = &wetness.text_font, .unit = "", .help = "TrueType or OpenType file with the letters of wetness.text; \"\": DejaVu Sans Bold (Debian: fonts-dejavu-core)"},

      {"clump.shape", &clump.shape, "", 0, 1, "w of S Eq. 5, which determines how the displacement of the fur by a clump grows with the height; 0: linearly, 1: by clump.function"},
      {.name = "clump.function", .slot = &clump.function, .unit = "", .help = "function of the height h that S Eq. 5 mixes with h: \"logarithmic\" is 1 + ln h / ln N, as in S and W; \"rate\" is min(3 h, 1), with which clump.shape is the clump-rate of Bruderlin (2000) in our reading, for his hairs of three segments", .choices = {clump_functions.begin(), clump_functions.end()}},
      {"clump.gain", &clump.gain, "", 0, 4096, "unit of r_mask in S Eq. 5 if clump.scale is \"literal\", as a number per UV unit: 1: UV units; 256: texels of a mask of 256 x 256 texels"},
      {.name = "clump.scale", .slot = &clump.scale, .unit = "", .help = "displacement d of the fur by a clump at a distance e from its centre (S Eq. 5): \"literal\" is clump.gain r_mask f rho e, as printed in S; \"distance\" is r_mask f rho, the same at all distances; \"converge\" draws each strand at (1 - f rho) of its root's distance from the centre, so that strands are straight if clump.shape is 0", .choices = {clump_scales.begin(), clump_scales.end()}},
      {.name = "clump.cells", .slot = &clump.cells, .unit = "", .help = "fragments at the border of a clump: \"literal\" discards the fragments that the printed S Algorithm 2 discards; \"separate\" also discards every fragment that its clump displaces into another clump; \"consistent\" shows a strand only where the clump at its root draws it, with soft borders, so that a clump appears and dries without a jump", .choices = {clump_cells.begin(), clump_cells.end()}},

      {"soaked.threshold", &s.soaked.threshold, "", 0, 1, "wetness from which on clumps disappear and a smooth, bright film of water covers the fur; the film is complete at the wetness 1; 1: no film"},
      {"soaked.height", &s.soaked.height, "of the fur's length", 0.01, 1, "height of the film of soaked fur"},
      {"soaked.gloss", &s.soaked.gloss, "", 0, 100, "factor of the highlight on the film of soaked fur, relative to shading.specular"},

      {.name = "blend.faces", .slot = &s.blend.faces, .unit = "", .help = "triangles of the layers: \"all\" draws all triangles of a layer in the mesh's order, so that fur of the far side covers fur of the near side; \"front\" draws only the triangles whose base faces the eye; \"back-then-front\" draws all layers of the triangles that face away, then all layers of the triangles that face the eye", .choices = {face_orders.begin(), face_orders.end()}},
      {.name = "blend.order", .slot = &s.blend.order, .unit = "", .help = "order in which the fragments of a pixel are blended: \"layer\" is the order of blend.faces; \"depth\" blends the farthest fragment first, so that near fur covers far fur everywhere. The OpenCL mapping group draws \"depth\" instead of the mapping tile; the OpenGL baseline does not support it", .choices = {blend_orders.begin(), blend_orders.end()}},

      {.name = "dynamics.topology", .slot = &dynamics.topology, .unit = "", .help = "model of the fur's motion: \"silva\" has one strand of Silva et al. per triangle; \"chains\" is only for the pipelines that draw strands, which always simulate chains of two segments (docs/strands.md); the other values are mass-spring topologies (docs/springs.md)", .choices = topology_names()},
      {.name = "dynamics.solver", .slot = &dynamics.solver, .unit = "", .help = "time integration scheme of a topology; \"silva\" supports semi-implicit Euler only", .choices = names_of(springs::methods)},
      {.name = "dynamics.bend", .slot = &dynamics.bend, .unit = "", .help = "positions of the layers if dynamics.topology is a mass-spring topology: \"linear\" places them on the straight stick; \"paper\" uses B Eq. 4 as printed; \"tangent\" uses B Eq. 4 without the component of the bend along the surface normal; \"trigonometric\", for the model lambert, places them on arcs (docs/springs.md)", .choices = {"linear", "paper", "tangent", "trigonometric"}},
      {"dynamics.bend_power", &dynamics.bend_power, "", 1, 16, "k of B Eq. 4"},
      {"dynamics.mass", &dynamics.mass, "kg", 1e-9, 1000, "m, the mass at a strand's tip"},
      {"dynamics.stiffness", &dynamics.stiffness, "N/m, with 1 R = 1 m", 1e-6, 1e6, "k, the stiffness of the spring of Silva's strand"},
      {"dynamics.drag", &dynamics.drag, "N s/m", 0, 1e6, "c, the drag coefficient of a mass"},
      {"dynamics.step", &dynamics.step, "s", 1e-6, 1, "dt, the duration of a substep"},
      {"dynamics.substeps", &dynamics.substeps, "", 1, 1000, "number of substeps per frame"},
      {"dynamics.tolerance", &dynamics.tolerance, "of fur.length", 0, 1, "permitted error of the positions of a topology's top masses (the moving ends of its sticks) after one frame, as a fraction of fur.length; pelage chooses the number of substeps so that at most 1% of the top masses have a larger estimated error; 0: pelage computes dynamics.substeps substeps in every frame"},
      {"dynamics.time", &dynamics.time, "s", 0, 3600, "simulated time before the first picture"},
      {"dynamics.gravity", &dynamics.gravity, "R/s^2", -1000, 1000, "gravitational acceleration of all masses"},
      {"dynamics.wind.direction", &wind.direction, "direction", -1e6, 1e6, "direction in which the wind blows"},
      {"dynamics.wind.strength", &wind.strength, "N", 0, 1000, "force of the wind on a strand's mass"},
      {"dynamics.wind.gust", &wind.gust, "of the strength", 0, 100, "amplitude of the gusts"},
      {"dynamics.wind.frequency", &wind.frequency, "Hz", 0, 1000, "frequency of the gusts"},
      {"dynamics.wind.wavelength", &wind.wavelength, "R", 0.001, 1000, "distance between two gusts along the wind's direction"},
      {.name = "dynamics.wind.gust_at", .slot = &wind.gust_at, .unit = "", .help = "position at which the gusts on a stick are computed: \"stick\" is the base of the stick, so all sticks at one vertex have the same motion; \"triangle\" is the centroid of the stick's triangle, so the sticks of neighbouring triangles have different gusts and move apart; this key only affects topologies whose triangles share no sticks", .choices = {"stick", "triangle"}},
      {"dynamics.springs.stiffness", &springs.stiffness, "N/m, with 1 R = 1 m", 0, 1e6, "stiffness k of a topology's sticks"},
      {"dynamics.springs.damping", &springs.damping, "N s/m", 0, 1e6, "damping coefficient along a topology's sticks"},
      {"dynamics.springs.edge_stiffness", &springs.edge_stiffness, "N/m", 0, 1e6, "stiffness k of the springs between a topology's top masses"},
      {"dynamics.springs.edge_damping", &springs.edge_damping, "N s/m", 0, 1e6, "damping coefficient of the springs between a topology's top masses"},
      {"dynamics.springs.return_weight", &springs.return_weight, "N", 0, 1e6, "w of B Eq. 5, the weight of the return force; 0: no return force"},
      {"dynamics.springs.residual", &springs.residual, "", 1e-7, 0.1, "relative residual |r| / |b| at which the conjugate-gradient solver of backward Euler stops"},
      {.name = "dynamics.springs.vertices", .slot = &springs.vertices, .unit = "", .help = "where the sticks of the topologies sticks and prisms stand: at the surface \"points\", so that both sides of a UV seam share them; or at all vertices, which are \"copies\" on a seam, so that the layers separate there", .choices = {"points", "copies"}},
      {.name = "dynamics.springs.jacobian", .slot = &springs.jacobian, .unit = "", .help = "derivatives of the forces in the matrix of backward Euler: \"pruned\" omits the terms that would make the matrix asymmetric or indefinite; \"full\" uses all terms; \"full\" is only available in the reference", .choices = {"pruned", "full"}},
      {"dynamics.springs.reference_area", &springs.reference_area, "R^2", 0, 1000, "reference area per stick; if it is above 0, pelage multiplies the mass, stiffness, damping, drag and return weight of a stick by A / dynamics.springs.reference_area, where A is the mesh's mean surface area per stick; the constants of the springs between top masses do not change; 0: all constants are the same on every mesh"},
      {"dynamics.motion.velocity", &motion.velocity, "R/s", -1000, 1000, "velocity of the object; the resulting air drag moves the fur of a mass-spring topology; the camera moves with the object"},
      {"dynamics.motion.shake", &motion.shake, "R", -10, 10, "amplitude of the object's oscillating translation"},
      {"dynamics.motion.shake_frequency", &motion.shake_frequency, "Hz", 0, 1000, "frequency of the oscillating translation"},
      {"dynamics.motion.axis", &motion.axis, "direction", -1e6, 1e6, "axis of the object's rotation through the origin"},
      {"dynamics.motion.spin", &motion.spin, "rad/s", -1000, 1000, "angular velocity of a steady rotation"},
      {"dynamics.motion.swing", &motion.swing, "rad", -100, 100, "amplitude of an oscillating rotation"},
      {"dynamics.motion.swing_frequency", &motion.swing_frequency, "Hz", 0, 1000, "frequency of the oscillating rotation"},
      {"dynamics.poke.point", &poke.point, "R", -1e6, 1e6, "centre of a local force on a topology's top masses; if dynamics.poke.ray is not zero, this point is the origin of the ray instead"},
      {"dynamics.poke.ray", &poke.ray, "of any length", -1e6, 1e6, "direction of a ray that starts at dynamics.poke.point; the ray's first intersection with the mesh is the centre of the local force, and the force always acts on the intersected triangle; [0, 0, 0]: no ray"},
      {"dynamics.poke.radius", &poke.radius, "R", 0, 1e6, "radius of the local force: the force acts on every triangle whose centroid is within this distance of the centre of the force; 0: the force acts only on the triangle that the ray hits; 0 without a ray: there is no force"},
      {"dynamics.poke.force", &poke.force, "N", -1000, 1000, "force on each top mass of the triangles that dynamics.poke.radius and dynamics.poke.ray select"},
      {"dynamics.poke.spread", &poke.spread, "N", -1000, 1000, "additional force that pushes the fur apart; it acts on the same top masses as dynamics.poke.force and points away from an axis; the axis passes through the centre of the local force (dynamics.poke.point or the hit of dynamics.poke.ray) in the direction dynamics.poke.along"},
      {"dynamics.poke.along", &poke.along, "direction", -1e6, 1e6, "direction of an axis through the centre of the local force; the force dynamics.poke.spread points away from this axis"},

      {.name = "shading.model", .slot = &shading.model, .unit = "", .help = shading_help(), .choices = names_of(shading_models())},
      {.name = "shading.self_shadow", .slot = &shading.self_shadow, .unit = "", .help = "shadow of the fur on itself: \"darkening\" is the papers' factor, which darkens the fur towards the skin (shading.shadow, shading.occlusion); \"off\" is no shadow; \"traced\" samples the layers between a fragment and the first light", .choices = {self_shadows.begin(), self_shadows.end()}},
      {"shading.shadow", &shading.shadow, "", 1, 1000, "K_shadow, which determines the self-shadow of the curling model; the colour at the base surface is multiplied by (K_shadow - 1) / K_shadow, so a larger value gives a weaker shadow"},
      {"shading.specular", &shading.specular, "", 0, 100, "K_s, the colour of the highlight"},
      {"shading.exponent", &shading.exponent, "", 0, 10000, "p, the exponent of the highlight"},
      {"shading.ambient", &shading.ambient, "", 0, 100, "ambient light"},
      {"shading.wrap", &shading.wrap, "", 0, 1, "weight of the wrapped light (n.l + 0.4) / 1.4; 0: light as in S and W"},
      {"shading.occlusion", &shading.occlusion, "", 0, 1, "strength of the self-shadow in the models wet and lambert (sigma_occ of W Eq. 5); the colour at the base surface is multiplied by 1 - sigma_occ"},
      {"shading.darkening", &shading.darkening, "", 0, 1, "darkening by wetness in the model wet (sigma_wet of W Eq. 5); the colour of fully wet fur is multiplied by 1 - sigma_wet"},
      {"shading.wet_specular", &shading.wet_specular, "", 0, 0.99, "influence of wetness on the highlight in the model wet (sigma_spec of W Eq. 3); the exponent of the highlight is shading.exponent on fully wet fur and (1 - sigma_spec) * shading.exponent on dry fur"},
      {.name = "shading.tangent", .slot = &shading.tangent, .unit = "", .help = "direction of a strand in a clump, for the highlight of the model wet (W Eq. 4): \"paper\" uses the printed sign of the clump term, with lengths on the surface; \"drawn\" uses the opposite sign, with which the tangent tilts in the same direction as the drawn strands; \"strand\" is the direction of the strands as drawn; \"printed\" also uses the printed units, in which UV and heights are plain numbers", .choices = {tangent_readings.begin(), tangent_readings.end()}},
      {.name = "shading.sides", .slot = &shading.sides, .unit = "", .help = "sides of the surface that receive light: \"one\" is only the outside; \"two\" is both sides, for open meshes that are seen from behind", .choices = {"one", "two"}},

      {.name = "coat.image", .slot = &coat.image, .unit = "", .help = "colour texture in UV space; \"\": procedural coat"},
      {.name = "coat.pattern", .slot = &coat.pattern, .unit = "", .help = "pattern of a procedural coat", .choices = {"plain", "patches", "stripes", "spots", "grass"}},
      {"coat.colour", &coat.colour, "RGB", 0, 1, "main colour"},
      {"coat.second", &coat.second, "RGB", 0, 1, "second colour, which the pattern mixes with the main colour"},
      {"coat.scale", &coat.scale, "R", 0.001, 100, "length scale of the coat's pattern: approximate size of a patch, or distance between two neighbouring stripes or spots"},
      {"coat.skin", &coat.skin, "RGB", 0, 1, "factor by which the coat's colour is multiplied on the base surface"},
      {"coat.seed", &coat.seed, "", 0, most_seed, "random seed of the procedural coat"},
      {"coat.texture", &coat.texture, "texels", 1, 4096, "number of texels per side of a procedural coat"},
  };
  const std::vector<Key> contact = contact_keys(s.contact), strands = strand_keys(s.strands);
  keys.insert(keys.end(), contact.begin(), contact.end());
  keys.insert(keys.end(), strands.begin(), strands.end());
  const std::vector<Key> view{
      {.name = "camera.framed", .slot = &camera.framed, .unit = "", .help = "true: the camera is placed along camera.direction, at the nearest position at which the model with its fur fills at most 88% of the picture's height and at most 94% of its width; false: camera.eye and camera.target are used"},
      {"camera.direction", &camera.direction, "direction", -1e6, 1e6, "direction from the target to the eye"},
      {"camera.eye", &camera.eye, "R", -1e6, 1e6, "position of the camera if camera.framed is false"},
      {"camera.target", &camera.target, "R", -1e6, 1e6, "point in the centre of the picture if camera.framed is false"},
      {"camera.up", &camera.up, "direction", -1e6, 1e6, "direction that is up in the picture"},
      {"camera.fov", &camera.fov, "degrees", 1, 170, "vertical field of view"},
      {"camera.near", &camera.near, "R", 0.0001, 10, "distance from the eye to the near plane"},

      {"image.width", &image.width, "pixels", 1, 16384, "width of the picture"},
      {"image.height", &image.height, "pixels", 1, 16384, "height of the picture"},
      {"image.background", &image.background, "RGB", 0, 1, "colour behind the model"},
  };
  keys.insert(keys.end(), view.begin(), view.end());
  return keys;
}
// clang-format on

std::vector<KeyList> scene_lists(Scene& scene) {
  return {
      list_of(droplet_list, "droplets", 0, 100000, scene.wetness.droplets, droplet_keys),
      list_of(light_list, "lights", 1, 2, scene.shading.lights, light_keys),
      list_of(contact_sphere_list, "spheres", 0, most_colliders, scene.contact.spheres, contact_sphere_keys),
      list_of(contact_capsule_list, "capsules", 0, most_colliders, scene.contact.capsules,
              contact_capsule_keys),
      list_of(strand_layer_list, "fur layers", 1, 16, scene.strands.layers, strand_layer_keys),
      list_of(strand_fill_list, "fill lights", 0, 1000, scene.strands.fills, strand_fill_keys)};
}

std::string describe_range(const Key& key) {
  if (!key.choices.empty()) {
    std::string text;
    for (std::size_t i = 0; i < key.choices.size(); ++i) {
      text += fmt::format("{}\"{}\"",
                          i == 0                       ? ""
                          : i + 1 < key.choices.size() ? ", "
                                                       : " or ",
                          key.choices[i]);
    }
    return text;
  }
  if (std::holds_alternative<bool*>(key.slot)) return "true or false";
  if (std::holds_alternative<std::string*>(key.slot)) return "a string";
  if (std::holds_alternative<std::filesystem::path*>(key.slot)) return "a path";
  const bool pair = std::holds_alternative<std::optional<glm::vec2>*>(key.slot);
  const bool triple = std::holds_alternative<glm::vec3*>(key.slot) ||
                      std::holds_alternative<std::optional<glm::vec3>*>(key.slot);
  if (key.unit == "direction") return "a direction [x, y, z], not all zero";
  const bool whole =
      std::holds_alternative<int*>(key.slot) || std::holds_alternative<std::uint32_t*>(key.slot);
  std::string text = pair ? "[u, v], each " : triple ? "three numbers, each " : "";
  if (key.power_of_two) text += "a power of two, ";
  text += whole ? fmt::format("{:.0f} to {:.0f}", key.least, key.most)
                : fmt::format("{} to {}", key.least, key.most);
  if (!key.unit.empty()) text += fmt::format(" {}", key.unit);
  return text;
}

bool is_model_file(std::string_view model) {
  return model.find_first_of("/.") != std::string_view::npos;
}

const Key* find_key(const std::vector<Key>& keys, std::string_view name) {
  const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == name; });
  return key == keys.end() ? nullptr : &*key;
}

std::vector<std::string> choices_of(std::string_view name) {
  Scene scene;
  const std::vector<Key> keys = scene_keys(scene);
  if (const Key* key = find_key(keys, name)) return {key->choices.begin(), key->choices.end()};
  throw InputError(fmt::format("no scene key {}", name));
}

}  // namespace pelage
