// The scene: all parameters of a picture or a timing, each with a default. Lengths are in R, the radius of
// the mesh's bounding sphere. scene_toml.hpp declares the functions that read, check and write scenes.
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

/// Parameters of the fur's volume texture and of its placement on the surface. The texture has one slice of
/// texels per layer.
struct FurScene {
  float length = 0.09f;  ///< strand length L0, R
  int layers = 64;       ///< N, number of layers above the base surface
  int texture = 256;     ///< number of texels per side of a slice
  float tile = 1.8f;     ///< repeats of the fur texture per R of surface
  int strands = 5000;    ///< number of guard hairs in one slice
  float radius = 1.2f;   ///< mean radius of guard hairs at the root, texels of a slice of 256 x 256 texels
  float width = 1.0f;    ///< ratio of a guard hair's width across its bend to its thickness (grass: 2.4)
  int undercoat = 4000;  ///< number of undercoat hairs in one slice
  float undercoat_length = 0.45f;  ///< greatest length of an undercoat hair, fraction of L0
  float least_length = 0.6f;       ///< length of the shortest guard hair, fraction of L0
  float taper = 1.6f;              ///< exponent of the decrease of radius towards the tip
  float tip_radius = 0.15f;        ///< radius at the tip, fraction of the radius at the root
  int locks = 700;                 ///< number of locks per slice; 0: no locks
  /// Displacement of a strand's tip towards its lock's centre, fraction of the distance, 0..1.
  float lock_pull = 0.45f;
  float lock_power = 1.0f;  ///< exponent of the height h in this displacement
  float bend = 0.0f;  ///< sideways offset of a blade's tip, texels of a slice of 256 x 256 texels (grass: 18)
  /// c of the bend's profile (e^(c t) - 1) / (e^c - 1). A larger c moves the bend towards the tip.
  float bend_exponent = 2.5f;
  float bend_spread = 0.0f;  ///< random variation of c between blades, +- fraction
  /// Tangent of the angle between view ray and strand. strand_radius() widens strands for rays of this angle.
  float sweep = 0.18f;
  float shade = 0.28f;      ///< random variation of shade between strands, +-
  float comb = 0.6f;        ///< tangent of the strands' tilt at rest; 0: upright, as in the paper
  float comb_noise = 0.0f;  ///< tilt in smooth random directions, added to `comb`
  glm::vec3 comb_direction{0.0f, -1.0f, -0.25f};  ///< direction of the comb, projected onto the surface
  float lod_bias = -1.0f;                         ///< offset of the mip level of the fur lookup
  int substeps = 1;  ///< samples of the fur per fragment within its layer, 1 to 8
  std::uint32_t seed = 1;
  std::string layer_spacing = "paper";  ///< "paper" | "uniform"
  std::string binding = "shared";       ///< "shared" | "separate"
  std::string uv = "computed";          ///< the mesh's UV map: "computed" | "file"
};

struct CurlScene {
  float radius = 0.0f;  ///< K_alpha, R
  float turns = 0.0f;   ///< number of turns from root to tip, omega / 2 pi
  /// Amplitude of the curl's phase variation over the surface, turns. It applies to the frame "smooth" only.
  float variation = 0.0f;
  std::string frame = "smooth";  ///< "smooth" | "uv"
};

/// A droplet on the surface. Exactly one of `uv` and `point` is given; `point` (R) is moved to the nearest
/// surface point.
struct DropletScene {
  std::optional<glm::vec2> uv;
  std::optional<glm::vec3> point;
  float radius = 0.012f;  ///< r_drop, UV units
  float wetness = 0.9f;   ///< rho_drop, 0..1
};

struct WetnessScene {
  int size = 256;                      ///< number of texels per side of the mask
  std::vector<DropletScene> droplets;  ///< explicit droplets, blended first, in this order
  int random = 0;                      ///< greatest number of random droplets
  std::uint32_t seed = 1;
  float radius = 0.012f;        ///< mean radius of random droplets, UV units
  float radius_spread = 0.3f;   ///< +- fraction of radius
  float wetness = 0.9f;         ///< mean wetness of random droplets
  float wetness_spread = 0.1f;  ///< +-
  float spacing = 1.0f;         ///< least distance between centres of random droplets, in radii
  float patch_cover = 1.0f;     ///< fraction of the surface on which random droplets may fall; 1: everywhere
  float patch_size = 0.6f;      ///< size of the contiguous wet areas, R; wetness fades at their borders
  /// Random droplets are placed only where this picture (in UV space) is bright; empty: everywhere.
  std::filesystem::path image;
};

