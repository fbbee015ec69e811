// The strip of a strand (docs/strands.md, section Drawing). harness/strands/opengl/ribbons.cpp puts the constants before
// this file: PIXEL is the side of a pixel at the view depth 1 in R, HALF_WIDTH and HALF_HEIGHT half of the picture's size in
// pixels, NEAR the view depth of the near plane. The other constants are those of `Look` in harness/strands/drawing/drawing.hpp.

// The control points of the strand: X, Y and W (the view depth in R). X and Y are W times the distance from the image centre
// in pixels.
struct Strand {
  vec3 root, joint, tip;
  float radius;  // half of the width at the root, divided by PIXEL
  vec3 colour;
};

vec3 curve(Strand s, float t) {
  float r = 1.0 - t;
  return r * r * s.root + 2.0 * r * t * s.joint + t * t * s.tip;
}

vec2 place(Strand s, float t) {
  vec3 p = curve(s, t);
  return p.xy / p.z;
}

vec2 direction(vec2 a, vec2 b) {
  vec2 step = b - a;
  float l = length(step);
  return l < 1.0 / 1024.0 ? vec2(0.0) : step / l;
}

vec3 camera_axes(vec3 v) { return vec3(v.xy * PIXEL, v.z); }

// Light of Kajiya and Kay on a hair.
vec3 hair_light(Strand s, float t) {
  vec3 tangent = normalize(camera_axes(mix(s.joint - s.root, s.tip - s.joint, t)));
  vec3 from_eye = normalize(camera_axes(s.joint));
  float along_light = dot(tangent, LIGHT), along_eye = dot(tangent, from_eye);
  float across_light = length(cross(tangent, LIGHT)), across_eye = length(cross(tangent, from_eye));
  float mirror = max(0.0, along_light * along_eye + across_light * across_eye);
  return s.colour * (AMBIENT + INTENSITY * across_light) + SPECULAR * (INTENSITY * pow(mirror, EXPONENT));
}

// A vertex of the strip: k is the number of the curve's vertex, and side is -1 or 1. The strip is half a pixel wider than the
// strand on each side, so that it contains all pixels that the strand touches.
struct Vertex {
  vec2 at;         // pixels from the image centre
  float depth;
  vec3 across;     // distance from the strand's centre line, half of the width (both in pixels), alpha
  vec3 colour;
};

Vertex strip_vertex(Strand s, int k, float side) {
  float t = float(k) / float(SEGMENTS);
  vec3 p = curve(s, t);
  vec2 here = p.xy / p.z;
  vec2 before = k > 0 ? direction(place(s, float(k - 1) / float(SEGMENTS)), here) : vec2(0.0);
  vec2 behind = k < SEGMENTS ? direction(here, place(s, float(k + 1) / float(SEGMENTS))) : vec2(0.0);
  vec2 mitre = before + behind;
  float square = dot(mitre, mitre);
  mitre = square > 1e-12 ? mitre * inversesqrt(square) : vec2(0.0);
  vec2 along = k > 0 ? before : behind;
  Vertex v;
  float radius = s.radius * (1.0 - TAPER * t) / p.z;
  // A mitre of more than 90 degrees is shortened.
  float stretch = 1.0 / max(dot(mitre, along), 0.70710678);
  float distance = side * (radius + 0.5);
  v.at = here + vec2(-mitre.y, mitre.x) * (distance * stretch);
  v.depth = p.z;
  v.across = vec3(distance, radius, OPACITY * (1.0 - t * t * t));
  v.colour = hair_light(s, t);
  return v;
}
