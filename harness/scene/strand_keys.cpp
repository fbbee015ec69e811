// The scene keys of fur of single strands (docs/strands.md). In the help texts, R is the radius of the
// model's bounding sphere, and L is the length of a strand.
#include "harness/scene/scene_keys.hpp"

namespace pelage {
// clang-format off
std::vector<Key> strand_keys(StrandsScene& s) {
  ChainScene& chain = s.chain;
  return {
      {.name = "strands.groom", .slot = &s.groom, .help = "where the strands come from: \"grown\": the fur layers; \"file\": the file strands.file, with the look and the motion of the only fur layer", .choices = {"grown", "file"}},
      {.name = "strands.file", .slot = &s.file, .help = "strands as polylines: a .hair file (Cem Yuksel's format) or the lines (l) of an .obj file; needs strands.groom = \"file\""},
      {.name = "strands.file_unit", .slot = &s.file_unit, .help = "coordinates in strands.file: \"R\": those of the prepared model, as `pelage groom` writes them; \"mesh\": those of the model's mesh file", .choices = {"R", "mesh"}},
      {.name = "strands.skin", .slot = &s.skin, .help = "true: the mesh is drawn below the strands with the coat's colour, and hides the strands behind it; false: only strands"},
      {"strands.segments", &s.segments, "", 1, 7, "greatest number of straight segments that a drawn strand is divided into"},
      {.name = "strands.subdivision", .slot = &s.subdivision, .help = "number of segments of a drawn strand: \"fixed\" is strands.segments; \"screen\" is as many as the longest strand needs on the screen; \"strand\" is as many as each strand needs; at most strands.segments", .choices = {"fixed", "screen", "strand"}},
      {.name = "strands.back_facing", .slot = &s.back_facing, .help = "strands that face away from the camera: \"removed\" leaves them out before the sort; \"last\" sorts them to the end of the list and leaves them out there, as in the paper, with the same picture; \"drawn\" draws them", .choices = {"removed", "last", "drawn"}},
      {"strands.fraction", &s.fraction, "", 0.001, 1, "part of the strands that is drawn; below 1, the drawn strands are wider, so that the fur covers the same area"},
      {"strands.least_width", &s.least_width, "pixels", 0, 10, "mean width at the roots, at the distance of the object's centre, below which strands.fraction is lowered: fewer and wider strands are drawn; with 0.125, the change is hardly visible; 0: strands.fraction is kept"},
      {"strands.taper", &s.taper, "of the width", 0, 1, "part of the width that a strand loses from root to tip"},
      {"strands.opacity", &s.opacity, "", 0, 1, "alpha of a strand at its root; it falls to 0 at the tip"},
      {"strands.bands", &s.bands, "", 1, 2, "highest degree l of the spherical harmonics to which the fill lights are projected"},
      {"strands.rim", &s.rim, "RGB", 0, 100, "colour of the rim light; [0, 0, 0]: no rim light"},
      {"strands.rim_exponent", &s.rim_exponent, "", 1, 1000, "exponent of the rim light; a larger exponent gives a narrower rim"},
      {"strands.skin_shadow", &s.skin_shadow, "", 0, 1, "part of the light that a strand loses at its root, because the skin is near; 0: no shadow of the skin"},
      {"strands.skin_shadow_height", &s.skin_shadow_height, "L", 0.001, 1000, "height above the skin at which the shadow of the skin ends"},
      {.name = "strands.shadow", .slot = &s.shadow, .help = "shadow of the key light by an opacity map: \"linear\" attenuates the light linearly with the depth behind the first strand, \"exp\" exponentially with the optical depth; \"none\": no shadow", .choices = {"none", "linear", "exp"}},
      {"strands.shadow_size", &s.shadow_size, "texels", 16, 4096, "number of texels per side of the opacity map"},
      {"strands.chain.stiffness", &chain.stiffness, "1/s^2", 0, 1e6, "k1, the stiffness between the skin and the first segment, relative to the mass of the strand"},
      {"strands.chain.stiffness_joint", &chain.stiffness_joint, "1/s^2", 0, 1e6, "k2, the stiffness between the two segments"},
      {"strands.chain.limit", &chain.limit, "degrees", 1, 180, "greatest angle between a strand's direction at rest and its first segment"},
      {"strands.chain.limit_joint", &chain.limit_joint, "degrees", 1, 180, "greatest angle between the two segments"},
      {"strands.chain.drag", &chain.drag, "1/s", 0, 1000, "drag coefficient of joint and tip, divided by their mass"},
      {"strands.chain.damping", &chain.damping, "1/s", 0, 1000, "damping of the first segment's angular rate"},
      {"strands.chain.damping_joint", &chain.damping_joint, "1/s", 0, 1000, "damping of the difference between the segments' angular rates"},
      {"strands.chain.first_segment", &chain.first_segment, "L", 0.1, 0.9, "length of the first segment; the second segment has the rest of the strand's length"},
      {"strands.chain.tip_mass", &chain.tip_mass, "of the strand's mass", 0.05, 0.95, "mass at the tip; the joint has the rest"},
      {.name = "strands.chain.collision", .slot = &chain.collision, .help = "what the joint and the tip of a strand collide with: \"plane\" is the plane of the skin at the root; \"body\" is also a signed distance field of the mesh, which must be closed and must not deform", .choices = {"plane", "body"}},
      {"strands.chain.body_cells", &chain.body_cells, "", 4, 256, "number of cells of the distance field along the longest side of the mesh"},
  };
}

std::vector<Key> strand_layer_keys(StrandLayerScene& l) {
  return {
      {"count", &l.count, "", 1, 4000000, "number of strands"},
      {"seed", &l.seed, "", 0, most_seed, "random seed of the layer"},
      {"length", &l.length, "R", 0.0001, 10, "mean length of a strand"},
      {"length_spread", &l.length_spread, "of the length", 0, 0.95, "greatest random deviation from the mean length"},
      {"width", &l.width, "R", 0.000001, 1, "width of a strand at its root"},
      {"lean", &l.lean, "degrees", 0, 90, "angle between the surface normal and a strand at rest"},
      {"comb", &l.comb, "direction", -1e6, 1e6, "direction in which the strands lean, projected onto the surface"},
      {"curvature", &l.curvature, "degrees", -180, 180, "rotation of a strand's second segment; positive angles rotate it towards the skin"},
      {"curvature_spread", &l.curvature_spread, "degrees", 0, 180, "greatest random deviation from curvature"},
      {"twist", &l.twist, "degrees", -180, 180, "rotation of a strand about the surface normal"},
      {"twist_spread", &l.twist_spread, "degrees", 0, 180, "greatest random deviation from twist"},
      {"locks", &l.locks, "", 0, 1000000, "number of locks, which are groups of strands whose tips meet; the first strands of the layer are the middles of the locks; 0: no locks"},
      {"lock_pull", &l.lock_pull, "", 0, 1, "part of the way that the tip of a strand moves to the tip of the middle of its lock"},
      {"stiffness", &l.stiffness, "", 0, 100, "factor of strands.chain.stiffness and strands.chain.stiffness_joint"},
      {"drag", &l.drag, "", 0, 100, "factor of strands.chain.drag"},
      {"damping", &l.damping, "", 0, 100, "factor of strands.chain.damping and strands.chain.damping_joint"},
      {"limit", &l.limit, "", 0.01, 100, "factor of strands.chain.limit and strands.chain.limit_joint; the angles are limited to 1 to 180 degrees"},
      {"response", &l.response, "", 0, 10, "factor of a strand's movement away from its direction at rest; below 1 the movement is damped, above 1 it is exaggerated"},
      {"opacity", &l.opacity, "", 0, 100, "factor of strands.opacity; the product must be at most 1"},
      {"taper", &l.taper, "", 0, 100, "factor of strands.taper; the product must be at most 1"},
      {"gloss", &l.gloss, "", 0, 100, "factor of shading.specular"},
      {"exponent", &l.exponent, "", 0.001, 1000, "factor of shading.exponent; the product must be from 1 to 10000"},
      {"rim", &l.rim, "RGB", 0, 100, "factor of strands.rim"},
      {"rim_exponent", &l.rim_exponent, "", 0.001, 1000, "factor of strands.rim_exponent; the product must be from 1 to 1000"},
      {"skin_shadow", &l.skin_shadow, "", 0, 100, "factor of strands.skin_shadow; the product must be at most 1"},
      {"colour", &l.colour, "RGB", 0, 10, "factor of the coat's colour"},
      {"colour_spread", &l.colour_spread, "of the colour", 0, 1, "greatest random deviation of a strand's brightness"},
      {"region_centre", &l.region_centre, "R", -1e6, 1e6, "centre of a ball that limits the layer's region"},
      {"region_radius", &l.region_radius, "R", 0, 1e6, "radius of this ball; 0: the region is the whole surface"},
      {.name = "region_outside", .slot = &l.region_outside, .help = "true: the region is the surface outside of the ball"},
      {.name = "mask", .slot = &l.mask, .help = "picture in UV space: the layer has strands only where its luma is at least 0.5; \"\": everywhere"},
      {.name = "density_map", .slot = &l.density_map, .help = "picture in UV space whose luma is the relative density of strands; \"\": the same density everywhere"},
      {.name = "length_map", .slot = &l.length_map, .help = "picture in UV space whose luma is a factor of the length; \"\": no map"},
      {.name = "width_map", .slot = &l.width_map, .help = "picture in UV space whose luma is a factor of the width; \"\": no map"},
      {.name = "stiffness_map", .slot = &l.stiffness_map, .help = "picture in UV space whose luma is a factor of the stiffness; \"\": no map"},
      {.name = "response_map", .slot = &l.response_map, .help = "picture in UV space whose luma is a factor of the response; \"\": no map"},
      {.name = "curvature_map", .slot = &l.curvature_map, .help = "picture in UV space with the luma v: 2 v - 1 is a factor of the curvature; \"\": no map"},
      {.name = "twist_map", .slot = &l.twist_map, .help = "picture in UV space with the luma v: 2 v - 1 is a factor of the twist; \"\": no map"},
      {.name = "comb_map", .slot = &l.comb_map, .help = "picture in UV space with the combing direction in tangent space, instead of comb: 2 red - 1 along growing u, 2 green - 1 along growing v, 2 blue - 1 along the normal; \"\": no map"},
      {.name = "film", .slot = &l.film, .help = "film strip: a picture with 8 columns and one row per frame; red is the luminance, green the gloss, blue the transparency; \"\": no film strip"},
      {"order_bias", &l.order_bias, "R", -1000, 1000, "added to the layer's view depth when the fur layers are sorted"},
      {"order_offset", &l.order_offset, "", -255, 255, "number of places by which the layer moves back among the sorted fur layers"},
  };
}

std::vector<Key> strand_fill_keys(StrandFillScene& fill) {
  return {
      {"direction", &fill.direction, "direction", -1e6, 1e6, "direction towards the fill light"},
      {"colour", &fill.colour, "RGB", 0, 1000, "intensity of the fill light for each colour"},
  };
}
// clang-format on

}  // namespace pelage
