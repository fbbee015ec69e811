// Constants that the host passes to the strand simulation, for OpenCL C and C++. All members have four bytes.
// R is the radius of the mesh.
#ifndef PELAGE_SIMULATE_PARAMS_H
#define PELAGE_SIMULATE_PARAMS_H

typedef struct {
  float length;                        // length L0 of a strand, R
  float stiffness;                     // k, N/m
  float drag;                          // c, N s/m
  float inverse_mass;                  // 1/m, 1/kg
  float step;                          // dt, s
  float weight_x, weight_y, weight_z;  // m g, N
  float wind_x, wind_y, wind_z;        // force of the mean wind, in newtons
  float gust;                          // amplitude of the gusts as a fraction of the mean wind
  // Number of values in each column of the two arrays (the strands' constants and the strands' state): the number of
  // strands, rounded up to a multiple of 16.
  int stride;
  int substeps;
} SimulateParams;

// Columns of the array of the strands' constants: the normal, the anchor (the tip's rest position), and the cosine and
// the sine of the gust's phase.
enum { NORMAL_X, NORMAL_Y, NORMAL_Z, ANCHOR_X, ANCHOR_Y, ANCHOR_Z, PHASE_COS, PHASE_SIN, VIRTUAL_STRAND_COLUMNS };
// Columns of the array of the strands' state: three columns for the position of the strand's mass relative to its root,
// and three columns for the mass's velocity.
enum { TIP_X, TIP_Y, TIP_Z, SPEED_X, SPEED_Y, SPEED_Z, STATE_COLUMNS };

#endif
