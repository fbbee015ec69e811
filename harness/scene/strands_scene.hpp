// The part of a scene that describes fur of single strands (docs/strands.md). The pipelines `strands` and
// `strands-opengl` use it. strand_keys.cpp says what a value means.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace pelage {

/// A fur layer: the strands of a region of the surface. A map is a picture in UV space. The map of a value
/// multiplies this value by 0 to 1; the maps of signed angles multiply the angle by -1 to 1 (2 v - 1 for a
/// map value v). An empty path means a map that is 1 everywhere.
struct StrandLayerScene {
  int count = 100000;                   ///< number of strands
  std::uint32_t seed = 1;               ///< seed of the layer's random values
  float length = 0.1f;                  ///< mean length of a strand, R
  float length_spread = 0.3f;           ///< greatest random deviation of a length, as a fraction of `length`
  float width = 0.002f;                 ///< width of a strand at its root, R
  float lean = 40.0f;                   ///< angle between the normal and a strand at rest, degrees
  glm::vec3 comb{0.0f, -1.0f, -0.25f};  ///< direction in which the strands lean, projected onto the surface
  float curvature = 0.0f;               ///< rotation of the second segment towards the skin, degrees
  float curvature_spread = 0.0f;        ///< greatest random deviation from `curvature`, degrees
  float twist = 0.0f;                   ///< rotation of a strand about the normal, degrees
  float twist_spread = 0.0f;            ///< greatest random deviation from `twist`, degrees
  int locks = 0;                        ///< number of locks, groups of strands whose tips meet; 0: no locks
  float lock_pull = 0.7f;  ///< part of the way that a tip moves to the tip of the middle of its lock
  float stiffness = 1.0f;  ///< factor of the stiffnesses of the chain
  float drag = 1.0f, damping = 1.0f;   ///< factors of the chain's drag and damping
  float limit = 1.0f;                  ///< factor of the chain's greatest angles
  float response = 1.0f;               ///< factor of a strand's movement away from its direction at rest
  float opacity = 1.0f, taper = 1.0f;  ///< factors of StrandsScene::opacity and StrandsScene::taper
  float gloss = 1.0f;                  ///< factor of the highlight's colour
  float exponent = 1.0f;               ///< factor of the highlight's exponent
  glm::vec3 rim{1.0f};                 ///< factor of StrandsScene::rim
  float rim_exponent = 1.0f, skin_shadow = 1.0f;  ///< factors of the same values of StrandsScene
  glm::vec3 colour{1.0f};                         ///< factor of the coat's colour
  float colour_spread = 0.2f;     ///< greatest random deviation of a strand's brightness, as a fraction
  glm::vec3 region_centre{0.0f};  ///< centre of the ball that the layer's region is limited to, R
  float region_radius = 0.0f;     ///< radius of this ball in R; 0: the region is the whole surface
  bool region_outside = false;    ///< true: the region is outside of the ball
  std::filesystem::path mask;     ///< the layer has strands only where this map is at least 0.5
  std::filesystem::path density_map, length_map, width_map, stiffness_map, response_map;
  std::filesystem::path curvature_map, twist_map;  ///< maps of signed angles
  std::filesystem::path comb_map;
  std::filesystem::path film;
  float order_bias = 0.0f;  ///< added to the layer's view depth when layers are sorted, R
  int order_offset = 0;     ///< number of places by which the layer moves back in the sorted layers

  /// True if the strands bend, turn or respond in a way of their own.
  bool is_styled() const {
    return response != 1 || !response_map.empty() || twist != 0 || twist_spread != 0 || curvature != 0 ||
           curvature_spread != 0;
  }
};

/// A fill light of strands. All fill lights are projected to spherical harmonics.
struct StrandFillScene {
  glm::vec3 direction{-0.6f, 0.2f, 0.7f};  ///< towards the light
  glm::vec3 colour{0.2f};                  ///< intensity per colour
};

/// The two-segment chains that move the strands. L is the length of a strand.
struct ChainScene {
  float stiffness = 800.0f;        ///< k1, between the skin and the first segment, 1/s^2
  float stiffness_joint = 400.0f;  ///< k2, between the two segments, 1/s^2
  float limit = 80.0f;         ///< greatest angle between the rest direction and the first segment, degrees
  float limit_joint = 80.0f;   ///< greatest angle between the two segments, degrees
  float drag = 4.0f;           ///< drag coefficient of joint and tip divided by their mass, 1/s
  float damping = 0.2f;        ///< damping of the first segment's rate, 1/s
  float damping_joint = 0.2f;  ///< damping of the difference between the segments' rates, 1/s
  float first_segment = 0.5f;  ///< length of the first segment, L
  float tip_mass = 0.4f;       ///< part of a strand's mass at the tip; the joint has the rest
  std::string collision = "plane";
  int body_cells = 64;  ///< number of cells of this field along the longest side of the mesh
};

struct StrandsScene {
  std::string groom = "grown";  ///< "grown" | "file"
  std::filesystem::path file;   ///< strands of the groom "file"
  std::string file_unit = "R";  ///< "R" | "mesh"
  bool skin = true;             ///< true: the mesh is drawn below the strands and hides those behind it
  int segments = 6;             ///< greatest number of straight segments of a drawn strand
  std::string subdivision = "fixed";
  std::string back_facing = "removed";
  float fraction = 1.0f;  ///< part of the strands that is drawn; their width grows so that coverage is kept
  float least_width = 0.0f;
  float taper = 0.85f;    ///< part of the width that a strand loses from root to tip
  float opacity = 0.85f;  ///< alpha of a strand at its root
  int bands = 2;          ///< highest degree of the spherical harmonics of the fill lights
  glm::vec3 rim{0.0f};    ///< colour of the rim light
  float rim_exponent = 3.0f;
  float skin_shadow = 0.6f;         ///< part of the light that a strand loses at its root
  float skin_shadow_height = 0.5f;  ///< height above the skin without this loss, L
  std::string shadow = "linear";
  int shadow_size = 512;  ///< number of texels per side of the opacity map
  std::vector<StrandLayerScene> layers{StrandLayerScene{}};
  std::vector<StrandFillScene> fills;
  ChainScene chain;
};

}  // namespace pelage
