// The part of the key light that reaches a point, from the opacity map (docs/strands.md, section Shadow). SHADOW is 0 for no
// shadow, 1 for the reading "linear" and 2 for "exp". MAP_COLUMN, MAP_ROW and MAP_DEPTH are the rows of map_rows() in
// harness/strands/drawing/drawing.hpp, and PER_LENGTH is 1 divided by the mean length of the strands.
#if SHADOW
layout(binding = 0) uniform sampler2D map_least;   // least depth of the fragments
layout(binding = 1) uniform sampler2D map_sums;    // sums of alpha times depth and of alpha, 0, transmittance

float texel_light(ivec2 texel, float z) {
  float least = texelFetch(map_least, texel, 0).x;
  vec4 sums = texelFetch(map_sums, texel, 0);
#if SHADOW == 1
  return 1.0 - (1.0 - sums.w) * clamp((z - least) * PER_LENGTH, 0.0, 1.0);
#else
  float behind = sums.y > 0.0 ? sums.x / sums.y - least : 0.0;
  float per_depth = behind > 0.0 ? min(PER_LENGTH, 0.5 / behind) : PER_LENGTH;
  return pow(max(sums.w, 9.5367431640625e-7), clamp((z - least) * per_depth, 0.0, 1.0));
#endif
}
#endif

// view: X, Y and W of the point.
float key_light(vec3 view) {
#if SHADOW
  vec4 v = vec4(view, 1.0);
  vec2 at = clamp(vec2(dot(MAP_COLUMN, v), dot(MAP_ROW, v)), 0.0, MAP_SIZE - 1.0);
  vec2 corner = min(floor(at), MAP_SIZE - 2.0), part = at - corner;
  float z = dot(MAP_DEPTH, v);
  ivec2 c = ivec2(corner);
  float above = mix(texel_light(c, z), texel_light(c + ivec2(1, 0), z), part.x);
  float below = mix(texel_light(c + ivec2(0, 1), z), texel_light(c + ivec2(1, 1), z), part.x);
  return mix(above, below, part.y);
#else
  return 1.0;
#endif
}
