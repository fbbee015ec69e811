// The skin below the strands (docs/strands.md, section Skin). ROW_X, ROW_Y and ROW_W are the rows of the camera, FILL the
// coefficients of the fill lights (irradiance_of() in harness/strands/drawing/drawing.hpp), and OBJECT_LIGHT is the unit vector
// towards the key light in the object's frame.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 base;

out vec3 colour;
out float depth;

vec3 fill_light(vec3 n) {
  vec3 sum = FILL[0] + n.y * FILL[1] + n.z * FILL[2] + n.x * FILL[3] + n.x * n.y * FILL[4] + n.y * n.z * FILL[5] +
             (3.0 * n.z * n.z - 1.0) * FILL[6] + n.x * n.z * FILL[7] + (n.x * n.x - n.y * n.y) * FILL[8];
  return max(sum, vec3(0.0));
}

void main() {
  vec4 p = vec4(position, 1.0);
  vec3 view = vec3(dot(ROW_X, p), dot(ROW_Y, p), dot(ROW_W, p));
  float key = INTENSITY * key_light(view) * max(0.0, dot(normal, OBJECT_LIGHT));
  colour = (1.0 - SKIN_SHADOW) * base * (AMBIENT + fill_light(normal) + key);
  depth = view.z;
  gl_Position = vec4(view.xy / vec2(HALF_WIDTH, HALF_HEIGHT), NEAR, view.z);
}
