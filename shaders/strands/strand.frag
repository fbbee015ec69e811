// Computes the coverage of a strand in a pixel, and its premultiplied colour.
noperspective in vec3 across;
noperspective in vec3 colour;
layout(location = 0) out vec4 fragment;

void main() {
  float coverage = max(0.0, min(across.x + across.y, 0.5) - max(across.x - across.y, -0.5));
  float alpha = coverage * across.z;
  fragment = vec4(alpha * colour, alpha);
}
