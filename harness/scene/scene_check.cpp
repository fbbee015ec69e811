// Checks single values of a scene and the consistency of all values.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

/// Greatest permitted number of fur texels, layers * texture^2. At 2 bytes per texel, this number of texels
/// needs 512 MiB.
constexpr long most_fur_texels = 1L << 28;
/// Greatest permitted number of pixels, width * height. At 4 floats per pixel, this number of pixels needs
/// 1 GiB.
constexpr long most_pixels = 1L << 26;
/// Greatest permitted number of frames that are simulated before the first picture.
constexpr long most_frames = 1000000;
constexpr std::size_t longest_wet_text = 80;  // characters of wetness.text

/// Returns true if a value is outside the range of its key. Floats are compared with the bounds in single
/// precision, because the float nearest to 0.99 is greater than the double 0.99.
bool outside(const Key& key, double value) {
  if (std::holds_alternative<int*>(key.slot) || std::holds_alternative<std::uint32_t*>(key.slot))
    return value < key.least || value > key.most;
  if (std::abs(value) > std::numeric_limits<float>::max()) return true;
  return static_cast<float>(value) < static_cast<float>(key.least) ||
         static_cast<float>(value) > static_cast<float>(key.most);
}

std::vector<double> numbers(const glm::vec2& v) {
  return {v.x, v.y};
}
std::vector<double> numbers(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}
template <class T>
requires std::is_arithmetic_v<T> std::vector<double> numbers(T value) {
  return {static_cast<double>(value)};
}

/// Returns the error text for the key's stored value; empty if the value is permitted.
std::string complaint_now(const Key& key) {
  return std::visit(
      [&](const auto* value) -> std::string {
        using T = std::remove_cvref_t<decltype(*value)>;
        if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::filesystem::path>) {
          return {};
        } else if constexpr (std::is_same_v<T, std::string>) {
          return complaint(key, *value);
        } else if constexpr (requires { value->has_value(); }) {
          return *value ? complaint(key, numbers(**value)) : std::string{};
        } else {
          return complaint(key, numbers(*value));
        }
      },
      key.slot);
}

void check_keys(const std::vector<Key>& keys, const std::string& source, const std::string& prefix) {
  for (const Key& key : keys) {
    if (const std::string wrong = complaint_now(key); !wrong.empty())
      throw InputError(fmt::format("{}: {}{}: {}", source, prefix, key.name, wrong));
  }
}

void check_list(const KeyList& list, const std::string& source) {
  const std::size_t size = list.size();
  if (size < list.least || size > list.most) {
    const std::string range = list.least == 0 ? fmt::format("at most {}", list.most)
                                              : fmt::format("{} to {}", list.least, list.most);
    throw InputError(fmt::format("{}: {}: {} {}; give {}", source, list.name, size, list.entry, range));
  }
  for (std::size_t i = 0; i < size; ++i)
    check_keys(list.keys(i), source, fmt::format("{}[{}].", list.name, i + 1));
}

void check_soaked(const Scene& scene, const std::string& source) {
  if (scene.soaked.threshold >= 1.0f) return;
  if (scene.shading.model != "wet" || scene.clump.cells != "consistent")
    throw InputError(fmt::format(
        "{}: soaked.threshold = {} needs shading.model = \"wet\" and clump.cells = \"consistent\"", source,
        scene.soaked.threshold));
}

void check_droplets(const WetnessScene& wetness, const std::string& source) {
  for (std::size_t i = 0; i < wetness.droplets.size(); ++i) {
    const DropletScene& droplet = wetness.droplets[i];
    if (droplet.uv.has_value() == droplet.point.has_value()) {
      throw InputError(fmt::format("{}: {}[{}]: gives {} of the keys uv and point; give exactly one", source,
                                   droplet_list, i + 1, droplet.uv ? "both" : "none"));
    }
  }
}

/// Throws InputError for times of the rain (docs/shells.md, section 10) that contradict each other.
void check_rain(const WetnessScene& wetness, const std::string& source) {
  if (wetness.end < wetness.begin)
    throw InputError(fmt::format("{}: wetness.end: {} s is before wetness.begin ({} s); give {} s or more",
                                 source, wetness.end, wetness.begin, wetness.begin));
  if (wetness.rate > 0 && wetness.random == 0)
    throw InputError(fmt::format(
        "{}: wetness.rate: there are no random droplets that can arrive; give wetness.random above 0",
        source));
}

