// Values of a layer for its vertices and fragments, with the symbols of docs/frame.md. The host computes three rows per
// layer (harness/shells/opengl/scene_glsl.cpp).
//   `bend` has the factors of A, of B and of the curl's axes u and v in the position of a vertex.
//   `step` has the factors of A and of B in the strand direction dB(n).
//   `look` has f(h_n) and f(h_n) - f(h_(n-1)) for the clump's displacement, gamma(h_n) for the light, and n.
#ifdef INSTANCED
layout(std140, binding = 0) uniform Layers { vec4 layers[3 * LAYERS]; };
#define LAYER_BEND layers[3 * gl_InstanceID]
#define LAYER_STEP layers[3 * gl_InstanceID + 1]
#define LAYER_LOOK layers[3 * gl_InstanceID + 2]
#else
uniform vec4 layer[3];
#define LAYER_BEND layer[0]
#define LAYER_STEP layer[1]
#define LAYER_LOOK layer[2]
#endif
