// What the host tells the wetness mask; read by OpenCL C and by C++. Four-byte members only.
#ifndef PELAGE_WET_PARAMS_H
#define PELAGE_WET_PARAMS_H

typedef struct {
  int size;    // texels per side
  int bucket;  // texels per side of a bucket of droplets
} WetParams;

// A droplet in the droplet array.
enum { DROP_U, DROP_V, DROP_RADIUS, DROP_WETNESS, DROP_X, DROP_Y, DROP_Z, DROP_REACH, DROP_COLUMNS };

#endif
