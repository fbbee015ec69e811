// Draws a fragment of layer n (S sections 3.3 and 4, "fragment shader"; docs/shells.md, section 6). S = Silva et al.
// 2010, Curling and Clumping Fur Represented by Texture Layers; W = Silva et al. 2010, Real-Time Rendering of Wet Fur.
// The host puts the constants, shaders/layers.glsl and shaders/light.glsl before this file.
#define CLUMP_LITERAL 0
#define CLUMP_DISTANCE 1
#define CLUMP_CONVERGE 2
#define TANGENT_PAPER 0
#define TANGENT_DRAWN 1
#define TANGENT_STRAND 2
#define TANGENT_PRINTED 3

in vec2 uv;
in vec3 normal, rise;
#ifdef WET_MODEL
in vec3 along_u, along_v;
#endif
#ifdef INSTANCED
flat in vec4 look;
#else
#define look LAYER_LOOK
#endif
layout(binding = 0) uniform FUR_SAMPLER fur;  // red: coverage; green: half of the shade, a factor of the coat's colour
layout(binding = 1) uniform sampler2D coat;
layout(binding = 2) uniform sampler2D mask;   // c_u, c_v, r, rho; sampled with NEAREST
#ifdef DENSITY_MAP
layout(binding = 3) uniform sampler2D density;  // factor of DENSITY; the top row is at v = 1
#endif
layout(location = 0) out vec4 colour;

#if defined(FUR_ARRAY)
#define FUR_AT(p) vec3(p, look.w)
#else
#define FUR_AT(p) vec3(p, (look.w + 0.5) / float(LAYERS))
#endif

vec2 fur_texel(vec2 p, float level) {
  return textureLod(fur, FUR_AT(p), level).rg;
}

// Returns x^exponent for x >= 0. Without the wet model, `exponent` is always the constant EXPONENT.
float power(float x, float exponent) {
#if defined(WHOLE_EXPONENT) && !defined(WET_MODEL)
  float y = 1.0;
  for (int n = WHOLE_EXPONENT; n > 0; n >>= 1) {
    if ((n & 1) != 0) y *= x;
    x *= x;
  }
  return y;
#else
  return pow(max(x, 1e-30), exponent);
#endif
}

// S Eq. 6 and W Eq. 3: adds the diffuse and specular light of one source to `sum`. The unit vectors are t along
// the strand, nu along the surface normal, e from the eye to the surface, and `light` to the light source.
void add_light(vec3 light, float intensity, vec3 t, vec3 nu, vec3 e, float exponent, inout vec2 sum) {
  float n_l = dot(nu, light), t_l = dot(t, light), t_e = dot(t, e);
  float sine_l = sqrt(max(0.0, 1.0 - t_l * t_l)), sine_e = sqrt(max(0.0, 1.0 - t_e * t_e));
  float g = intensity * dimmed(n_l);
#ifdef WET_MODEL
  sum.x += intensity * lambert(n_l);
#else
  sum.x += g * sine_l;
#endif
  sum.y += g * power(max(0.0, t_l * t_e + sine_l * sine_e), exponent);
}

#ifdef SOAKED_FUR
// Returns the highlight of one source on the film of soaked fur.
float film_gloss(vec3 light, float intensity, vec3 nu, vec3 e) {
  vec3 mirrored = e - 2.0 * dot(nu, e) * nu;
  return intensity * dimmed(dot(nu, light)) * pow(max(dot(mirrored, light), 1e-30), EXPONENT);
}
#endif

#if defined(CLUMPS) && defined(CONSISTENT_CELLS)
// Returns the length of a vector in UV, as a fraction of a pixel's footprint, and at most 1.
float in_pixels(vec2 d, float per_footprint) { return min(1.0, per_footprint * length(d * FUR_SCALE * FUR_TEXELS)); }

// At the border of a disc, the displacement of the fur jumps from d to 0. Returns the part of the coverage that remains
// there on both sides.
float border_share(float depth, vec2 d, float per_footprint) {
  return max(1.0 - in_pixels(d, per_footprint), min(1.0, 2.0 * float(textureSize(mask, 0).x) * abs(depth)));
}

