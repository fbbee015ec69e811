// Lighting of docs/frame.md, section 6, shared by both papers' models and the base surface.
vec3 unit(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }  // returns 0 for 0

// Returns the unit vector from the eye to the surface. RAY is the ray through the window's origin.
vec3 view() { return unit(RAY + gl_FragCoord.x * RAY_DX + gl_FragCoord.y * RAY_DY); }

// Returns the normal for lighting, reversed with TWO_SIDED if it faces away from the eye. e points from the eye to the
// surface.
vec3 lit_normal(vec3 nu, vec3 e) {
#ifdef TWO_SIDED
  if (dot(nu, e) > 0.0) return -nu;
#endif
  return nu;
}

// max(0, (n.l + .4) / 1.4)
float wrapped(float n_dot_l) { return max(0.0, (n_dot_l + 0.4) / 1.4); }

// W Eq. 2, C_d per unit of light and colour.
float lambert(float n_dot_l) { return (1.0 - WRAP) * max(0.0, n_dot_l) + WRAP * wrapped(n_dot_l); }

// Returns g_l per unit of the light's intensity.
float dimmed(float n_dot_l) { return 1.0 + WRAP * (wrapped(n_dot_l) - 1.0); }
