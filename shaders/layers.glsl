// Values of a layer for its vertices and fragments, with the symbols of docs/frame.md. The host computes three rows per
// layer (harness/shells/opengl/scene_glsl.cpp).
//   bend holds the factors of A, B and of the curl's axes u and v.
//   step holds the factors of A and B in dB(n).
//   look holds f(h_n), f(h_n) - f(h_(n-1)), gamma(h_n) and n.
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