// Returns S, the part of fur of the wetness rho that the film of soaked fur covers (docs/shells.md, section 11).
float soaked_share(float rho) {
#ifdef SOAKED_FUR
  float x = clamp((rho - SOAKED) / (1.0 - SOAKED), 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
#else
  return 0.0;
#endif
}

// Returns the wetness with which a clump displaces the fur: in soaked fur, clumps disappear.
float clumping(float rho) { return rho * (1.0 - soaked_share(rho)); }

// Returns by how much the clump displaces a fragment if no film of soaked fur covers it. `from` is the vector from the
// clump's centre to the fragment, and `rate` is f(h) of S Eq. 5.
vec2 unsoaked_shift(vec4 clump, vec2 from, float rate) {
#if CLUMP_READING == CLUMP_CONVERGE
  float near = min(clump.w * rate, 0.98);
  return near / (1.0 - near) * from;
#elif CLUMP_READING == CLUMP_DISTANCE
  return rate * clump.w * clump.z * inversesqrt(max(dot(from, from), 1e-30)) * from;
#else
  return rate * clump.w * clump.z * CLUMP_GAIN * from;
#endif
}

// Returns the mask's texel k (0 to 3) of the four whose centres are around p, and its bilinear weight.
vec4 texel_around(vec2 p, int k, out float weight) {
  int size = textureSize(mask, 0).x;
  vec2 place = fract(p - 0.5 / float(size)) * float(size), corner = floor(place), part = place - corner;
  ivec2 next = ivec2(k & 1, k >> 1);
  vec2 weights = mix(1.0 - part, part, vec2(next));
  weight = weights.x * weights.y;
  return texelFetch(mask, (ivec2(corner) + next) % size, 0);
}

// Returns the part of the surface at the fragment that the film of soaked fur covers, and the film's wetness.
vec2 film_here() {
  vec2 sum = vec2(0.0);
  for (int k = 0; k < 4; ++k) {
    float weight;
    vec4 clump = texel_around(uv, k, weight);
    sum += weight * ring_share(mask, clump, uv) * vec2(soaked_share(clump.w), clump.w);
  }
  return vec2(min(sum.x, 1.0), sum.y);
}

// Returns the part of the coverage of the strand with the root q that remains: the fragment shows the strand only where
// the clump at the root draws it. Interpolates between the four texels of the mask around q. rate: f(h) of S Eq. 5.
float consistency(vec2 q, float rate, float per_footprint) {
  float unmoved = in_pixels(q - uv, per_footprint), lost = 0.0;
  for (int k = 0; k < 4; ++k) {
    float weight;
    vec4 clump = texel_around(q, k, weight);
    vec2 from = q - clump.xy;
    float ring = ring_share(mask, clump, q);
    clump.w = clumping(clump.w);
#if CLUMP_READING == CLUMP_CONVERGE
    float share = min(clump.w * rate, 0.98);
#elif CLUMP_READING == CLUMP_DISTANCE
    float share = rate * clump.w * clump.z * inversesqrt(max(dot(from, from), 1e-30));
#else
    float shift = rate * clump.w * clump.z * CLUMP_GAIN;
    float share = shift / (1.0 + shift);
#endif
    lost += weight * mix(unmoved, in_pixels(q - share * from - uv, per_footprint), ring);
  }
  return max(0.0, 1.0 - lost);
}
#endif

void main() {
  vec2 at = uv;
  float rho = 0.0;
  // The clump shifts the texture position by amount * pull. In the layer below, it shifts it by change * pull less. The
  // drawn strand moves by -drawn * pull from the layer below to this one (docs/shells.md, section 6).
  vec2 pull = vec2(0.0);
  float amount = look.x, change = look.y, drawn = look.y, stretch = 1.0;
#ifdef CLUMPS
  // Computes S Eq. 5 and S Algorithm 2. rho is the wetness in the mask at uv. If rho is 0 (dry), the shift is 0.
  vec4 here = textureLod(mask, uv, 0.0);
  vec2 from = uv - here.xy;
  rho = here.w;
#ifdef CONSISTENT_CELLS
  rho = clumping(rho);
#endif
#if CLUMP_READING == CLUMP_CONVERGE
  float near = min(rho * look.x, 0.98), below = min(rho * (look.x - look.y), 0.98);
  stretch = 1.0 / (1.0 - near);
  pull = from;
  amount = near * stretch;
  drawn = (near - below) * stretch;
  change = drawn / (1.0 - below);
#elif CLUMP_READING == CLUMP_DISTANCE
  pull = rho * here.z * from * inversesqrt(max(dot(from, from), 1e-30));
#else
  float factor = rho * here.z * CLUMP_GAIN;
  pull = factor * from;
  drawn = look.y / (1.0 + (look.x - look.y) * factor);
#endif
#ifdef CONSISTENT_CELLS
  // A fragment outside the disc of its texel's clump is dry.
  float depth = here.z - length(from);
#ifdef SOAKED_FUR
  vec2 border = unsoaked_shift(here, from, look.x);
#else
  vec2 border = amount * pull;
#endif
  rho = here.w;
  if (depth < 0.0) {
    rho = 0.0;
    pull = vec2(0.0);
    stretch = 1.0;
  }
#endif
  at = uv + amount * pull;
#ifndef CONSISTENT_CELLS
  vec4 there = textureLod(mask, at, 0.0);
  bool other = dot(from, from) > here.z * here.z || there.w == 0.0;
#ifdef SEPARATE_CELLS
  float cells = 64.0 * float(textureSize(mask, 0).x);
  other = other || floor(cells * there.xy) != floor(cells * here.xy);
#endif
  float kept = rho > 0.0 && other ? 0.0 : 1.0;
#ifdef DISCARD
  if (kept == 0.0) discard;
#endif
#endif
#endif

  vec3 nu = unit(normal), e = view();
  // `level` is log2 of the size of a pixel's footprint on the surface, in texels of mip level 0, plus fur.lod_bias.
  // LEVEL is the part of this sum that is constant in a picture. gl_FragCoord.w is 1/w.
  float level = LEVEL - log2(gl_FragCoord.w / stretch * max(abs(dot(nu, e)), 0.1));
  vec2 texel = fur_texel(at * FUR_SCALE, level);
#ifdef EVEN_SHADE
  texel.g = 0.5;
#endif
#ifdef FRAGMENT_CORRECTION
  texel.r = 1.0 - pow(max(1.0 - texel.r, 1e-30), COVERAGE_POWER);
#endif
#if defined(CLUMPS) && defined(CONSISTENT_CELLS)
  if (here.w > 0.0) {
    float per_footprint = stretch / exp2(level);
    texel.r *= border_share(depth, border, per_footprint) * consistency(at, look.x, per_footprint);
  }
#endif
#if defined(CLUMPS) && !defined(CONSISTENT_CELLS) && !defined(DISCARD)
  texel.r *= kept;
#endif
#ifdef THINNED
  texel.r *= DENSITY;
#endif
#ifdef DENSITY_MAP
  texel.r *= textureLod(density, vec2(at.x, 1.0 - at.y), 0.0).r;
#endif
  float film = 0.0, light_rho = rho;  // film: the part of the coverage that the film of soaked fur has
#ifdef SOAKED_FUR
  if (here.w > 0.0) {
    float h = (look.w + 1.0) / float(LAYERS), share;
    vec2 water = film_here();
    share = water.x;
    float of_film = share * clamp((FILM_HEIGHT - h) * float(LAYERS) + 1.0, 0.0, 1.0), strands = (1.0 - share) * texel.r;
    float total = of_film + strands, inverse = 1.0 / max(total, 1e-30);
    film = of_film * inverse;
    light_rho = mix(rho, water.y, film);
    texel = vec2(total, 0.5 * film + strands * inverse * texel.g);  // texel.g is half of the shade
  }
#endif
#ifdef DISCARD
  if (texel.r == 0.0) discard;
#endif

  vec3 t = rise;
  float exponent = EXPONENT;
#ifdef WET_MODEL
  // W Eq. 4
#if TANGENT_READING == TANGENT_PRINTED
  vec2 drift = change * pull;
  t = drift.x * unit(along_u) + drift.y * unit(along_v) + nu / float(LAYERS);
#else
  float step = TANGENT_READING == TANGENT_STRAND ? -drawn : TANGENT_READING == TANGENT_DRAWN ? -change : change;
  vec2 drift = step * pull;
  t += drift.x * along_u + drift.y * along_v;
#endif
  exponent *= 1.0 + WET_SPECULAR * (rho - 1.0);
#endif
  t = unit(t);
  nu = lit_normal(nu, e);
  vec2 light = vec2(AMBIENT, 0.0);
  add_light(LIGHT_0, INTENSITY_0, t, nu, e, exponent, light);
#if LIGHTS > 1
  add_light(LIGHT_1, INTENSITY_1, t, nu, e, exponent, light);
#endif
  float gamma = look.z;
#ifdef SOAKED_FUR
  float gloss = film_gloss(LIGHT_0, INTENSITY_0, nu, e);
#if LIGHTS > 1
  gloss += film_gloss(LIGHT_1, INTENSITY_1, nu, e);
#endif
  light.y = mix(light.y, FILM_GLOSS * gloss, film);
#endif
#ifdef WET_MODEL
  gamma *= 1.0 - DARKENING * light_rho;  // W Eq. 5
#endif
  vec3 hair = 2.0 * texel.g * textureLod(coat, at, 0.0).rgb;  // texel.g is half of the shade
  // The colour is multiplied by the coverage here, so that all four channels are blended in the same way.
  colour = texel.r * vec4(gamma * (light.x * hair + light.y * SPECULAR), 1.0);
}
