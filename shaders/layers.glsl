// Values of a layer that its vertices and fragments need. The host computes three rows of values per layer
// (harness/shells/opengl/scene_glsl.cpp). docs/shells.md defines the symbols below.
//   `bend`: the vertex is displaced by bend.x A + bend.y B + bend.z u + bend.w v, where u and v are the curl's axes.
//   `step`: the strand direction dbeta(n) is step.x A + step.y B.
//   `look`: look.x is f(h_n) and look.y is f(h_n) - f(h_(n-1)), both for the displacement by clumps. look.z is
//   gamma or gamma_occ, a factor of the light. look.w is n, the number of the layer.
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