/// Throws InputError if wetness.text cannot be painted, or if no droplets can be placed in it.
void check_text(const WetnessScene& wetness, const std::string& source) {
  if (wetness.text.empty()) return;
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: wetness.text: {}", source, what));
  };
  for (std::size_t i = 0; i < wetness.text.size(); ++i)
    if (wetness.text[i] < ' ' || wetness.text[i] > '~')
      refuse(fmt::format(
          "byte {} is not a printable ASCII character; give letters, digits and signs of ASCII", i + 1));
  if (wetness.text.find_first_not_of(' ') == std::string::npos)
    refuse("has no visible character; give a text, or \"\" for none");
  if (wetness.text.size() > longest_wet_text)
    refuse(fmt::format("has {} characters; give at most {}", wetness.text.size(), longest_wet_text));
  if (wetness.random == 0) refuse("has no effect without random droplets; give wetness.random above 0");
}

/// Throws InputError if a collider ends before it begins, or if there are too many colliders.
void check_contact(const ContactScene& contact, const std::string& source) {
  const auto check_times = [&](const std::string& key, const ContactMotion& motion) {
    if (!(motion.begin < motion.end))
      throw InputError(fmt::format("{}: {}: {} s is not after the beginning, {} s; give a later time", source,
                                   key, motion.end, motion.begin));
  };
  for (std::size_t i = 0; i < contact.spheres.size(); ++i)
    check_times(fmt::format("{}[{}].end", contact_sphere_list, i + 1), contact.spheres[i].motion);
  for (std::size_t i = 0; i < contact.capsules.size(); ++i)
    check_times(fmt::format("{}[{}].end", contact_capsule_list, i + 1), contact.capsules[i].motion);
  check_times("contact.mesh_end", contact.mesh.motion);
  if (contact.mesh.file.empty())
    for (const auto& [key, given] : {std::pair("contact.mesh_spin", contact.mesh.spin != 0),
                                     {"contact.mesh_frames", contact.mesh.frames != 1}})
      if (given) throw InputError(fmt::format("{}: {}: there is no mesh; give contact.mesh", source, key));
  const std::size_t count = contact.spheres.size() + contact.capsules.size();
  if (count > most_colliders)
    throw InputError(fmt::format("{}: {}: {} spheres and capsules; give at most {} together", source,
                                 contact_capsule_list, count, most_colliders));
}

/// Throws InputError if the keys of strands of a file contradict each other.
void check_groom(const Scene& scene, const std::string& source) {
  const StrandsScene& s = scene.strands;
  const auto refuse = [&](const std::string& what) { throw InputError(fmt::format("{}: {}", source, what)); };
  if (s.groom != "file") {
    if (!s.file.empty()) refuse("strands.file: needs strands.groom = \"file\"");
    if (scene.model == no_model) refuse("model: \"none\" needs strands.groom = \"file\"");
    return;
  }
  if (s.file.empty()) refuse("strands.groom: \"file\" needs a file with strands; give strands.file");
  if (s.layers.size() != 1)
    refuse(fmt::format("strands.layer: {} fur layers; strands of a file are one fur layer", s.layers.size()));
  if (scene.mesh.frames != 1)
    refuse("mesh.frames: strands of a file do not follow a mesh that deforms; give 1");
  if (scene.model != no_model) return;
  if (s.file_unit != "R") refuse("strands.file_unit: \"mesh\" needs a mesh file as the model");
  if (s.chain.collision == "body") refuse("strands.chain.collision: \"body\" needs a mesh as the model");
}

/// Throws InputError for a key that only Silva's strands support.
void check_strands_only(const Scene& scene, const std::string& source) {
  const auto refuse = [&](std::string_view key) {
    throw InputError(fmt::format("{}: {}: not supported by dynamics.topology \"{}\"; give \"silva\"", source,
                                 key, scene.dynamics.topology));
  };
  if (!scene.fur.length_map.empty()) refuse("fur.length_map");
  if (!scene.fur.comb_map.empty()) refuse("fur.comb_map");
}

