// One scene: everything a picture or a timing depends on. Lengths in R, the mesh's bounding-sphere radius.
// Values only; reading, describing and checking them is scene_toml's work. Defaults are complete.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/scene/spring_kinds.hpp"

namespace pelage {

/// The volume texture's recipe and how it is hung on the surface.
struct FurScene {
  float length = 0.09f;            ///< strand length L0, R
  int layers = 64;                 ///< N, layers above the base surface
  int texture = 256;               ///< texels per side of a slice
  float tile = 1.8f;               ///< repeats of the slice per R
  int strands = 5000;              ///< guard hairs in one slice
  float radius = 1.2f;             ///< their radius at the root, texels of a 256-texel slice
  float width = 1.0f;              ///< of a strand against its thickness, across its bend (grass: 2.4)
  int undercoat = 4000;            ///< undercoat hairs in one slice
  float undercoat_length = 0.45f;  ///< their greatest length, fraction of L0
  float least_length = 0.6f;       ///< shortest guard hair, fraction of L0
  float taper = 1.6f;              ///< taper exponent
  float tip_radius = 0.15f;        ///< radius at the tip, fraction of the root's
  int locks = 700;                 ///< locks per slice, 0 for none
  float lock_pull = 0.45f;         ///< how far a strand's tip moves to its lock's centre, 0..1
  float lock_power = 1.0f;         ///< exponent of h in that pull
  float bend = 0.0f;               ///< exponential bend of a blade at its tip, texels (grass: 18)
  float bend_exponent = 2.5f;      ///< c of that bend, (e^(c t) - 1) / (e^c - 1): how late a blade bends
  float bend_spread = 0.0f;        ///< variation of c from blade to blade, +- fraction
  float sweep = 0.18f;      ///< how obliquely strands are seen (tangent): widens them where layers are few
  float shade = 0.28f;      ///< variation of shade from strand to strand, +-
  float comb = 0.6f;        ///< tangential lean of the spring's rest tip, 0: the paper's upright fur
  float comb_noise = 0.0f;  ///< lean in random, smooth directions, added to comb
  glm::vec3 comb_direction{0.0f, -1.0f, -0.25f};  ///< where the comb points before it is made tangential
  float lod_bias = -1.0f;                         ///< added to the level of detail of the fur lookup
  int substeps = 1;                               ///< samples of a fragment within its layer, 1 to 8
  std::uint32_t seed = 1;
  std::string layer_spacing = "paper";  ///< "paper" | "uniform"
  std::string binding = "shared";       ///< "shared" | "separate"
  std::string uv = "computed";          ///< the mesh's UV map: "computed" | "file"
};

struct CurlScene {
  float radius = 0.0f;     ///< K_alpha, R
  float turns = 0.0f;      ///< omega / 2 pi, turns from root to tip
  float variation = 0.0f;  ///< turns by which the curl's phase varies over the body, +-; "smooth" frame only
  std::string frame = "smooth";  ///< "smooth" | "uv"
};

/// A droplet on the surface; exactly one of uv and point is given (point: nearest surface point, R).
struct DropletScene {
  std::optional<glm::vec2> uv;
  std::optional<glm::vec3> point;
  float radius = 0.012f;  ///< r_drop, UV units
  float wetness = 0.9f;   ///< rho_drop, 0..1
};

struct WetnessScene {
  int size = 256;                      ///< texels per side of the mask
  std::vector<DropletScene> droplets;  ///< explicit ones, blended first, in this order
  int random = 0;                      ///< most random droplets to place
  std::uint32_t seed = 1;
  float radius = 0.012f;        ///< mean radius of random droplets, UV units
  float radius_spread = 0.3f;   ///< +- fraction of radius
  float wetness = 0.9f;         ///< mean wetness of random droplets
  float wetness_spread = 0.1f;  ///< +-
  float spacing = 1.0f;         ///< least distance of random centres, in radii
  float patch_cover = 1.0f;     ///< fraction of the surface in which random droplets fall, 1: all
  float patch_size = 0.6f;      ///< size of those contiguous areas, R; wetness fades at their borders
  std::filesystem::path image;  ///< droplets fall only where this picture (in UV) is bright
};

struct ClumpScene {
  float shape = 0.0f;  ///< w of S Eq. 5: 0 straight, 1 logarithmic
  float gain = 3.5f;
  std::string scale = "relative";  ///< "relative" (gain) | "literal" (r_mask)
  std::string cells = "separate";  ///< "separate" | "literal"
};

struct WindScene {
  glm::vec3 direction{1.0f, 0.0f, 0.0f};
  float strength = 0.0f;    ///< N on a strand's mass
  float gust = 0.0f;        ///< fraction of strength
  float frequency = 1.0f;   ///< Hz
  float wavelength = 2.0f;  ///< R, of the gusts travelling along direction
};

/// Springs of the mass-spring topologies (docs/topology.md); Silva's strand has none of them.
struct SpringsScene {
  float stiffness = 10;         ///< of a stick along itself, N/m, with 1 R = 1 m
  float damping = 0.02f;        ///< of that, N s/m
  float edge_stiffness = 2;     ///< of the springs between the tops, N/m
  float edge_damping = 0.004f;  ///< of those, N s/m
  float return_weight = 0.2f;   ///< w of B Eq. 5, N
  float residual = 1e-5f;       ///< |r| / |b| at which backward Euler's conjugate gradients stop
};

/// The object's own motion, which the fur of a topology feels; the camera travels with it.
struct MotionScene {
  glm::vec3 velocity{0.0f};          ///< R/s
  glm::vec3 shake{0.0f};             ///< R, amplitude of a shake to and fro
  float shake_frequency = 1.0f;      ///< Hz
  glm::vec3 axis{0.0f, 1.0f, 0.0f};  ///< of its turn, through the origin
  float spin = 0.0f;                 ///< rad/s
  float swing = 0.0f;                ///< rad, amplitude of a turn to and fro
  float swing_frequency = 1.0f;      ///< Hz
};

/// A local force on the tops of every triangle whose centroid lies within `radius` of `point`; or, where
/// `ray` points somewhere, of the point where it meets the mesh first, and on that triangle in any case.
struct PokeScene {
  glm::vec3 point{0.0f};              ///< R; of a ray its origin
  glm::vec3 ray{0.0f};                ///< its direction; 0: none
  float radius = 0.0f;                ///< R; 0: no poke, or of a ray the one triangle
  glm::vec3 force{0.0f};              ///< N
  float spread = 0.0f;                ///< N, away from the line through the point along `along`
  glm::vec3 along{0.0f, 0.0f, 1.0f};  ///< what fur is parted along
};

struct DynamicsScene {
  std::string topology = "silva";                    ///< what moves the fur; scene_keys.cpp lists the names
  std::string solver{springs::default_solver.name};  ///< of a topology; Silva's strand knows this one only
  std::string bend = "paper";  ///< of a topology's layers: "linear" | "paper" | "tangent"
  float bend_power = 2.0f;     ///< k of B Eq. 4
  float mass = 0.001f;         ///< kg
  float stiffness = 0.4f;      ///< k of Silva's strand, N/m, with 1 R = 1 m
  float drag = 0.01f;          ///< c, N s/m
  float step = 1.0f / 240.0f;  ///< dt of a substep, s
  int substeps = 4;            ///< per frame
  float tolerance =
      0.0f;           ///< of a topology, fraction of the fur's length: more substeps where needed; 0: never
  float time = 0.0f;  ///< simulated before the first picture, s
  glm::vec3 gravity{0.0f, 0.0f, 0.0f};  ///< R/s^2
  WindScene wind;
  SpringsScene springs;
  MotionScene motion;
  PokeScene poke;
};

/// Whether a mass-spring topology moves the fur, rather than Silva's strand per triangle.
inline bool has_springs(const DynamicsScene& dynamics) {
  return dynamics.topology != DynamicsScene{}.topology;
}

/// Frames of strand motion that `time` stands for: they pass before the first picture's own frame.
inline int frames_before(const DynamicsScene& dynamics) {
  return static_cast<int>(dynamics.time / (dynamics.step * static_cast<float>(dynamics.substeps)) + 0.5f);
}

struct LightScene {
  glm::vec3 direction{0.25f, 1.0f, -0.4f};  ///< towards the light
  float intensity = 1.5f;
};

struct ShadingScene {
  std::string model = "curling";  ///< a name of shading_models.cpp
  float shadow = 1.12f;           ///< K_shadow >= 1
  glm::vec3 specular{0.2f};       ///< K_s
  float exponent = 24.0f;         ///< p
  float ambient = 0.2f;
  float wrap = 0.75f;             ///< weight of (n.l+.4)/1.4 on each light, 0: the literal equation
  float occlusion = 0.85f;        ///< sigma_occ
  float darkening = 0.3f;         ///< sigma_wet
  float wet_specular = 0.5f;      ///< sigma_spec, < 1
  std::string tangent = "paper";  ///< "paper" | "drawn"
  std::string sides = "one";      ///< "one" | "two": which sides of the surface receive light
  std::vector<LightScene> lights{LightScene{}, LightScene{{0.35f, 0.3f, 0.9f}, 0.6f}};  ///< one or two
};

struct CoatScene {
  std::filesystem::path image;      ///< colour texture in UV; empty: procedural
  std::string pattern = "patches";  ///< "plain" | "patches" | "stripes" | "spots" | "grass"
  glm::vec3 colour{0.86f, 0.70f, 0.50f};
  glm::vec3 second{0.62f, 0.44f, 0.27f};
  float scale = 0.5f;    ///< size of the pattern, R
  glm::vec3 skin{0.5f};  ///< colour of the base surface, times the coat's
  std::uint32_t seed = 1;
  int texture = 512;  ///< texels per side of a procedural coat
};

struct CameraScene {
  bool framed = true;  ///< true: placed on `direction`, the furred model filling 80-90% of the height
  glm::vec3 direction{1.3f, 1.15f, 2.35f};  ///< from the target to the eye
  glm::vec3 eye{1.3f, 1.15f, 2.35f};        ///< R, used when not framed
  glm::vec3 target{0.0f};                   ///< R
  glm::vec3 up{0.0f, 1.0f, 0.0f};
  float fov = 37.0f;   ///< vertical, degrees
  float near = 0.01f;  ///< near plane, R
};

struct ImageScene {
  int width = 800;
  int height = 600;
  glm::vec3 background{0.30f, 0.34f, 0.39f};
};

/// How the model's mesh is prepared.
struct MeshScene {
  glm::vec3 rotate{0.0f};          ///< degrees about x, then y, then z: files are upright in different ways
  std::string components = "all";  ///< of a file: "all" | "largest"
};

struct Scene {
  std::string model = "bunny";  ///< a name of models.toml, or a mesh file
  MeshScene mesh;
  FurScene fur;
  CurlScene curl;
  WetnessScene wetness;
  ClumpScene clump;
  DynamicsScene dynamics;
  ShadingScene shading;
  CoatScene coat;
  CameraScene camera;
  ImageScene image;
};

/// Whether every triangle's corners move by themselves, so that layers part between triangles.
inline bool parts(const Scene& scene) {
  return has_springs(scene.dynamics) ? scene.dynamics.topology.starts_with("separable")
                                     : scene.fur.binding == "separate";
}

}  // namespace pelage
