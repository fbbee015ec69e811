// Computes the coverage of a strand in a pixel, and its premultiplied colour. In an opacity map (MAP), it computes what the
// blending of OpenGL adds to a texel: the least depth; alpha times depth, alpha, and the alpha that reduces the transmittance.
in vec3 across;
in vec3 colour;
in float depth;
#ifdef MAP
layout(location = 0) out float least;
layout(location = 1) out vec4 sums;
#else
layout(location = 0) out vec4 fragment;
#endif
#ifdef SKIN
layout(binding = 2) uniform sampler2D skin_depth;
#endif

void main() {
  float coverage = max(0.0, min(across.x + across.y, 0.5) - max(across.x - across.y, -0.5));
  float alpha = coverage * across.z;
#ifdef MAP
  if (coverage <= 0.0) discard;
  least = depth;
  sums = vec4(alpha * depth, alpha, 0.0, alpha);
#else
#ifdef SKIN
  alpha *= clamp(1.0 + 128.0 * (texelFetch(skin_depth, ivec2(gl_FragCoord.xy), 0).x - depth), 0.0, 1.0);
#endif
  fragment = vec4(alpha * colour, alpha);
#endif
}
