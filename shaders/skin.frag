// Draws the base surface (docs/shells.md, section 7). The host puts the constants and shaders/light.glsl before this
// file.
in vec2 uv;
in vec3 normal;
layout(binding = 1) uniform sampler2D coat;
layout(binding = 2) uniform sampler2D mask;
layout(location = 0) out vec4 colour;

void main() {
  vec3 outwards = unit(normal), e = view(), nu = lit_normal(outwards, e);
  float light = AMBIENT + INTENSITY_0 * lambert(dot(nu, LIGHT_0));
#if LIGHTS > 1
  light += INTENSITY_1 * lambert(dot(nu, LIGHT_1));
#endif
#ifdef WET_MODEL
  float shadow = 1.0 - OCCLUSION, wet = 1.0 - DARKENING * wetness_at(mask, uv);
#else
  float shadow = (SHADOW - 1.0) / SHADOW, wet = 1.0;
#endif
#ifdef TWO_SIDED
  if (dot(outwards, e) > 0.0) shadow = 1.0;  // factor 1: the fur casts no shadow on the back of the surface
#endif
  float gamma = shadow * wet;
  colour = vec4(gamma * light * textureLod(coat, uv, 0.0).rgb * SKIN_COLOUR, 1.0);
}
