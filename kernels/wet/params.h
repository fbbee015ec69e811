// Constants that the host passes to the kernel of the wetness mask, for OpenCL C and C++. All members have four bytes.
#ifndef PELAGE_WET_PARAMS_H
#define PELAGE_WET_PARAMS_H

typedef struct {
  int size;    // number of texels per side of the mask
  int bucket;  // side, in texels, of a bucket (a square part of the mask that has its own list of droplets)
} WetParams;

// Columns of the droplet array, which has one row per droplet: u, v and radius (in UV) of the droplet's disc,
// the wetness, the position of the disc's centre in space, and the greatest distance in space from this
// centre at which the droplet covers a texel.
enum { DROP_U, DROP_V, DROP_RADIUS, DROP_WETNESS, DROP_X, DROP_Y, DROP_Z, DROP_REACH, DROP_COLUMNS };

#endif
