// The strip of a strand (docs/strands.md, section Drawing). harness/strands/opengl/shaders.cpp puts the constants before
// this file: PIXEL is the side of a pixel at the view depth 1 in R, HALF_WIDTH and HALF_HEIGHT half of the picture's size in
// pixels, NEAR the view depth of the near plane. The other constants are those of `Look` in harness/strands/drawing/drawing.hpp.
// LIGHTS: the look has more than a key light and ambient light. MAP: an opacity map is drawn. Its projection is parallel, and
// PIXEL is the side of a texel in R.

// The control points of the strand: X, Y and W (the view depth in R). X and Y are W times the distance from the image centre
// in pixels.
struct Strand {
  vec3 root, joint, tip;
  float radius;  // half of the width at the root, divided by PIXEL
  vec3 colour;
#ifdef LIGHTS
  int frame;     // of the film strip
#ifndef MAP
  vec2 height;   // of joint and tip above the skin, divided by SKIN_SHADOW_HEIGHT times the length
  vec3 steady;   // light that does not change along the strand
#endif
#endif
#ifdef SHAPES
  vec4 part;     // of a strand of a file: its start and end on the strand, the width at the end divided by that at the start,
                 // and the height of the start above the skin, divided as `height` is
#endif
};

// The parameter of the strand, from 0 (root) to 1 (tip), at the parameter t of the curve.
float on_strand(Strand s, float t) {
#ifdef SHAPES
  return mix(s.part.x, s.part.y, t);
#else
  return t;
#endif
}

vec3 curve(Strand s, float t) {
  float r = 1.0 - t;
  return r * r * s.root + 2.0 * r * t * s.joint + t * t * s.tip;
}

float per_depth(float depth) {
#ifdef MAP
  return 1.0;
#else
  return 1.0 / depth;
#endif
}

vec2 place(Strand s, float t) {
  vec3 p = curve(s, t);
  return p.xy * per_depth(p.z);
}

vec2 direction(vec2 a, vec2 b) {
  vec2 step = b - a;
  float l = length(step);
  return l < 1.0 / 1024.0 ? vec2(0.0) : step / l;
}

vec3 camera_axes(vec3 v) { return vec3(v.xy * PIXEL, v.z); }

// The number of segments of the strip (docs/strands.md, section Segments).
int segments_of(Strand s) {
#ifdef SHAPES
  float share = float(OWN_SEGMENTS != 0 ? 3 : STRAND_SEGMENTS) * (s.part.y - s.part.x);
  int fewest = min(max(int(ceil(share - 1.0 / 1024.0)), OWN_SEGMENTS != 0 ? 1 : 2), SEGMENTS);
#else
  int fewest = OWN_SEGMENTS != 0 ? min(3, SEGMENTS) : SEGMENTS;
#endif
#if OWN_SEGMENTS
  float nearest = min(s.root.z, min(s.joint.z, s.tip.z));
  if (nearest < NEAR) return SEGMENTS;
  float pixels = length(camera_axes(s.root - 2.0 * s.joint + s.tip)) / (nearest * PIXEL);
  return clamp(int(ceil(sqrt(min(pixels, 1024.0)))), fewest, SEGMENTS);
#else
  return fewest;
#endif
}

// A factor of the fur layer. The first five samples of a frame contain them: opacity, taper, gloss, exponent of the highlight and
// shadow of the skin.
#define OWN_OPACITY 0
#define OWN_TAPER 1
#define OWN_GLOSS 2
#define OWN_EXPONENT 3
#define OWN_SKIN_SHADOW 4
float own(Strand s, int factor) {
#ifdef LAYERS
  return film[8 * s.frame + factor].w;
#else
  return 1.0;
#endif
}

// Luminance, gloss and opacity of the film strip.
vec3 film_at(Strand s, float t) {
#ifdef LIGHTS
  float at = 7.0 * t;
  int first = min(int(at), 6);
  vec3 factors = mix(film[8 * s.frame + first].xyz, film[8 * s.frame + first + 1].xyz, at - float(first));
  return factors * vec3(1.0, own(s, OWN_GLOSS), own(s, OWN_OPACITY));
#else
  return vec3(1.0);
#endif
}

