// Expands a strand to a triangle strip. A strip has two vertices for each vertex of the curve.
#if defined(LIGHTS) && !defined(MAP)
#define SHADED   // the picture of a strand with lights
#endif
#ifdef INSTANCED
layout(location = 0) in vec4 first;
layout(location = 1) in vec4 second;
layout(location = 2) in vec4 third;
#ifdef SHADED
layout(location = 3) in vec4 fourth;
#endif
#ifdef SHAPES
layout(location = 4) in vec4 shape;
#endif
#else
layout(std430, binding = 0) readonly buffer Records { vec4 record[]; };
#ifdef SHADED
layout(std430, binding = 1) readonly buffer Lights { vec4 light[]; };
#endif
#ifdef SHAPES
layout(std430, binding = 3) readonly buffer Shapes { vec4 shapes[]; };
#endif
#endif

out vec3 across;
out vec3 colour;
out float depth;

void main() {
#ifdef INSTANCED
  int vertex = gl_VertexID;
#else
  int strand = gl_VertexID / (2 * SEGMENTS + 2), vertex = gl_VertexID % (2 * SEGMENTS + 2);
  vec4 first = record[3 * strand], second = record[3 * strand + 1], third = record[3 * strand + 2];
#ifdef SHADED
  vec4 fourth = light[strand];
#endif
#ifdef SHAPES
  vec4 shape = shapes[strand];
#endif
#endif
  Strand s;
  s.root = first.xyz;
  s.joint = vec3(first.w, second.xy);
  s.tip = vec3(second.zw, third.x);
  s.radius = third.y;
  s.colour = unpackUnorm4x8(floatBitsToUint(third.z)).rgb;
#ifdef LIGHTS
  s.frame = int(floatBitsToUint(third.z) >> 24);
#endif
#ifdef SHADED
  s.height = vec2(third.w, fourth.w);
  s.steady = fourth.xyz;
#endif
#ifdef SHAPES
  s.part = shape;
#endif
  Vertex v = strip_vertex(s, vertex >> 1, (vertex & 1) != 0 ? 1.0 : -1.0);
  across = v.across;
  colour = v.colour;
  depth = v.depth;
  // The strip is cut at the near plane and projected, so that all values are linear on the screen. A strand that is not drawn
  // lies beyond the far plane.
  gl_Position = v.drawn ? vec4(v.at / vec2(HALF_WIDTH, HALF_HEIGHT), 0.0, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
}