struct ClumpScene {
  float shape = 0.0f;  ///< w of S Eq. 5; 0: linear profile, 1: logarithmic profile
  float gain = 3.5f;
  std::string scale = "relative";  ///< "relative" (gain) | "literal" (r_mask)
  std::string cells = "separate";  ///< "separate" | "literal"
};

struct WindScene {
  glm::vec3 direction{1.0f, 0.0f, 0.0f};
  float strength = 0.0f;    ///< N on a strand's mass
  float gust = 0.0f;        ///< fraction of strength
  float frequency = 1.0f;   ///< Hz
  float wavelength = 2.0f;  ///< distance between gusts along the wind's direction, R
};

/// Springs of the mass-spring topologies (docs/topology.md). Silva's strand does not use these values.
struct SpringsScene {
  float stiffness = 10;         ///< stiffness of the sticks, N/m, with 1 R = 1 m
  float damping = 0.02f;        ///< damping along the sticks, N s/m
  float edge_stiffness = 2;     ///< stiffness of the springs between tops, N/m
  float edge_damping = 0.004f;  ///< damping of the springs between tops, N s/m
  float return_weight = 0.2f;   ///< w of B Eq. 5, N
  float residual = 1e-5f;       ///< relative residual |r| / |b| at which the conjugate gradients stop
};

/// Motion of the object. It causes inertial forces on the fur of a topology. The camera moves with the
/// object.
struct MotionScene {
  glm::vec3 velocity{0.0f};          ///< R/s
  glm::vec3 shake{0.0f};             ///< amplitude of an oscillating translation, R
  float shake_frequency = 1.0f;      ///< Hz
  glm::vec3 axis{0.0f, 1.0f, 0.0f};  ///< axis of rotation through the origin
  float spin = 0.0f;                 ///< speed of a steady rotation, rad/s
  float swing = 0.0f;                ///< amplitude of an oscillating rotation, rad
  float swing_frequency = 1.0f;      ///< Hz
};

/// A local force on the tops of all triangles whose centroid lies within `radius` of a centre. The centre is
/// `point`. If `ray` is not zero, the centre is the ray's first intersection with the mesh, and the
/// intersected triangle is always included.
struct PokeScene {
  glm::vec3 point{0.0f};  ///< centre of the force, or the ray's origin, R
  glm::vec3 ray{0.0f};    ///< direction of the ray; 0: no ray
  /// Radius of the poked area, R. 0: only the triangle that the ray hits, or no triangle if there is no ray.
  float radius = 0.0f;
  glm::vec3 force{0.0f};  ///< force on each top, N
  float spread = 0.0f;    ///< additional force away from the line through the centre along `along`, N
  glm::vec3 along{0.0f, 0.0f, 1.0f};  ///< direction of this line
};

struct DynamicsScene {
  std::string topology = "silva";  ///< topology that moves the fur; scene_keys.cpp lists the names
  std::string solver{
      springs::default_solver.name};  ///< time integration; Silva's strand supports this solver only
  std::string bend = "paper";         ///< shape of a topology's layers: "linear" | "paper" | "tangent"
  float bend_power = 2.0f;            ///< k of B Eq. 4
  float mass = 0.001f;                ///< kg
  float stiffness = 0.4f;             ///< k of Silva's strand, N/m, with 1 R = 1 m
  float drag = 0.01f;                 ///< c, N s/m
  float step = 1.0f / 240.0f;         ///< dt, duration of a substep, s
  int substeps = 4;                   ///< number of substeps per frame
  /// Greatest error per frame for 99 of 100 tops of a topology, as a fraction of the fur's length. If it is
  /// above 0, the number of substeps adapts to it. 0: every frame has `substeps` substeps.
  float tolerance = 0.0f;
  float time = 0.0f;                    ///< simulated time before the first picture, s
  glm::vec3 gravity{0.0f, 0.0f, 0.0f};  ///< R/s^2
  WindScene wind;
  SpringsScene springs;
  MotionScene motion;
  PokeScene poke;
};

