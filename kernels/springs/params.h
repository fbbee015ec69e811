// Constants that the host passes to the mass-spring kernels, for OpenCL C and C++. All members have four bytes.
// B = Banisch and Wuethrich 2006, Making Grass and Fur Move. Lengths are in R, the radius of the mesh.
#ifndef PELAGE_TOPOLOGY_PARAMS_H
#define PELAGE_TOPOLOGY_PARAMS_H

typedef struct {
  float length;          // L0, R
  float mass;            // mass m at the top of a stick, kg
  float inverse_mass;    // 1/m, 1/kg
  float stiffness;       // spring constant k of a stick, N/m
  float damping;         // damping along a stick, N s/m
  float edge_stiffness;  // spring constant k of a spring between top masses, N/m
  float edge_damping;    // damping along a spring between top masses, N s/m
  float drag;            // drag coefficient c of the air, N s/m
  float return_weight;   // weight w of the return force in B Eq. 5, N
  float step;            // dt, s
  float most_square;     // square of the length above which a stick counts as diverged, R^2
  int substeps;          // number of substeps in this launch
  int first_step;        // number of the launch's first substep, counted from the start of the simulation
  int first_moment;      // index of the Moment at the time at which this launch starts
  int moving;            // 1: the object rotates, so its frame is not inertial
  int pushed;            // 1: a poke (dynamics.poke) exerts a force on some top masses
  int sticks;            // number of sticks; array entries after the last stick are padding
  int blocks;            // number of sets of 16 blocks; a block is one stick, two sticks or the sticks of a triangle
  int blocks_per_item;   // number of units that a work-item computes; a unit is LANES adjacent blocks
} TopologyParams;

// A Moment holds the values of one time: the forces that are the same for all top masses, and the rotation of the
// object's frame.
typedef struct {
  // Sum of the weight, the inertial force of the object's acceleration, and the drag of the mean wind relative to the
  // object, in newtons.
  float steady_x, steady_y, steady_z;
  float gust_x, gust_y, gust_z;              // amplitude of the drag force of gusts, in newtons
  float gust_sin, gust_cos;                  // sine and cosine of 2 pi f t; f: frequency of the gusts, t: time
  float turn_x, turn_y, turn_z;              // the object's angular velocity, rad/s
  float turn_up_x, turn_up_y, turn_up_z;     // derivative of the angular velocity, rad/s^2
} Moment;

// Column numbers in the table of the sticks' constants. The root and the normal have three columns each. The last two
// columns are the cosine and the sine of the phase of the gusts (Site in equations.clh).
enum { SITE_ROOT = 0, SITE_NORMAL = 3, SITE_PHASE_COS = 6, SITE_PHASE_SIN, SITE_COLUMNS };

// Rows of the partial sums of the conjugate gradients for A x = b: r.z of even iterations, r.z of odd iterations, d.Ad,
// r.r and b.b. r is the residual, z is the preconditioned residual, and d is the search direction.
enum { SUM_RZ_EVEN, SUM_RZ_ODD, SUM_DAD, SUM_RR, SUM_BB, SUM_ROWS };

#endif
