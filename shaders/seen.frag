// Marks the triangles of a layer that cover a pixel in front of the base surface. gl_PrimitiveID is the number of the
// triangle. The host puts the constants, shaders/layers.glsl and shaders/light.glsl before this file.
layout(early_fragment_tests) in;
layout(std430, binding = 1) writeonly buffer Seen { uint seen[]; };
uniform uint first;  // place of the layer's first triangle

void main() { seen[first + uint(gl_PrimitiveID)] = 1u; }