/// True if a mass-spring topology moves the fur; false for Silva's model, which has one strand per triangle.
inline bool has_springs(const DynamicsScene& dynamics) {
  return dynamics.topology != DynamicsScene{}.topology;
}

/// Number of frames that are simulated before the frame of the first picture: `time` over a frame's duration,
/// rounded.
inline int frames_before(const DynamicsScene& dynamics) {
  return static_cast<int>(dynamics.time / (dynamics.step * static_cast<float>(dynamics.substeps)) + 0.5f);
}

struct LightScene {
  glm::vec3 direction{0.25f, 1.0f, -0.4f};  ///< towards the light
  float intensity = 1.5f;
};

struct ShadingScene {
  std::string model = "curling";  ///< name of a shading model, see shading_models.cpp
  float shadow = 1.12f;           ///< K_shadow >= 1
  glm::vec3 specular{0.2f};       ///< K_s
  float exponent = 24.0f;         ///< p
  float ambient = 0.2f;
  float wrap = 0.75f;             ///< weight of (n.l+.4)/1.4 for each light; 0: the papers' equation
  float occlusion = 0.85f;        ///< sigma_occ
  float darkening = 0.3f;         ///< sigma_wet
  float wet_specular = 0.5f;      ///< sigma_spec, < 1
  std::string tangent = "paper";  ///< sign of the clump's tangent term, W Eq. 4: "paper" | "drawn"
  std::string sides = "one";      ///< sides of the surface that receive light: "one" (outside) | "two"
  std::vector<LightScene> lights{LightScene{}, LightScene{{0.35f, 0.3f, 0.9f}, 0.6f}};  ///< one or two lights
};

struct CoatScene {
  std::filesystem::path image;      ///< colour texture in UV space; empty: procedural coat
  std::string pattern = "patches";  ///< "plain" | "patches" | "stripes" | "spots" | "grass"
  glm::vec3 colour{0.86f, 0.70f, 0.50f};
  glm::vec3 second{0.62f, 0.44f, 0.27f};
  float scale = 0.5f;    ///< size of the pattern, R
  glm::vec3 skin{0.5f};  ///< factor on the coat's colour for the base surface
  std::uint32_t seed = 1;
  int texture = 512;  ///< number of texels per side of a procedural coat
};

struct CameraScene {
  /// True: the camera is placed along `direction` at the distance where the furred model fills the picture,
  /// see make_camera(). False: `eye` and `target` give its place.
  bool framed = true;
  glm::vec3 direction{1.3f, 1.15f, 2.35f};  ///< direction from the target to the eye
  glm::vec3 eye{1.3f, 1.15f, 2.35f};        ///< position of the camera unless `framed`, R
  glm::vec3 target{0.0f};                   ///< point in the picture's centre unless `framed`, R
  glm::vec3 up{0.0f, 1.0f, 0.0f};
  float fov = 37.0f;   ///< vertical field of view, degrees
  float near = 0.01f;  ///< distance of the near plane, R
};

struct ImageScene {
  int width = 800;
  int height = 600;
  glm::vec3 background{0.30f, 0.34f, 0.39f};
};

/// Options of mesh preparation.
struct MeshScene {
  glm::vec3 rotate{0.0f};          ///< rotation about x, then y, then z, degrees; it turns the model upright
  std::string components = "all";  ///< components of a file that are kept: "all" | "largest"
};

struct Scene {
  std::string model = "bunny";  ///< name of an entry of models.toml, or path of a mesh file
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

/// True if the corners of each triangle move independently of its neighbours, so that gaps can open between
/// the triangles of a layer.
inline bool parts(const Scene& scene) {
  return has_springs(scene.dynamics) ? scene.dynamics.topology.starts_with("separable")
                                     : scene.fur.binding == "separate";
}

}  // namespace pelage
