// Computes the wetness mask by Algorithm 1 of S and W, the papers of Silva et al. 2010 (docs/shells.md). Each work-item
// computes one texel. The mask is divided into squares of texels, called buckets. A bucket lists the droplets that may
// cover its texels. The work-item applies the droplets of its texel's bucket in the order of the list.
#include "wet/texel_lists.clh"

// bucket_row: index of the first entry of each bucket in bucket_drop; the last element of bucket_row is the number of
// all entries. surface: x, y, z of the surface point under each texel, in mesh radii.
__kernel void wetness_mask(WetParams s, TABLE(float) droplets, TABLE(int) bucket_row, TABLE(int) bucket_drop,
                           TABLE(float) surface, __global float *mask) {
  FOR_EACH(texel, s.size * s.size) {
    int bucket = bucket_of(&s, texel);
    Clump m = dry_clump();
    for (int k = bucket_row[bucket], end = bucket_row[bucket + 1]; k < end;) {
      Cover c = next_cover(&s, droplets, bucket_drop, surface, texel, &k, end);
      if (c.drop >= 0) m = covered(&s, m, droplets + DROP_COLUMNS * c.drop, droplets[DROP_COLUMNS * c.drop + DROP_WETNESS], c.inside);
    }
    store_clump(mask, texel, m);
  }
}
