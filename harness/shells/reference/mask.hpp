// Computes the wetness mask and the clumping of wet fragments (docs/shells.md). The mask is computed by
// Algorithm 1 of S and W. The clumping is computed by S Eq. 5 and S Algorithm 2.
#pragma once
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/scene/scene.hpp"
#include "harness/shells/reference/reference.hpp"
#include "harness/shells/reference/textures.hpp"

namespace pelage::reference {

/// A texel of the mask: the centre and the radius of a clump in UV units, and the wetness of the clump, 0 to
/// 1. All values of a dry texel are 0.
struct Clump {
  glm::dvec2 centre{0.0};
  double radius = 0.0;
  double wetness = 0.0;
  bool operator==(const Clump&) const = default;
};

/// Whether a droplet is blended with a texel in its disc, or overwrites it (docs/shells.md, section 2). `way`
/// is the scene key wetness.blend.
bool is_blended(const Clump& texel, const Droplet& droplet, const std::string& way);

/// Applies one droplet to a texel in the droplet's disc (docs/shells.md, section 2). Returns the new texel.
/// `margin`: times 4 alpha (1 - alpha), it is added to a blended radius, in UV units.
Clump blend(const Clump& texel, const Droplet& droplet, const std::string& way, double margin = 0.0);

/// Applies a droplet to a texel that it touches. `inside`: the droplet's disc contains the texel's centre.
/// Otherwise a wet texel stays as it is.
Clump applied(const Clump& texel, const Droplet& droplet, bool inside, const Scene& scene);

struct Mask {
  int size = 0;
  std::vector<Clump> texel;  ///< size x size texels; row j is at v = (j + .5) / size
  /// Returns the texel that contains uv. The mask repeats outside 0..1.
  const Clump& nearest(const glm::dvec2& uv) const;
  /// Returns the clump that displaces the fur at uv. With clump.cells "consistent", a point outside the disc
  /// of its texel's clump is dry.
  Clump wet_at(const glm::dvec2& uv, const std::string& cells) const;
  /// Returns the wetness at uv. With clump.cells "consistent", it falls to 0 in the ring around a clump's
  /// disc.
  double wetness_at(const glm::dvec2& uv, const std::string& cells) const;
  /// Returns the cell that contains a clump's centre, in a grid of 64 cells per side of a texel. With
  /// clump.cells "separate", texels with the same cell belong to the same clump.
  glm::dvec2 cell(const Clump& clump) const;
  /// Returns the part of its wetness that a clump has at uv with clump.cells "consistent": 1 in its disc, 0
  /// outside of the ring around it, and linear in the ring. The ring is half a texel wide.
  double ring_share(const Clump& clump, const glm::dvec2& uv) const;
  /// Returns the mask at uv with bilinear interpolation. The mask repeats outside 0..1. Only the deliberate
  /// mistake Mutant::mask_bilinear needs this function.
  Clump bilinear(const glm::dvec2& uv) const;
};

/// Returns the mask of the picture after `frames` frames (docs/shells.md, section 1). The number of frames
/// matters only if the water changes over time (docs/shells.md, section 10).
Mask wetness_mask(const FrameInput& input, int frames = 1, Mutant mutant = Mutant::none);

/// Returns how many of the wet texels of this mask were blended from several droplets, as a fraction of all
/// wet texels. Returns 0 if no texel is wet.
double blended_share(const FrameInput& input, int frames = 1);

/// Returns the factor of a clump's displacement at the height h (S Eq. 5): (1 - w) h + w (1 + ln h / ln N).
/// Here w is the scene's clump.shape, and N is `layers`. With the clump.function "rate", it is the part of
/// the way to the clump's centre that Bruderlin (2000) moves a point of a hair of three segments, for the
/// clump-percent 1 and the clump-rate w. The factor is in [0, 1] for h in [1/N, 1].
double clump_shape(double h, double w, int layers, std::string_view function = "logarithmic",
                   Mutant mutant = Mutant::none);

/// Returns the UV position at which `clump` draws the strand with the root `root`, in a layer with the factor
/// `f` (clump_shape()) of S Eq. 5: the position p with p + d(p) = root.
glm::dvec2 drawn_at(const Scene& scene, const Clump& clump, double f, const glm::dvec2& root);

/// A place where a clump draws a strand, and the weight of this clump among those around the strand's root.
struct Placement {
  double weight = 0.0;
  glm::dvec2 misplaced{0.0};  ///< the place minus the position of the fragment that shows the strand, in UV
};

/// The result of S Algorithm 2 for a fragment: whether it is discarded, and the shift of its texture
/// coordinates.
struct Displacement {
  bool outside = false;  ///< outside the radius of the texel's clump (the first test of the algorithm)
  bool dry = false;      ///< the mask is dry at the displaced position (the second test)
  bool discarded = false;
  /// With clump.cells "consistent", in a wet texel: where the clumps in the four texels around the strand's
  /// root draw the strand. The weights add up to 1.
  std::vector<Placement> placements;
  /// With clump.cells "consistent", in a wet texel: the displacement by the texel's clump, which is d in the
  /// clump's disc, and the distance of the fragment from the border of this disc; both in UV units.
  glm::dvec2 border_d{0.0};
  double border_distance = 0.0;
  glm::dvec2 d{0.0};        ///< offset added to the texture coordinates, in UV units
  glm::dvec2 delta_d{0.0};  ///< d minus the value of d on the layer below (W Eq. 4); on layer 0 equal to d
  /// How far the clump moves the drawn strand from the layer below to this layer, in UV units. A strand with
  /// the root q is drawn at the point p with p + d(p) = q.
  glm::dvec2 moved{0.0};
  /// Distance between the roots of two strands, divided by the distance of the strands in this layer. 1 if
  /// the reading of S Eq. 5 has no such factor for the texture lookup.
  double stretch = 1.0;
  double wetness = 0.0;  ///< rho at uv
  double film = 0.0;     ///< the part of the surface at uv that the film of soaked fur covers
  double film_wetness = 0.0;
};
Displacement clump_displacement(const FrameInput& input, const Mask& mask, const glm::dvec2& uv, int n,
                                Mutant mutant = Mutant::none);

/// The parts of the wet fur that the two tests of S Algorithm 2 discard, over four positions in each wet
/// texel and all layers; of more than `most` places, over an evenly spaced part. All places of a mask of 512
/// x 512 texels with 160 layers would take two minutes. A texel's centre lies in its clump's disc, so only
/// other positions can be outside. `dry` does not count what `outside` counts.
struct Discards {
  double outside = 0, dry = 0;
};
Discards discards(const FrameInput& input, int frames = 1, std::size_t most = std::size_t{1} << 21);

/// Returns S, the part of fur of the wetness rho (0 to 1) that the film covers, 0 to 1.
double soaked_share(const SoakedScene& soaked, double rho);

/// Returns the coverage of the film in a layer of the height h: 1 up to soaked.height, and 0 from one layer
/// above it.
double film_coverage(const Scene& scene, double h);

/// Adds the film to a sample of the fur. `share`: the part of the surface that the film covers. `coverage`:
/// the film's coverage in this layer. Returns the part of the new coverage that is film.
double cover_with_film(FurSample& fur, double share, double coverage);

}  // namespace pelage::reference
