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
  int k = bucket_row[bucket], end = bucket_row[bucket + 1];
  while (k < end) {
    // The nearest of a droplet and its repetitions across UV seams, in radii from the centre.
    TABLE(float) nearest = 0;
    float least = INFINITY;
    bool inside = false;
    float number = droplets[DROP_COLUMNS * bucket_drop[k] + DROP_NUMBER];
    for (; k < end && droplets[DROP_COLUMNS * bucket_drop[k] + DROP_NUMBER] == number; ++k) {
      TABLE(float) d = droplets + DROP_COLUMNS * bucket_drop[k];
      float du = u - d[DROP_U], dv = v - d[DROP_V];
      float dx = surface[3 * texel] - d[DROP_X], dy = surface[3 * texel + 1] - d[DROP_Y], dz = surface[3 * texel + 2] - d[DROP_Z];
      float from_centre = sqrt(fma(dv, dv, du * du));
      bool near = sqrt(fma(dz, dz, fma(dy, dy, dx * dx))) <= d[DROP_REACH];
      if (!near || from_centre > d[DROP_RADIUS] + s.rim || from_centre / d[DROP_RADIUS] >= least) continue;
      nearest = d;
      least = from_centre / d[DROP_RADIUS];
      inside = from_centre <= d[DROP_RADIUS];
    }
    // The disc may touch a texel without covering the texel's centre. The wettest droplets come first, so a droplet that
    // dries leaves no trace in a texel in which clumps meet.
    if (least == INFINITY || (!inside && m.wetness > 0.0f)) continue;
    Clump drop;
    drop.centre = vec2(nearest[DROP_U], nearest[DROP_V]);
    drop.radius = nearest[DROP_RADIUS];
    drop.wetness = nearest[DROP_WETNESS];
    if (inside)
      m = blend_droplet(m, drop, s.overlap, s.margin);
    else
      m = drop;
  }
  mask[4 * texel] = m.centre.x;
  mask[4 * texel + 1] = m.centre.y;
  mask[4 * texel + 2] = m.radius;
  mask[4 * texel + 3] = m.wetness;
}
