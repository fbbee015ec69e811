// Computes the wetness mask by Algorithm 1 of S and W, the papers of Silva et al. 2010 (docs/frame.md). Each work-item
// computes one texel. The mask is divided into squares of texels, called buckets. A bucket lists the droplets that may
// cover its texels. The work-item applies the droplets of its texel's bucket in the order of the list.
#include "wet/equations.clh"

// bucket_row: index of the first entry of each bucket in bucket_drop; the last element of bucket_row is the number of
// all entries. surface: x, y, z of the surface point under each texel, in mesh radii.
__kernel void wetness_mask(WetParams s, TABLE(float) droplets, TABLE(int) bucket_row, TABLE(int) bucket_drop,
                           TABLE(float) surface, __global float *mask) {
  int x = (int)get_global_id(0), y = (int)get_global_id(1);
  if (x >= s.size || y >= s.size) return;
  int texel = y * s.size + x;
  float u = ((float)x + 0.5f) / (float)s.size, v = ((float)y + 0.5f) / (float)s.size;
  int buckets = (s.size + s.bucket - 1) / s.bucket;
  int bucket = (y / s.bucket) * buckets + x / s.bucket;
  Clump m;
  m.centre = vec2(0.0f, 0.0f);
  m.radius = 0.0f;
  m.wetness = 0.0f;
  for (int k = bucket_row[bucket]; k < bucket_row[bucket + 1]; ++k) {
    TABLE(float) d = droplets + DROP_COLUMNS * bucket_drop[k];
    float du = u - d[DROP_U], dv = v - d[DROP_V];
    float dx = surface[3 * texel] - d[DROP_X], dy = surface[3 * texel + 1] - d[DROP_Y], dz = surface[3 * texel + 2] - d[DROP_Z];
    float from_centre = sqrt(fma(dv, dv, du * du));
    bool inside = from_centre <= d[DROP_RADIUS], near = sqrt(fma(dz, dz, fma(dy, dy, dx * dx))) <= d[DROP_REACH];
    // The disc may touch a texel without covering the texel's centre. The wettest droplets come first, so a droplet that
    // dries leaves no trace in a texel in which clumps meet.
    bool touched = s.consistent && from_centre <= d[DROP_RADIUS] + s.half_diagonal && m.wetness == 0.0f;
    if (!near || !(inside || touched)) continue;
    Clump drop;
    drop.centre = vec2(d[DROP_U], d[DROP_V]);
    drop.radius = d[DROP_RADIUS];
    drop.wetness = d[DROP_WETNESS];
    if (inside)
      m = blend_droplet(m, drop, s.overlap, s.consistent ? s.half_diagonal : 0.0f);
    else
      m = drop;
  }
  mask[4 * texel] = m.centre.x;
  mask[4 * texel + 1] = m.centre.y;
  mask[4 * texel + 2] = m.radius;
  mask[4 * texel + 3] = m.wetness;
}