#ifndef MAP
// Light of Kajiya and Kay on a hair, and the lights of section Light. key: part of the key light that arrives.
vec3 hair_light(Strand s, float t, vec3 film_factors, float key) {
  vec3 slope = camera_axes(mix(s.joint - s.root, s.tip - s.joint, t)), start = camera_axes(s.joint - s.root);
  vec3 along = length(slope) < length(start) / 1024.0 ? start : slope;
  vec3 tangent = length(along) > 0.0 ? normalize(along) : vec3(0.0);
  vec3 from_eye = normalize(camera_axes(s.joint));
  float along_light = dot(tangent, LIGHT), along_eye = dot(tangent, from_eye);
  float across_light = length(cross(tangent, LIGHT)), across_eye = length(cross(tangent, from_eye));
  float mirror = max(0.0, along_light * along_eye + across_light * across_eye);
  float shine = INTENSITY * key * film_factors.y * pow(mirror, EXPONENT * own(s, OWN_EXPONENT)), diffuse = INTENSITY * key * across_light;
#ifdef LIGHTS
  float height = 2.0 * t * (1.0 - t) * s.height.x + t * t * s.height.y;
#ifdef SHAPES
  height += (1.0 - t) * (1.0 - t) * s.part.w;
#endif
  height = clamp(height, 0.0, 1.0);
  float bright = film_factors.x * (1.0 - SKIN_SHADOW * own(s, OWN_SKIN_SHADOW) * (1.0 - height));
  return bright * (s.steady + s.colour * diffuse + SPECULAR * shine);
#else
  return s.colour * (AMBIENT + diffuse) + SPECULAR * shine;
#endif
}
#endif

// A vertex of the strip: k is the number of the curve's vertex, and side is -1 or 1. The strip is half a pixel wider than the
// strand on each side, so that it contains all pixels that the strand touches.
struct Vertex {
  vec2 at;         // pixels from the image centre
  float depth;
  vec3 across;     // distance from the strand's centre line, half of the width (both in pixels), alpha
  vec3 colour;
  bool drawn;      // false: the strand has no part in front of the near plane; the other values are 0
};

// The part of the curve that is in front of the near plane (docs/strands.md, section Curve); (0, 0) if there is none.
vec2 visible_part(Strand s, int segments) {
#ifdef MAP
  return vec2(0.0, 1.0);
#else
  if (min(s.root.z, min(s.joint.z, s.tip.z)) >= NEAR) return vec2(0.0, 1.0);
  bool root_in_front = s.root.z >= NEAR;
  if (!root_in_front && s.tip.z < NEAR) return vec2(0.0);
  int first = segments + 1, last = -1;
  for (int k = 0; k <= segments; ++k)
    if (curve(s, float(k) / float(segments)).z < NEAR) {
      first = min(first, k);
      last = k;
    }
  if (last < 0) return vec2(0.0, 1.0);
  float front = float(root_in_front ? first - 1 : last + 1) / float(segments);
  float behind = float(root_in_front ? first : last) / float(segments);
  for (int i = 0; i < 24; ++i) {
    float middle = 0.5 * (front + behind);
    if (curve(s, middle).z >= NEAR) front = middle; else behind = middle;
  }
  return root_in_front ? vec2(0.0, front) : vec2(front, 1.0);
#endif
}

Vertex strip_vertex(Strand s, int k, float side) {
  int segments = segments_of(s);
  k = min(k, segments);   // the other vertices of the strip lie at the tip
  vec2 part = visible_part(s, segments);
  float spacing = (part.y - part.x) / float(segments), t = part.x + float(k) * spacing;
  vec3 p = curve(s, t);
  if (part.y == 0.0) return Vertex(vec2(0.0), 0.0, vec3(0.0), vec3(0.0), false);
  vec2 here = p.xy * per_depth(p.z);
  vec2 before = k > 0 ? direction(place(s, t - spacing), here) : vec2(0.0);
  vec2 behind = k < segments ? direction(here, place(s, t + spacing)) : vec2(0.0);
  vec2 mitre = before + behind;
  float square = dot(mitre, mitre);
  mitre = square > 1e-12 ? mitre * inversesqrt(square) : vec2(0.0);
  vec2 along = k > 0 ? before : behind;
  Vertex v;
  float along_strand = on_strand(s, t);
  float radius = s.radius * (1.0 - TAPER * own(s, OWN_TAPER) * along_strand) * per_depth(p.z);
#ifdef SHAPES
  radius *= mix(1.0, s.part.z, t);
#endif
  // A mitre of more than 90 degrees is shortened.
  float stretch = 1.0 / max(dot(mitre, along), 0.70710678);
  float distance = side * (radius + 0.5);
  vec3 factors = film_at(s, along_strand);
  v.at = here + vec2(-mitre.y, mitre.x) * (distance * stretch);
  v.depth = p.z;
  v.across = vec3(distance, radius, OPACITY * factors.z * (1.0 - along_strand * along_strand * along_strand));
#ifdef MAP
  v.colour = vec3(0.0);
#else
  v.colour = hair_light(s, t, factors, key_light(p));
#endif
  v.drawn = true;
  return v;
}
