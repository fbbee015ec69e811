// Computes the lighting of docs/shells.md, section 6. The shaders of the fur layers and of the base surface use these
// functions. W = Silva et al. 2010, Real-Time Rendering of Wet Fur.
vec3 unit(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }  // the zero vector stays zero

// Returns the unit vector from the eye to the surface. RAY is the view ray through the origin of window coordinates.
vec3 view() { return unit(RAY + gl_FragCoord.x * RAY_DX + gl_FragCoord.y * RAY_DY); }

// Returns the part of its wetness that a clump (c_u, c_v, r, rho) has at p: with CONSISTENT_CELLS, 1 in the disc, and
// from 1 to 0 in a ring of half a mask texel around it.
float ring_share(sampler2D mask, vec4 clump, vec2 p) {
#ifdef CONSISTENT_CELLS
  return clamp(1.0 + 2.0 * float(textureSize(mask, 0).x) * (clump.z - distance(p, clump.xy)), 0.0, 1.0);
#else
  return 1.0;
#endif
}

// Returns the wetness at p.
float wetness_at(sampler2D mask, vec2 p) {
  vec4 clump = textureLod(mask, p, 0.0);
  return clump.w * ring_share(mask, clump, p);
}

// Returns the normal for lighting. With TWO_SIDED, a normal that faces away from the eye is reversed. e points from the
// eye to the surface.
vec3 lit_normal(vec3 nu, vec3 e) {
#ifdef TWO_SIDED
  if (dot(nu, e) > 0.0) return -nu;
#endif
  return nu;
}

// Returns max(0, (n.l + 0.4) / 1.4), the diffuse light of "wrap lighting", which is positive also for some n.l < 0.
float wrapped(float n_dot_l) { return max(0.0, (n_dot_l + 0.4) / 1.4); }

// Returns the diffuse light of one light source (C_d of W Eq. 2), divided by its intensity and by the colour K.
float lambert(float n_dot_l) { return (1.0 - WRAP) * max(0.0, n_dot_l) + WRAP * wrapped(n_dot_l); }

// Returns the factor g_l of docs/shells.md, section 6, divided by the light's intensity.
float dimmed(float n_dot_l) { return 1.0 + WRAP * (wrapped(n_dot_l) - 1.0); }