/// Throws InputError if the scene has colliders that its dynamics cannot push.
void check_pushed(const Scene& scene, const std::string& source) {
  if (!has_contact(scene.contact)) return;
  const DynamicsScene& d = scene.dynamics;
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: contact: {}", source, what));
  };
  if (!has_springs(d)) return;
  const MotionScene& m = d.motion;
  if (m.velocity != glm::vec3(0) || m.shake != glm::vec3(0) || m.spin != 0 || m.swing != 0)
    refuse("colliders need an object that stays; leave out dynamics.motion");
  if (scene.mesh.frames > 1)
    refuse("colliders push sticks only on a mesh that does not deform; give mesh.frames = 1");
  if (d.tolerance != 0) refuse("colliders need steps of equal length; give dynamics.tolerance = 0");
  if (!springs::solver_of(d.solver).newton)
    refuse(fmt::format("colliders do not push the sticks of the solver {}; give another dynamics.solver",
                       d.solver));
}

/// Throws InputError for a key that the scene's dynamics.topology does not support. The function does
/// not check dynamics.step for a mass-spring topology, because the stability of a step depends on the mesh.
/// The kernels detect masses that diverge.
void check_topology(const Scene& scene, const std::string& source) {
  const DynamicsScene& d = scene.dynamics;
  const auto refuse = [&](const char* key, const std::string& what) {
    throw InputError(fmt::format("{}: {}: {}", source, key, what));
  };
  if (has_springs(d)) {
    if (scene.fur.binding != "shared")
      refuse("fur.binding", fmt::format("must be \"shared\" if dynamics.topology is \"{}\"", d.topology));
    if (d.wind.strength > 0 && !(d.drag > 0))
      refuse("dynamics.wind.strength",
             "with a mass-spring topology, the wind has no effect without drag; give dynamics.drag above 0");
    if (!springs::solver_of(d.solver).newton && springs::kind_of(d.topology).edges)
      refuse(
          "dynamics.solver",
          fmt::format("\"{}\" has no springs between tops; give dynamics.topology sticks or separable-sticks",
                      d.solver));
    if (!springs::solver_of(d.solver).newton && !(d.springs.return_weight > 0))
      refuse("dynamics.springs.return_weight", fmt::format("must be above 0 for the solver {}", d.solver));
    if (d.bend == "trigonometric" && (scene.shading.model != "lambert" || scene.fur.substeps != 1))
      refuse("dynamics.bend", "\"trigonometric\" needs shading.model = \"lambert\" and fur.substeps = 1");
    if (d.bend == "trigonometric" && scene.shading.self_shadow == "traced")
      refuse("dynamics.bend", "\"trigonometric\" needs shading.self_shadow \"darkening\" or \"off\"");
    return;
  }
  if (has_chains(d)) {
    if (d.wind.strength > 0 && !(scene.strands.chain.drag > 0))
      refuse("dynamics.wind.strength",
             "the wind has no effect on strands without drag; give strands.chain.drag above 0");
    return;
  }
  const std::string alone =
      "not supported by dynamics.topology \"silva\"; give another topology such as \"sticks\"";
  if (d.solver != DynamicsScene{}.solver) refuse("dynamics.solver", alone);
  if (d.tolerance != 0) refuse("dynamics.tolerance", alone);
  if (d.motion.velocity != glm::vec3(0)) refuse("dynamics.motion.velocity", alone);
  if (d.motion.shake != glm::vec3(0)) refuse("dynamics.motion.shake", alone);
  if (d.motion.spin != 0) refuse("dynamics.motion.spin", alone);
  if (d.motion.swing != 0) refuse("dynamics.motion.swing", alone);
  if (d.poke.radius != 0) refuse("dynamics.poke.radius", alone);
  if (d.poke.ray != glm::vec3(0)) refuse("dynamics.poke.ray", alone);
}

/// Throws InputError if the step dt is unstable for Silva's strand. Semi-implicit Euler on a damped spring is
/// stable if 2 dt c/m + dt^2 k/m < 4 (Jury's criterion for the 2 x 2 matrix of a step).
void check_step(const DynamicsScene& dynamics, const std::string& source) {
  const double m = dynamics.mass, k = dynamics.stiffness, c = dynamics.drag, dt = dynamics.step;
  if (2 * dt * c / m + dt * dt * k / m < 4) return;
  const double longest = (std::sqrt(c * c + 4 * k * m) - c) / k;
  throw InputError(fmt::format(
      "{}: dynamics.step: {} s is unstable with this mass, stiffness and drag; give less than {:.3g} s",
      source, dynamics.step, longest));
}

