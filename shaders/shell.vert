// Transforms a vertex of a layer or of the base surface (S section 4, "vertex shader"; docs/shells.md, sections 3 and
// 4). S = Silva et al. 2010, Curling and Clumping Fur Represented by Texture Layers; W = Silva et al. 2010, Real-Time
// Rendering of Wet Fur. harness/shells/opengl/program.cpp puts the constants and shaders/layers.glsl before this file.
layout(location = 0) in vec3 position;  // in R, the radius of the mesh's bounding sphere
layout(location = 1) in vec2 surface_uv;
layout(location = 2) in vec3 a;         // A: vector from the strand's root to p0, the tip of the upright strand
layout(location = 3) in vec3 b;         // B: vector from the strand's root to its tip p
layout(location = 4) in vec3 curl_u;    // first axis of the curl, in R: (1 - rho) K_alpha u of S Eq. 4
layout(location = 5) in vec3 curl_v;    // second axis of the curl, in R: (1 - rho) K_alpha v
layout(location = 6) in vec3 dx_du;     // dX/du, the derivative of the surface point X, in R per unit of u
layout(location = 7) in vec3 dx_dv;
#ifdef TURNS_MAP
layout(location = 8) in float turn;     // number of the factor of curl.turns
layout(binding = 4) uniform sampler2D turns;  // texel (k, n): h cos(wh) and h sin(wh) of factor k in layer n
#endif

out vec2 uv;
out vec3 normal;
#ifndef SKIN
out vec3 rise;  // dbeta(n): displacement of the layer minus that of the layer below
#ifdef INSTANCED
flat out vec4 look;
#endif
#ifdef WET_MODEL
out vec3 along_u, along_v;
#endif
#endif

void main() {
  vec3 p = position;
  uv = surface_uv;
  normal = a;
#ifndef SKIN
  vec4 bend = LAYER_BEND, step = LAYER_STEP;
#ifdef CONTACT
  p = vec3(0.0);  // the displacement from the base, before colliders push the vertex
#endif
  p += bend.x * a + bend.y * b;  // S Eq. 1
#ifdef TURNS_MAP
  bend.zw = texelFetch(turns, ivec2(int(turn), int(LAYER_LOOK.w)), 0).rg;
#endif
#ifdef CURLS
  p += bend.z * curl_u + bend.w * curl_v;  // S Eq. 4
#endif
#ifdef CONTACT
  p = position + kept_share(position, p) * p;
#endif
  rise = step.x * a + step.y * b;
#ifdef INSTANCED
  look = LAYER_LOOK;
#endif
#ifdef WET_MODEL
  along_u = dx_du;
  along_v = dx_dv;
#endif
#endif
  vec4 at = vec4(p, 1.0);
  vec3 eye = vec3(dot(CAMERA_X, at), dot(CAMERA_Y, at), dot(CAMERA_W, at));
  // Rounds the screen position to a multiple of 1/256 pixel, measured from the picture's centre. Drivers round
  // positions in the same way to find the covered pixels, but interpolate attributes from unrounded positions. After
  // this rounding, coverage and interpolation use the same positions.
  if (eye.z >= NEAR) eye.xy = roundEven(eye.xy / eye.z * GRID) / GRID * eye.z;
  // z is the constant NEAR. After the division by w (eye.z), z is NEAR / w, so the depth test compares 1/w. The y axis
  // of the picture points down, because the top row of pixels is stored first.
  gl_Position = vec4(eye.xy, NEAR, eye.z);
}
