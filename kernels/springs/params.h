// What the host tells the mass-spring kernels; read by OpenCL C and by C++. Four-byte members only.
#ifndef PELAGE_TOPOLOGY_PARAMS_H
#define PELAGE_TOPOLOGY_PARAMS_H

typedef struct {
  float length;          // L0, R
  float mass;            // m of a top, kg
  float inverse_mass;    // 1/m, 1/kg
  float stiffness;       // k of a stick, N/m
  float damping;         // of a stick along itself, N s/m
  float edge_stiffness;  // k of a spring between tops, N/m
  float edge_damping;    // of it along itself, N s/m
  float drag;            // c against the air, N s/m
  float return_weight;   // w of Eq. 5, N
  float step;            // dt, s
  float most_square;     // a stick whose squared length is beyond this has diverged, R^2
  int substeps;          // of this launch
  int first_step;        // number of its first substep
  int first_moment;      // where the moments of its start lie in their table
  int moving;            // 1: the object turns, the frame is not an inertial one
  int pushed;            // 1: the array of local forces is not all zero
  int sticks;            // rows beyond these belong to nothing
  int blocks;            // slices of 16 sticks, or of 16 triangles on separable prisms
  int blocks_per_item;   // that one work-item goes through, in units of LANES / 16
} TopologyParams;

// The outside world at an instant, in the object's own frame: what it does to a top that rests there.
typedef struct {
  float steady_x, steady_y, steady_z;        // weight less the object's acceleration, drag of the mean wind, N
  float gust_x, gust_y, gust_z;              // amplitude of the gusts' drag, N
  float gust_sin, gust_cos;                  // of 2 pi f t
  float turn_x, turn_y, turn_z;              // the object's angular velocity, rad/s
  float turn_up_x, turn_up_y, turn_up_z;     // the derivative of that, rad/s^2
} Moment;

// Columns of what a stick never changes; root and normal are three each, phases of the gust at the root.
enum { SITE_ROOT = 0, SITE_NORMAL = 3, SITE_PHASE_COS = 6, SITE_PHASE_SIN, SITE_COLUMNS };

// Rows of partial sums of the conjugate gradients: r.z of even and odd iterations, d.Ad, r.r, b.b.
enum { SUM_RZ_EVEN, SUM_RZ_ODD, SUM_DAD, SUM_RR, SUM_BB, SUM_ROWS };

#endif
