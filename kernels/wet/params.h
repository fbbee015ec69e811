// Constants that the host passes to the kernel of the wetness mask, for OpenCL C and C++. All members have four bytes.
#ifndef PELAGE_WET_PARAMS_H
#define PELAGE_WET_PARAMS_H

typedef struct {
  int size;    // number of texels per side of the mask
  int bucket;  // side, in texels, of a bucket (a square part of the mask that has its own list of droplets)
  int overlap; // 1: a droplet is blended with all wet texels of its disc (wetness.blend = "overlap")
  float rim;  // a droplet touches texels whose centres are at most this far outside its disc, in UV; 0: none
  float margin;  // times 4 alpha (1 - alpha), it is added to a blended radius, in UV
} WetParams;

// Columns of the droplet array, which has one row per droplet. DROP_U, DROP_V and DROP_RADIUS are the centre and the
// radius of the droplet's disc in UV. DROP_X, DROP_Y and DROP_Z are the position of the disc's centre in space. The
// droplet covers a texel only if the texel's distance from this position is at most DROP_REACH. Adjacent droplets with
// equal DROP_NUMBER are one droplet and its repetitions across UV seams.
enum { DROP_U, DROP_V, DROP_RADIUS, DROP_WETNESS, DROP_X, DROP_Y, DROP_Z, DROP_REACH, DROP_NUMBER,
       DROP_COLUMNS };

#endif
