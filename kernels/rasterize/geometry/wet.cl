// Computes what depends on the wetness mask: the dryness of the vertices and the reach of the triangles. Scenes without
// droplets do not need this program.
#include "rasterize/geometry/footprint_reach.clh"
#include "rasterize/geometry/texel_reach.clh"

// Computes the dryness 1 - rho at each vertex, once per wetness mask. rho is the wetness. mask_uv: a column of u, then
// a column of v. With RADIUS_MAP, a third column holds the factor of curl.radius, and the dryness is multiplied by it.
__kernel void vertex_dryness(RasterParams s, TABLE(float) mask_uv, TABLE(float) mask, __global float *dry) {
  int block = (int)get_global_id(0);
  if (block * LANES >= s.vertices) return;
  real2 p = vec2(load_real(mask_uv, block), load_real(mask_uv + s.vertices, block));
  real d = REAL(1.0f) - wetness_at(&s, mask, p);
#if RADIUS_MAP
  d = d * load_real(mask_uv + 2 * (size_t)s.vertices, block);
#endif
  store_real(d, dry, block);
}