void check_time(const DynamicsScene& dynamics, const std::string& source) {
  const double frames = double(dynamics.time) / (double(dynamics.step) * dynamics.substeps);
  if (frames <= double(most_frames)) return;
  throw InputError(fmt::format("{}: dynamics.time: {} s are {:.0f} frames; give at most {} frames", source,
                               dynamics.time, frames, most_frames));
}

void check_camera(const CameraScene& camera, const std::string& source) {
  const glm::dvec3 view =
      camera.framed ? glm::dvec3(camera.direction) : glm::dvec3(camera.eye) - glm::dvec3(camera.target);
  if (!(glm::length(view) > 1e-6))
    throw InputError(fmt::format("{}: camera.eye: equals camera.target; give two different points", source));
  if (!(glm::length(glm::cross(glm::normalize(view), glm::normalize(glm::dvec3(camera.up)))) > 1e-4))
    throw InputError(fmt::format("{}: camera.up: is parallel to the view; give another direction", source));
}

void check_sizes(const Scene& scene, const std::string& source) {
  const double texels = double(scene.fur.layers) * scene.fur.texture * scene.fur.texture;
  if (texels > double(most_fur_texels)) {
    throw InputError(fmt::format(
        "{}: fur.layers: {} layers of {} x {} texels have {:.0f} texels in total; the limit is {} texels",
        source, scene.fur.layers, scene.fur.texture, scene.fur.texture, texels, most_fur_texels));
  }
  const double pixels = double(scene.image.width) * scene.image.height;
  if (pixels > double(most_pixels)) {
    throw InputError(fmt::format("{}: image.width: {} x {} are {:.0f} pixels; give at most {}", source,
                                 scene.image.width, scene.image.height, pixels, most_pixels));
  }
  if (scene.fur.strands + scene.fur.undercoat < 1) {
    throw InputError(fmt::format(
        "{}: fur.strands: the fur has neither guard hairs nor undercoat; give fur.strands or fur.undercoat above 0",
        source));
  }
}

}  // namespace

std::string complaint(const Key& key, const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) {
    if (!std::isfinite(value))
      return fmt::format("{} is not a finite number; give {}", value, describe_range(key));
    if (outside(key, value)) return fmt::format("{} is out of range; give {}", value, describe_range(key));
    if (key.power_of_two && !std::has_single_bit(static_cast<unsigned>(value)))
      return fmt::format("{} is not a power of two; give {}", value, describe_range(key));
    largest = std::max(largest, std::abs(value));
  }
  if (key.unit == "direction" && largest < 1e-6)
    return fmt::format("points nowhere; give {}", describe_range(key));
  return {};
}

std::string complaint(const Key& key, const std::string& value) {
  if (key.choices.empty())
    return value.empty() && !key.may_be_empty ? fmt::format("is empty; give {}", key.help) : std::string{};
  if (std::find(key.choices.begin(), key.choices.end(), value) != key.choices.end()) return {};
  return fmt::format("\"{}\" is not known; give {}", value, describe_range(key));
}

void check_scene(const Scene& scene, const std::string& source) {
  Scene copy = scene;
  check_keys(scene_keys(copy), source, "");
  for (const KeyList& list : scene_lists(copy)) check_list(list, source);
  check_droplets(scene.wetness, source);
  check_soaked(scene, source);
  check_rain(scene.wetness, source);
  check_text(scene.wetness, source);
  check_sizes(scene, source);
  check_topology(scene, source);
  check_contact(scene.contact, source);
  check_groom(scene, source);
  check_pushed(scene, source);
  if (has_springs(scene.dynamics) || has_chains(scene.dynamics)) check_strands_only(scene, source);
  if (!has_springs(scene.dynamics) && !has_chains(scene.dynamics)) check_step(scene.dynamics, source);
  check_time(scene.dynamics, source);
  check_camera(scene.camera, source);
  check_keyframes(scene, source);
}

}  // namespace pelage
