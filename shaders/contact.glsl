// Colliders that push the layers (docs/colliders.md). The host defines CONTACT with the number of spheres and capsules, and
// CONTACT_MESH if there is a mesh among the colliders. harness/shells/opengl/contact.cpp sets the uniforms.
#ifdef CONTACT
uniform vec4 collider_from[CONTACT + 1];  // one end of a capsule's axis, and the radius; radius 0: no collider at this time
uniform vec4 collider_axis[CONTACT + 1];  // the axis as a unit vector, and its length

// The part of a line start + s along that is in a ball around the origin: from x to y; empty if x >= y.
vec2 in_ball(vec3 start, vec3 along, float radius) {
  float square = max(dot(along, along), 1e-20), b = dot(start, along);
  float d = b * b - square * (dot(start, start) - radius * radius);
  return d > 0.0 ? (vec2(-1.0, 1.0) * sqrt(d) - b) / square : vec2(1.0, -1.0) * 1e30;
}

vec2 joined(vec2 a, vec2 b) { return b.x < b.y ? vec2(min(a.x, b.x), max(a.y, b.y)) : a; }

vec2 in_capsule(vec3 root, vec3 along, vec4 from, vec4 axis) {
  vec3 start = root - from.xyz;
  vec2 part = in_ball(start, along, from.w);
  if (axis.w == 0.0) return part;
  part = joined(part, in_ball(start - axis.w * axis.xyz, along, from.w));
  float y = dot(start, axis.xyz), rise = dot(along, axis.xyz);
  vec2 side = in_ball(start - y * axis.xyz, along - rise * axis.xyz, from.w);
  rise = abs(rise) > 1e-12 ? rise : 1e-12;
  vec2 ends = vec2(-y, axis.w - y) / rise;
  return joined(part, vec2(max(side.x, min(ends.x, ends.y)), min(side.y, max(ends.x, ends.y))));
}

#ifdef CONTACT_MESH
layout(binding = 5) uniform sampler3D field;  // distances at the nodes of a grid
uniform vec4 mesh_place;                      // position of the mesh, and its scale; scale 0: no mesh at this time
uniform vec4 mesh_axes[3];                    // axes of the mesh
uniform vec4 mesh_grid;                       // position of the first node, and 1 / distance of adjacent nodes

// The distance of the point p from the mesh, below 0 inside, by trilinear interpolation.
float mesh_distance(vec3 p) {
  ivec3 nodes = textureSize(field, 0);
  p = (p - mesh_place.xyz) * mat3(mesh_axes[0].xyz, mesh_axes[1].xyz, mesh_axes[2].xyz) / mesh_place.w;
  vec3 at = clamp((p - mesh_grid.xyz) * mesh_grid.w, vec3(0.0), vec3(nodes - 1));
  ivec3 low = min(ivec3(at), nodes - 2);
  vec3 t = at - vec3(low);
  float value[8];
  for (int k = 0; k < 8; ++k) value[k] = texelFetch(field, low + ivec3(k & 1, k >> 1 & 1, k >> 2), 0).r;
  vec4 row = mix(vec4(value[0], value[2], value[4], value[6]), vec4(value[1], value[3], value[5], value[7]), t.x);
  vec2 face = mix(row.xz, row.yw, t.y);
  return mesh_place.w * mix(face.x, face.y, t.z);
}

// The greatest tested share, at most `share`, at which root + share * along is outside the mesh.
float outside_mesh(vec3 root, vec3 along, float share) {
  if (mesh_distance(root + share * along) >= 0.0) return share;
  float low = 0.0, high = 0.0;
  for (int k = 1; k < 16; ++k) {
    low = share * (1.0 - float(k) / 16.0);
    high = share * (1.0 - float(k - 1) / 16.0);
    if (mesh_distance(root + low * along) >= 0.0) break;
    low = high = 0.0;
  }
  if (high == 0.0) return 0.0;
  for (int k = 0; k < 8; ++k) {
    float middle = 0.5 * (low + high);
    if (mesh_distance(root + middle * along) >= 0.0)
      low = middle;
    else
      high = middle;
  }
  return low;
}
#endif

// The share of its displacement that a vertex keeps: it moves towards its root until it is outside all colliders.
float kept_share(vec3 root, vec3 along) {
  float share = 1.0;
  for (int pass = 0; pass < CONTACT + 1; ++pass) {
    float before = share;
    for (int i = 0; i < CONTACT; ++i) {
      if (collider_from[i].w == 0.0) continue;
      vec2 part = in_capsule(root, along, collider_from[i], collider_axis[i]);
      if (share > part.x && share < part.y) share = max(part.x, 0.0);
    }
#ifdef CONTACT_MESH
    if (mesh_place.w > 0.0) share = outside_mesh(root, along, share);
#endif
    if (share == before) break;
  }
  return share;
}
#endif
