// The colour of the skin with the alpha 1, and its view depth in R.
in vec3 colour;
in float depth;
layout(location = 0) out vec4 fragment;
layout(location = 1) out float view_depth;

void main() {
  fragment = vec4(colour, 1.0);
  view_depth = depth;
}
