// The scene: all parameters of a picture or a timing, each with a default. The help texts of the keys in
// scene_keys.cpp say what a value means, its unit and its range; the comments here say only what they do not.
// scene_toml.hpp declares the functions that read, check and write scenes; docs/glossary.md names the papers
// S, W and B and the unit R.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/scene/keyframes.hpp"
#include "harness/scene/spring_kinds.hpp"
#include "harness/scene/strands_scene.hpp"

namespace pelage {

/// Parameters of the fur's volume texture and of its placement on the surface. The texture has one slice of
/// texels per layer.
struct FurScene {
  float length = 0.09f;  ///< strand length L0, R
  int layers = 64;       ///< number of layers above the base surface (N)
  int texture = 256;     ///< number of texels per side of a slice
  float tile = 1.8f;     ///< number of repeats of the fur texture per length R on the surface
  int strands = 5000;    ///< number of guard hairs in one slice
  float radius = 1.2f;   ///< mean radius of guard hairs at the root, in texels of a 256 x 256 slice
  float width = 1.0f;    ///< ratio of a guard hair's width to its thickness; above 1 for blades of grass
  int undercoat = 4000;  ///< number of undercoat hairs in one slice
  float undercoat_length = 0.45f;  ///< greatest length of an undercoat hair, fraction of L0
  float least_length = 0.6f;       ///< length of the shortest guard hair, fraction of L0
  float taper = 1.6f;
  float tip_radius = 0.15f;  ///< radius of a hair at its tip, as a fraction of its radius at the root
  int locks = 700;           ///< number of locks of hair per slice; 0: no locks
  float lock_pull = 0.45f;
  float lock_power = 1.0f;
  float bend = 0.0f;  ///< sideways offset of the tip of a blade of grass, in texels of a 256 x 256 slice
  float bend_exponent = 2.5f;
  float bend_spread = 0.0f;  ///< greatest random deviation of a blade's c, as a fraction of `bend_exponent`
  float sweep = 0.18f;
  float shade = 0.28f;  ///< greatest deviation from 1 of a hair's shade, a random factor of its colour
  float comb = 0.6f;    ///< tangent of the angle by which strands tilt at rest; 0: upright
  float comb_noise = 0.0f;
  glm::vec3 comb_direction{0.0f, -1.0f, -0.25f};  ///< combing direction, projected onto the surface
  float lod_bias = -1.0f;  ///< value added to the mip level when the fur texture is sampled
  int substeps = 1;        ///< number of samples of the fur texture per fragment, 1 to 8
  float density = 1.0f;    ///< factor of the fur's coverage, 0..1
  std::string layer_correction = "texel";
  std::filesystem::path length_map, density_map, comb_map;
  std::uint32_t seed = 1;
  std::string layer_spacing = "paper";  ///< spacing of the layers at rest: "paper" (as in S) | "uniform"
  std::string binding = "shared";
  std::string uv = "computed";
};

struct CurlScene {
  float radius = 0.0f;  ///< K_alpha, R
  float turns = 0.0f;   ///< number of turns of the curl from root to tip; omega / (2 pi) in S Eq. 4
  float variation = 0.0f;
  std::string frame = "smooth";  ///< tangent frame of the curl: "smooth" | "uv" (gradient of the UV map)
  std::filesystem::path radius_map, turns_map;
};

/// A droplet on the surface. Exactly one of `uv` and `point` is given; `point`, in R, is moved to the nearest
/// surface point.
struct DropletScene {
  std::optional<glm::vec2> uv;
  std::optional<glm::vec3> point;
  float radius = 0.012f;  ///< r_drop, in the unit WetnessScene::unit
  float wetness = 0.9f;   ///< rho_drop, 0..1
  float time = 0.0f;      ///< time of arrival, s
};

struct WetnessScene {
  int size = 256;  ///< number of texels per side of the wetness mask
  /// Droplets that the scene lists. They are blended into the mask in this order, before the random droplets.
  std::vector<DropletScene> droplets;
  int random = 0;  ///< maximum number of random droplets
  std::uint32_t seed = 1;
  float radius = 0.012f;       ///< mean radius of random droplets, in the unit `unit`
  float radius_spread = 0.3f;  ///< greatest random deviation from `radius`, as a fraction of `radius`
  std::string unit = "uv";
  float wetness = 0.9f;         ///< mean wetness of random droplets
  float wetness_spread = 0.1f;  ///< greatest random deviation from `wetness`
  float spacing = 1.0f;         ///< least distance between random droplet centres, in radii of the later one
  float patch_cover = 1.0f;     ///< fraction of the surface on which random droplets may be placed
  float patch_size = 0.6f;
  std::string blend = "overlap";
  std::string seams = "joined";
  std::filesystem::path image;
  // The water over time (docs/shells.md, section 10). With the defaults, the water does not change.
  float rate = 0.0f;    ///< random droplets that arrive per second; 0: all of them arrive at `begin`
  float begin = 0.0f;   ///< arrival of the first random droplet, s
  float end = 3600.0f;  ///< random droplets that would arrive after this time do not arrive, s
  float soak = 0.0f;    ///< time in which a droplet soaks into the fur, s; 0: at once
  float drying = 0.0f;  ///< time constant of evaporation, s; 0: no evaporation
  float drip = 0.0f;    ///< wetness that a droplet loses per second because water drips off, 1/s
  std::string text;
  float text_u = 0.5f;              ///< u of the centre of the text
  float text_v = 0.5f;              ///< v of the centre of the text
  float text_height = 0.2f;         ///< height of the capital letter H, UV
  std::filesystem::path text_font;  ///< TrueType or OpenType file; empty: DejaVu Sans Bold
};

inline constexpr std::array clump_scales{"literal", "distance", "converge"};
inline constexpr std::array clump_functions{"logarithmic", "rate"};
inline constexpr std::array clump_cells{"separate", "literal", "consistent"};
inline constexpr std::array self_shadows{"darkening", "off", "traced"};
inline constexpr std::array tangent_readings{"paper", "drawn", "strand", "printed"};

struct ClumpScene {
  float shape = 0.0f;
  std::string function = "logarithmic";  ///< one of clump_functions
  float gain = 1.0f;
  std::string scale = "converge";    ///< one of clump_scales
  std::string cells = "consistent";  ///< rule for fragments at a clump's border, one of clump_cells
};

/// Returns g(h), the function that S Eq. 5 mixes with h: 1 + ln h / ln N, or min(3 h, 1) with the
/// clump.function "rate" (docs/shells.md, section 6). h is in (0, 1], and N is `layers`.
inline double clump_curve(std::string_view function, double h, int layers) {
  return function == "rate" ? std::min(3.0 * h, 1.0) : 1.0 + std::log(h) / std::log(double(layers));
}

/// Soaked fur, our extension of both papers (docs/shells.md, section 11).
struct SoakedScene {
  float threshold = 1;  ///< wetness from which on a film of water replaces the clumps; 1: nowhere
  float height = 0.5f;  ///< height of the film, as a fraction of the fur's length
  float gloss = 3;      ///< factor of the film's highlight
};

inline constexpr std::array face_orders{"all", "front", "back-then-front"};
inline constexpr std::array blend_orders{"layer", "depth"};

/// Which triangles of the layers are drawn, and in which order.
struct BlendScene {
  std::string faces = "back-then-front";  ///< one of face_orders; a triangle faces as its base does
  std::string order = "layer";            ///< one of blend_orders
};

inline bool by_depth(const BlendScene& blend) {
  return blend.order == "depth";
}

struct WindScene {
  glm::vec3 direction{1.0f, 0.0f, 0.0f};
  float strength = 0.0f;    ///< force on a strand's mass in N
  float gust = 0.0f;        ///< amplitude of the gusts, as a fraction of `strength`
  float frequency = 1.0f;   ///< frequency of the gusts in Hz
  float wavelength = 2.0f;  ///< distance between gusts along the wind's direction, R
  std::string gust_at = "stick";
};

/// Springs of the mass-spring topologies (docs/springs.md). Silva's strand does not use these values.
struct SpringsScene {
  float stiffness = 10;         ///< stiffness of the sticks in N/m, where the length 1 R is taken as 1 m
  float damping = 0.02f;        ///< damping coefficient along the sticks in N s/m
  float edge_stiffness = 2;     ///< stiffness of the springs between top masses in N/m
  float edge_damping = 0.004f;  ///< damping coefficient of the springs between top masses in N s/m
  float return_weight = 0.2f;   ///< w of B Eq. 5, N
  float residual = 1e-5f;       ///< relative residual |r| / |b| at which the conjugate-gradient solver stops
  std::string jacobian = "pruned";
  std::string vertices = "points";  ///< where sticks stand: "points" (surface points) | "copies" (vertices)
  float reference_area = 0;
};

/// Motion of the object. It causes inertial forces and air drag on the masses of a mass-spring topology. The
/// camera moves with the object.
struct MotionScene {
  glm::vec3 velocity{0.0f};          ///< R/s
  glm::vec3 shake{0.0f};             ///< amplitude of an oscillating translation in R
  float shake_frequency = 1.0f;      ///< frequency of the oscillating translation in Hz
  glm::vec3 axis{0.0f, 1.0f, 0.0f};  ///< axis of rotation through the origin
  float spin = 0.0f;                 ///< angular velocity of a steady rotation in rad/s
  float swing = 0.0f;                ///< amplitude of an oscillating rotation in rad
  float swing_frequency = 1.0f;      ///< frequency of the oscillating rotation in Hz
};

/// A local force on the top masses (the upper ends of the sticks) of all triangles whose centroid lies within
/// `radius` of the centre of the force. If `ray` is zero, the centre is `point`. Otherwise the centre is the
/// first intersection of the mesh with the ray from `point` in the direction `ray`, and the force always acts
/// on the intersected triangle.
struct PokeScene {
  glm::vec3 point{0.0f};  ///< centre of the force, or origin of the ray, in R
  glm::vec3 ray{0.0f};
  float radius = 0.0f;
  glm::vec3 force{0.0f};  ///< force on each top mass in newtons
  float spread = 0.0f;
  glm::vec3 along{0.0f, 0.0f, 1.0f};
};

struct DynamicsScene {
  std::string topology = "silva";  ///< "silva", "chains" or the name of a springs::Kind
  std::string solver{springs::default_solver.name};
  /// B Eq. 4: a layer at the height h (fraction of L0) lies at L0 (h n + h^k (s - n)) from the stick's base,
  /// where s is the direction of the stick and n is the surface normal.
  std::string bend = "paper";
  float bend_power = 2.0f;     ///< k of B Eq. 4
  float mass = 0.001f;         ///< mass at the tip of a strand or stick in kg
  float stiffness = 0.4f;      ///< k of Silva's strand in N/m, where the length 1 R is taken as 1 m
  float drag = 0.01f;          ///< c, the drag coefficient of a mass in N s/m
  float step = 1.0f / 240.0f;  ///< dt, duration of a substep in seconds
  int substeps = 4;            ///< number of substeps per frame
  float tolerance = 0.0f;
  float time = 0.0f;                    ///< simulated time before the first picture, in seconds
  glm::vec3 gravity{0.0f, 0.0f, 0.0f};  ///< R/s^2
  WindScene wind;
  SpringsScene springs;
  MotionScene motion;
  PokeScene poke;
};

/// True if the scene's motion is that of chains of two segments, which only single strands have.
inline bool has_chains(const DynamicsScene& dynamics) {
  return dynamics.topology == "chains";
}

/// True if a mass-spring topology moves the fur; false for Silva's model, which has one strand per triangle,
/// and for chains.
inline bool has_springs(const DynamicsScene& dynamics) {
  return dynamics.topology != DynamicsScene{}.topology && !has_chains(dynamics);
}

/// Number of frames that are simulated before the frame of the first picture: `time` divided by the duration
/// of a frame, rounded to the nearest integer.
inline int frames_before(const DynamicsScene& dynamics) {
  return static_cast<int>(dynamics.time / (dynamics.step * static_cast<float>(dynamics.substeps)) + 0.5f);
}

/// Returns the time of the picture that shows the state after `frames` frames, in s. The time of the first
/// picture, after one frame, is 0.
inline double picture_time(const DynamicsScene& dynamics, int frames) {
  const double frame = double(dynamics.step) * static_cast<double>(dynamics.substeps);
  return frames > 1 ? static_cast<double>(frames - 1) * frame : 0.0;
}

inline constexpr int most_mesh_frames = 10'000;  ///< greatest MeshScene::frames, ContactMeshScene::frames

// Colliders: bodies that push the layers of the fur down (docs/shells.md, section 9).

inline constexpr float longest_contact = 3600.0f;  ///< greatest time of a collider, s

/// The motion of a collider: it exists from `begin` to `end` and moves with a constant velocity. Its
/// positions in the scene are those at the time `begin`.
struct ContactMotion {
  glm::vec3 velocity{0.0f};     ///< R/s
  float begin = 0.0f;           ///< s
  float end = longest_contact;  ///< s
  /// Returns whether the collider exists at a time, s.
  bool exists(double time) const { return double(begin) <= time && time < double(end); }
  /// Returns the position at a time (s) of a point that is at `start` at the time `begin`.
  glm::dvec3 moved(const glm::vec3& start, double time) const {
    return glm::dvec3(start) + (time - double(begin)) * glm::dvec3(velocity);
  }
};

struct ContactSphereScene {
  glm::vec3 centre{0.0f, 1.2f, 0.0f};  ///< R
  float radius = 0.25f;                ///< R
  ContactMotion motion;
};

/// The points whose distance from the line segment from `from` to `to` is at most `radius`.
struct ContactCapsuleScene {
  glm::vec3 from{-0.5f, 1.2f, 0.0f}, to{0.5f, 1.2f, 0.0f};  ///< R
  float radius = 0.15f;                                     ///< R
  ContactMotion motion;
};

/// A closed mesh, scaled to a bounding sphere of radius 1 around the origin, then by `scale`, and moved to
/// `position`. Its surface is approximated by a signed distance field.
struct ContactMeshScene {
  std::filesystem::path file;            ///< mesh file; empty: none
  glm::vec3 position{0.0f, 1.2f, 0.0f};  ///< R
  float scale = 0.3f;                    ///< radius of the mesh's bounding sphere, R
  int cells = 48;                        ///< number of cells of the field along the longest side of the mesh
  glm::vec3 axis{0.0f, 1.0f, 0.0f};      ///< axis of rotation through `position`
  float spin = 0.0f;                     ///< angular velocity, rad/s
  int frames = 1;                        ///< number of mesh files
  std::string after_frames = "hold";     ///< as MeshScene::after_frames
  ContactMotion motion;
};

inline constexpr int most_colliders = 8;  ///< greatest number of spheres and capsules together

struct ContactScene {
  std::vector<ContactSphereScene> spheres;
  std::vector<ContactCapsuleScene> capsules;
  ContactMeshScene mesh;
};

inline bool has_contact(const ContactScene& contact) {
  return !contact.spheres.empty() || !contact.capsules.empty() || !contact.mesh.file.empty();
}

struct LightScene {
  glm::vec3 direction{0.25f, 1.0f, -0.4f};  ///< towards the light
  float intensity = 1.5f;
};

struct ShadingScene {
  std::string model = "curling";          ///< name of a shading model, see shading_models.cpp
  std::string self_shadow = "darkening";  ///< one of self_shadows
  float shadow = 1.12f;                   ///< K_shadow >= 1; a larger value gives a weaker self-shadow
  glm::vec3 specular{0.2f};               ///< K_s, the colour of the highlight
  float exponent = 24.0f;                 ///< p, the exponent of the highlight
  float ambient = 0.2f;
  float wrap = 0.75f;              ///< weight of the wrapped light (n.l + 0.4) / 1.4; 0: light as in S and W
  float occlusion = 0.85f;         ///< sigma_occ of W Eq. 5, the strength of the self-shadow
  float darkening = 0.3f;          ///< sigma_wet of W Eq. 5, the darkening by wetness
  float wet_specular = 0.5f;       ///< sigma_spec of W Eq. 3, the influence of wetness on the highlight, < 1
  std::string tangent = "strand";  ///< one of tangent_readings
  std::string sides = "one";       ///< sides of the surface that receive light: "one" (outside) | "two"
  std::vector<LightScene> lights{LightScene{}, LightScene{{0.35f, 0.3f, 0.9f}, 0.6f}};  ///< one or two lights
};

struct CoatScene {
  std::filesystem::path image;      ///< colour texture in UV space; empty: procedural coat
  std::string pattern = "patches";  ///< "plain" | "patches" | "stripes" | "spots" | "grass"
  glm::vec3 colour{0.86f, 0.70f, 0.50f};
  glm::vec3 second{0.62f, 0.44f, 0.27f};
  float scale = 0.5f;    ///< size of the pattern in R
  glm::vec3 skin{0.5f};  ///< the base surface has the coat's colour times this factor, per channel
  std::uint32_t seed = 1;
  int texture = 512;  ///< number of texels per side of a procedural coat
};

struct CameraScene {
  bool framed = true;                       ///< true: make_camera() places the camera
  glm::vec3 direction{1.3f, 1.15f, 2.35f};  ///< direction from the target to the eye
  glm::vec3 eye{1.3f, 1.15f, 2.35f};        ///< position of the camera in R; used if `framed` is false
  glm::vec3 target{0.0f};  ///< point in the centre of the picture, in R; used if `framed` is false
  glm::vec3 up{0.0f, 1.0f, 0.0f};
  float fov = 37.0f;   ///< vertical field of view in degrees
  float near = 0.01f;  ///< distance from the eye to the near plane, in R
};

struct ImageScene {
  int width = 800;
  int height = 600;
  glm::vec3 background{0.30f, 0.34f, 0.39f};
};

/// Options of mesh preparation.
struct MeshScene {
  std::string up = "y";            ///< the axis that points up in the mesh file: "y" | "z"
  glm::vec3 rotate{0.0f};          ///< rotation of the model about x, then y, then z, in degrees
  std::string components = "all";  ///< connected components of a mesh file that are kept: "all" | "largest"
  int frames = 1;
  std::string after_frames = "hold";  ///< "hold": the last frame stays | "repeat": the first frame follows
};

struct Scene {
  std::string model = "bunny";      ///< name of a model in models.toml, or path of a mesh file
  std::string pipeline = "shells";  ///< the pipeline that draws the scene, one of drawing_pipelines()
  MeshScene mesh;
  FurScene fur;
  CurlScene curl;
  WetnessScene wetness;
  ClumpScene clump;
  SoakedScene soaked;
  BlendScene blend;
  DynamicsScene dynamics;
  ContactScene contact;
  ShadingScene shading;
  CoatScene coat;
  StrandsScene strands;
  CameraScene camera;
  ImageScene image;
  Keyframes keyframes;
};

/// True if each triangle of a layer moves independently of its neighbours, so that gaps can open between
/// triangles.
inline bool parts(const Scene& scene) {
  return has_springs(scene.dynamics) ? scene.dynamics.topology.starts_with("separable")
                                     : scene.fur.binding == "separate";
}

}  // namespace pelage
