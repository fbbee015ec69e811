#include "harness/scene/scene_keys.hpp"

#include <fmt/format.h>

#include "harness/error.hpp"
#include "harness/scene/shading_models.hpp"
#include "harness/scene/spring_kinds.hpp"

namespace pelage {
namespace {

constexpr double most_seed = 4294967295.0;

std::vector<std::string_view> shading_names() {
  std::vector<std::string_view> names;
  for (const ShadingModel& model : shading_models()) names.push_back(model.name);
  return names;
}

/// Silva's strands and the spring topologies.
std::vector<std::string_view> topology_names() {
  std::vector<std::string_view> names = springs::kind_names();
  names.insert(names.begin(), "silva");
  return names;
}

}  // namespace

// clang-format off
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
  return {
      {.name = "model", .slot = &s.model, .unit = "", .help = "a name of experiments/models.toml, or a mesh file"},

      {"mesh.rotate", &mesh.rotate, "degrees", -360, 360, "turns the model about x, then y, then z, the axes being fixed; y is up, so [-90, 0, 0] stands a file up whose z is up"},
      {.name = "mesh.components", .slot = &mesh.components, .unit = "", .help = "of a file: each of its components gets a chart, except open scraps; or only the one of most faces is kept", .choices = {"all", "largest"}},

      {"fur.length", &fur.length, "R", 0.001, 1, "strand length L0"},
      {"fur.layers", &fur.layers, "", 2, 512, "N, layers above the base surface"},
      {.name = "fur.texture", .slot = &fur.texture, .unit = "texels", .least = 16, .most = 1024, .help = "side of a slice of the fur volume", .power_of_two = true},
      {"fur.tile", &fur.tile, "per R", 0.01, 100, "repeats of the slice"},
      {"fur.strands", &fur.strands, "", 0, 200000, "guard hairs in one slice"},
      {"fur.radius", &fur.radius, "texels of a 256-texel slice", 0.1, 32, "radius of a guard hair at the root"},
      {"fur.width", &fur.width, "of its thickness", 1, 16, "width of a strand across its bend: blades of grass"},
      {"fur.undercoat", &fur.undercoat, "", 0, 200000, "undercoat hairs in one slice"},
      {"fur.undercoat_length", &fur.undercoat_length, "of L0", 0, 1, "greatest length of an undercoat hair"},
      {"fur.least_length", &fur.least_length, "of L0", 0, 1, "length of the shortest guard hair"},
      {"fur.taper", &fur.taper, "", 0.01, 16, "taper exponent"},
      {"fur.tip_radius", &fur.tip_radius, "of the root's", 0, 1, "radius at the tip"},
      {"fur.locks", &fur.locks, "", 0, 100000, "locks of hair in one slice; 0: none"},
      {"fur.lock_pull", &fur.lock_pull, "", 0, 1, "how far a tip moves to its lock's centre"},
      {"fur.lock_power", &fur.lock_power, "", 0.01, 16, "exponent of the height in that pull"},
      {"fur.bend", &fur.bend, "texels of a 256-texel slice", 0, 256, "exponential bend of a blade at its tip"},
      {"fur.bend_exponent", &fur.bend_exponent, "", 0.01, 16, "c of that bend, (e^(c t) - 1) / (e^c - 1) at the share t of a blade: how late it bends"},
      {"fur.bend_spread", &fur.bend_spread, "of the exponent", 0, 0.99, "its variation from blade to blade, +-"},
      {"fur.sweep", &fur.sweep, "tangent of an angle", 0, 4, "how obliquely strands are seen: widens them where layers are few, so that 16 and 64 look alike"},
      {"fur.shade", &fur.shade, "", 0, 1, "variation of shade from strand to strand, +-"},
      {"fur.comb", &fur.comb, "", 0, 10, "tangential lean of the rest tip; 0: upright, as in the paper"},
      {"fur.comb_noise", &fur.comb_noise, "", 0, 10, "lean in random, smooth directions, added to comb"},
      {"fur.comb_direction", &fur.comb_direction, "direction", -1e6, 1e6, "where the comb points, before it is made tangential"},
      {"fur.lod_bias", &fur.lod_bias, "mip levels", -16, 16, "added to the level of detail of the fur lookup"},
      {.name = "fur.substeps", .slot = &fur.substeps, .unit = "", .least = 1, .most = 8, .help = "samples of a fragment along the ray within its layer: few layers of curls look like many; 1: the paper's", .power_of_two = true},
      {"fur.seed", &fur.seed, "", 0, most_seed, "seed of the fur volume"},
      {.name = "fur.layer_spacing", .slot = &fur.layer_spacing, .unit = "", .help = "rest heights of the layers along the strand", .choices = {"paper", "uniform"}},
      {.name = "fur.binding", .slot = &fur.binding, .unit = "", .help = "a vertex moves with the mean of its triangles' strands, or each triangle with its own", .choices = {"shared", "separate"}},
      {.name = "fur.uv", .slot = &fur.uv, .unit = "", .help = "the UV map in which fur, coat and wetness lie: made by pelage, or the one of the mesh file", .choices = {"computed", "file"}},

      {"curl.radius", &curl.radius, "R", 0, 1, "K_alpha of S Eq. 4, radius of the curl"},
      {"curl.turns", &curl.turns, "", -64, 64, "turns from root to tip, omega / 2 pi"},
      {"curl.variation", &curl.variation, "turns", 0, 8, "variation of the curl's phase over the body, +-; with the smooth frame only"},
      {.name = "curl.frame", .slot = &curl.frame, .unit = "", .help = "tangent frame: a smoothed field, or the raw UV gradient", .choices = {"smooth", "uv"}},

      {"wetness.size", &wetness.size, "texels", 8, 4096, "side of the wetness mask"},
      {"wetness.random", &wetness.random, "", 0, 100000, "most random droplets to place"},
      {"wetness.seed", &wetness.seed, "", 0, most_seed, "seed of the random droplets"},
      {"wetness.radius", &wetness.radius, "UV units", 0.0001, 1, "mean radius of random droplets"},
      {"wetness.radius_spread", &wetness.radius_spread, "of the radius", 0, 0.99, "variation of the radius, +-"},
      {"wetness.wetness", &wetness.wetness, "", 0, 1, "mean wetness of random droplets"},
      {"wetness.wetness_spread", &wetness.wetness_spread, "", 0, 1, "variation of the wetness, +-"},
      {"wetness.spacing", &wetness.spacing, "radii", 0, 100, "least distance of the centres of random droplets"},
      {"wetness.patch_cover", &wetness.patch_cover, "", 0, 1, "fraction of the surface in which random droplets fall; 1: all"},
      {"wetness.patch_size", &wetness.patch_size, "R", 0.01, 10, "size of those areas; wetness fades at their borders"},
      {.name = "wetness.image", .slot = &wetness.image, .unit = "", .help = "droplets fall only where this picture (in UV) is bright; \"\": anywhere"},

      {"clump.shape", &clump.shape, "", 0, 1, "w of S Eq. 5: 0 straight, 1 logarithmic"},
      {"clump.gain", &clump.gain, "", 0, 100, "displacement in place of the literal factor r"},
      {.name = "clump.scale", .slot = &clump.scale, .unit = "", .help = "factor of the displacement: gain, or the literal r_mask", .choices = {"relative", "literal"}},
      {.name = "clump.cells", .slot = &clump.cells, .unit = "", .help = "a clump also ends where its neighbour begins, or as Algorithm 2 is printed", .choices = {"separate", "literal"}},

      {.name = "dynamics.topology", .slot = &dynamics.topology, .unit = "", .help = "what moves the fur: Silva's strand per triangle, or the masses and springs of docs/topology.md", .choices = topology_names()},
      {.name = "dynamics.solver", .slot = &dynamics.solver, .unit = "", .help = "of a topology; silva knows semi-implicit Euler only", .choices = springs::solver_names()},
      {.name = "dynamics.bend", .slot = &dynamics.bend, .unit = "", .help = "of a topology's layers: along the stick, as B Eq. 4 is printed, or its tangential part only", .choices = {"linear", "paper", "tangent"}},
      {"dynamics.bend_power", &dynamics.bend_power, "", 1, 16, "k of B Eq. 4"},
      {"dynamics.mass", &dynamics.mass, "kg", 1e-9, 1000, "m, the mass at a strand's tip"},
      {"dynamics.stiffness", &dynamics.stiffness, "N/m, with 1 R = 1 m", 1e-6, 1e6, "k of the spring of silva's strand"},
      {"dynamics.drag", &dynamics.drag, "N s/m", 0, 1e6, "c"},
      {"dynamics.step", &dynamics.step, "s", 1e-6, 1, "dt of a substep"},
      {"dynamics.substeps", &dynamics.substeps, "", 1, 1000, "substeps per frame"},
      {"dynamics.tolerance", &dynamics.tolerance, "of the fur's length", 0, 1, "of a topology: as many substeps a frame as keep 99 tops in 100 so near to where twice as many bring them; 0: always `substeps`"},
      {"dynamics.time", &dynamics.time, "s", 0, 3600, "simulated before the first picture"},
      {"dynamics.gravity", &dynamics.gravity, "R/s^2", -1000, 1000, "acceleration of every mass"},
      {"dynamics.wind.direction", &wind.direction, "direction", -1e6, 1e6, "where the wind blows to"},
      {"dynamics.wind.strength", &wind.strength, "N", 0, 1000, "force on a strand's mass"},
      {"dynamics.wind.gust", &wind.gust, "of the strength", 0, 100, "amplitude of the gusts"},
      {"dynamics.wind.frequency", &wind.frequency, "Hz", 0, 1000, "of the gusts"},
      {"dynamics.wind.wavelength", &wind.wavelength, "R", 0.001, 1000, "of the gusts, which travel along the wind"},
      {"dynamics.springs.stiffness", &springs.stiffness, "N/m, with 1 R = 1 m", 0, 1e6, "k of a topology's sticks, along themselves"},
      {"dynamics.springs.damping", &springs.damping, "N s/m", 0, 1e6, "of those"},
      {"dynamics.springs.edge_stiffness", &springs.edge_stiffness, "N/m", 0, 1e6, "k of the springs between a topology's tops"},
      {"dynamics.springs.edge_damping", &springs.edge_damping, "N s/m", 0, 1e6, "of those"},
      {"dynamics.springs.return_weight", &springs.return_weight, "N", 0, 1e6, "w of B Eq. 5; 0: nothing returns"},
      {"dynamics.springs.residual", &springs.residual, "of the right-hand side", 1e-7, 0.1, "at which backward Euler's conjugate gradients stop"},
      {"dynamics.motion.velocity", &motion.velocity, "R/s", -1000, 1000, "of the object; fur on a topology feels it, the camera travels along"},
      {"dynamics.motion.shake", &motion.shake, "R", -10, 10, "amplitude of its shake to and fro"},
      {"dynamics.motion.shake_frequency", &motion.shake_frequency, "Hz", 0, 1000, "of the shake"},
      {"dynamics.motion.axis", &motion.axis, "direction", -1e6, 1e6, "of its turn, through the origin"},
      {"dynamics.motion.spin", &motion.spin, "rad/s", -1000, 1000, "steady turn"},
      {"dynamics.motion.swing", &motion.swing, "rad", -100, 100, "amplitude of a turn to and fro"},
      {"dynamics.motion.swing_frequency", &motion.swing_frequency, "Hz", 0, 1000, "of the swing"},
      {"dynamics.poke.point", &poke.point, "R", -1e6, 1e6, "centre of a local force on a topology's tops; of a ray its origin"},
      {"dynamics.poke.ray", &poke.ray, "of any length", -1e6, 1e6, "of a ray: where it meets the mesh first is the centre, and that triangle is poked in any case; 0: none"},
      {"dynamics.poke.radius", &poke.radius, "R", 0, 1e6, "triangles whose centroid is so near are poked; 0: none, or the ray's"},
      {"dynamics.poke.force", &poke.force, "N", -1000, 1000, "on each of their tops"},
      {"dynamics.poke.spread", &poke.spread, "N", -1000, 1000, "on each, away from the line through the point along `along`: parts the fur"},
      {"dynamics.poke.along", &poke.along, "direction", -1e6, 1e6, "of that line"},

      {.name = "shading.model", .slot = &shading.model, .unit = "", .help = "S Eq. 6, W Eq. 2-5, or Banisch and Wuethrich's: surface colour, self-shadow and Lambert's law", .choices = shading_names()},
      {"shading.shadow", &shading.shadow, "", 1, 1000, "K_shadow, self-shadow of the curling model"},
      {"shading.specular", &shading.specular, "", 0, 100, "K_s, colour of the highlight"},
      {"shading.exponent", &shading.exponent, "", 0, 10000, "p of the highlight"},
      {"shading.ambient", &shading.ambient, "", 0, 100, "light from everywhere"},
      {"shading.wrap", &shading.wrap, "", 0, 1, "weight of (n.l + 0.4)/1.4 on each light; 0: the literal equation"},
      {"shading.occlusion", &shading.occlusion, "", 0, 1, "sigma_occ of the wet model; of lambert how much the skin is darkened"},
      {"shading.darkening", &shading.darkening, "", 0, 1, "sigma_wet of the wet model"},
      {"shading.wet_specular", &shading.wet_specular, "", 0, 0.99, "sigma_spec of the wet model, below 1"},
      {.name = "shading.tangent", .slot = &shading.tangent, .unit = "", .help = "sign of the clump's lean in W Eq. 4: as printed, or as drawn", .choices = {"paper", "drawn"}},
      {.name = "shading.sides", .slot = &shading.sides, .unit = "", .help = "sides of the surface that receive light; two: for open meshes that are seen from behind", .choices = {"one", "two"}},

      {.name = "coat.image", .slot = &coat.image, .unit = "", .help = "colour texture in UV; \"\": procedural"},
      {.name = "coat.pattern", .slot = &coat.pattern, .unit = "", .help = "of a procedural coat", .choices = {"plain", "patches", "stripes", "spots", "grass"}},
      {"coat.colour", &coat.colour, "RGB", 0, 1, "main colour"},
      {"coat.second", &coat.second, "RGB", 0, 1, "colour of the pattern"},
      {"coat.scale", &coat.scale, "R", 0.001, 100, "size of the pattern"},
      {"coat.skin", &coat.skin, "RGB", 0, 1, "colour of the base surface, times the coat's"},
      {"coat.seed", &coat.seed, "", 0, most_seed, "seed of the pattern"},
      {"coat.texture", &coat.texture, "texels", 1, 4096, "side of a procedural coat"},

      {.name = "camera.framed", .slot = &camera.framed, .unit = "", .help = "true: placed along `direction` so that the model fills 80 to 90% of the picture's height"},
      {"camera.direction", &camera.direction, "direction", -1e6, 1e6, "from the target to the eye"},
      {"camera.eye", &camera.eye, "R", -1e6, 1e6, "where the camera stands when not framed"},
      {"camera.target", &camera.target, "R", -1e6, 1e6, "where it looks when not framed"},
      {"camera.up", &camera.up, "direction", -1e6, 1e6, "up in the picture"},
      {"camera.fov", &camera.fov, "degrees", 1, 170, "vertical field of view"},
      {"camera.near", &camera.near, "R", 0.0001, 10, "near plane"},

      {"image.width", &image.width, "pixels", 1, 16384, "width of the picture"},
      {"image.height", &image.height, "pixels", 1, 16384, "height of the picture"},
      {"image.background", &image.background, "RGB", 0, 1, "colour behind the model"},
  };
}

std::vector<Key> droplet_keys(DropletScene& droplet) {
  return {
      {"uv", &droplet.uv, "UV units", -1e6, 1e6, "centre in the texture; either this or point"},
      {"point", &droplet.point, "R", -1e6, 1e6, "centre in space, moved to the nearest surface point"},
      {"radius", &droplet.radius, "UV units", 0.0001, 1, "r_drop"},
      {"wetness", &droplet.wetness, "", 0, 1, "rho_drop"},
  };
}

std::vector<Key> light_keys(LightScene& light) {
  return {
      {"direction", &light.direction, "direction", -1e6, 1e6, "towards the light"},
      {"intensity", &light.intensity, "", 0, 1000, "brightness"},
  };
}
// clang-format on

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

std::vector<std::string> choices_of(std::string_view name) {
  Scene scene;
  for (const Key& key : scene_keys(scene))
    if (key.name == name) return {key.choices.begin(), key.choices.end()};
  throw InputError(fmt::format("no scene key {}", name));
}

}  // namespace pelage
