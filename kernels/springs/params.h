// Constants that the host passes to the mass-spring kernels, for OpenCL C and C++. All members have four bytes.
#ifndef PELAGE_TOPOLOGY_PARAMS_H
#define PELAGE_TOPOLOGY_PARAMS_H

typedef struct {
  float length;          // L0, R
  float mass;            // m of a top, kg
  float inverse_mass;    // 1/m, 1/kg
  float stiffness;       // k of a stick, N/m
  float damping;         // damping of a stick along itself, N s/m
  float edge_stiffness;  // k of a spring between tops, N/m
  float edge_damping;    // damping of a spring between tops along itself, N s/m
  float drag;            // c of the drag against the air, N s/m
  float return_weight;   // w of B Eq. 5, N
  float step;            // dt, s
  float most_square;     // a stick diverges when its squared length exceeds this, R^2
  int substeps;          // number of substeps in this launch
  int first_step;        // number of the launch's first substep
  int first_moment;      // entry in the table of moments at which the launch starts
  int moving;            // 1: the object turns, so its frame is not inertial
  int pushed;            // 1: some local forces are not zero
  int sticks;            // number of sticks; rows beyond it are padding
  int blocks;            // number of slices of 16 sticks, or of 16 triangles on separable prisms
  int blocks_per_item;   // number of units (LANES neighbours) that a work-item computes
} TopologyParams;

// The forces on a top at rest in the object's frame, and the motion of this frame, at one moment.
typedef struct {
  float steady_x, steady_y, steady_z;        // weight, inertia of the object's acceleration, drag of the mean wind; N
  float gust_x, gust_y, gust_z;              // amplitude of the gusts' drag, N
  float gust_sin, gust_cos;                  // sine and cosine of 2 pi f t
  float turn_x, turn_y, turn_z;              // the object's angular velocity, rad/s
  float turn_up_x, turn_up_y, turn_up_z;     // derivative of the angular velocity, rad/s^2
} Moment;

// Columns of the constants of a stick: root and normal have three each; the phase is that of the gust at the root.
enum { SITE_ROOT = 0, SITE_NORMAL = 3, SITE_PHASE_COS = 6, SITE_PHASE_SIN, SITE_COLUMNS };

// Rows of the partial sums of the conjugate gradients: r.z of even and odd iterations, d.Ad, r.r, b.b.
enum { SUM_RZ_EVEN, SUM_RZ_ODD, SUM_DAD, SUM_RR, SUM_BB, SUM_ROWS };

#endif
