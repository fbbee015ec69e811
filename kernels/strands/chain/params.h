// Constants that the host passes to the kernels of the strands' simulation, for OpenCL C and C++. All members have four
// bytes. docs/strands.md defines the model.
//
// A strand is a chain of two rigid segments. The first segment joins the root to the joint, the second the joint to the
// tip. Each strand has its own units: its length L is the unit of length, and its mass is the unit of mass. R is the
// radius of the mesh's bounding sphere. d1 and d2 are the damping coefficients of docs/strands.md, section "Chains".
#ifndef PELAGE_STRANDS_CHAIN_PARAMS_H
#define PELAGE_STRANDS_CHAIN_PARAMS_H

typedef struct {
  float first, second;      // lengths of the two segments, L; their sum is 1
  // Inertia of the chain, in units of the strand's mass times L^2. m1 is the mass at the joint, and m2 the mass at the
  // tip. l1 and l2 are the lengths of the segments.
  float inertia_first;      // A = (m1 + m2) l1^2
  float inertia_second;     // B = m2 l2^2
  float inertia_both;       // C = m2 l1 l2
  float lever_first;        // l1 (m1 + m2): torque on the first segment per 1 L/s^2 of acceleration
  float lever_second;       // l2 m2: torque on the second segment per 1 L/s^2 of acceleration
  float air_first;          // l1 (c1 + c2), 1/s; c1 and c2 are the drag coefficients of joint and tip
  float air_second;         // l2 c2, 1/s
  // The three coefficients of damping, and their parts: those of the drag, d1 + d2, and d2.
  float damping_first;      // (c1 + c2) l1^2 + d1 + d2, 1/s: damping of the first segment by its own rate
  float damping_second;     // c2 l2^2 + d2, 1/s: damping of the second segment by its own rate
  float damping_both;       // c2 l1 l2 - d2, 1/s: damping of one segment by the rate of the other
  float drag_first, drag_second, drag_both;
  float joint_damping, tip_damping;
  float step;               // h, duration of a substep, s
  int substeps;             // number of substeps in this launch
  int first_moment;         // index of the ChainMoment of this launch's first substep
  int slices;               // number of slices of 16 strands
  int units_per_item;       // number of units of LANES strands that a work-item computes
  // The distance field of the body (docs/strands.md, section Body). Only used if CHAIN_BODY is 1.
  float field_x, field_y, field_z;     // position of the first node, R
  float per_cell;                      // 1 divided by the distance between adjacent nodes, 1/R
  int nodes_x, nodes_y, nodes_z;       // number of nodes along each axis
  float escape;                        // h / T, or 1 if this is above 1
  // The time of the first step, and the duration of a step, as fractions of the time between the two frames of the skin.
  // Only used if CHAIN_SKIN is 1.
  float skin_from, skin_step;
} ChainParams;

// The values of one time that are the same for all strands. Vectors are in the world, whose axes do not rotate.
typedef struct {
  float fall_x, fall_y, fall_z;              // gravity minus the acceleration of the object's origin, R/s^2
  float air_x, air_y, air_z;                 // mean velocity of the air minus the velocity of the object's origin, R/s
  float gust_x, gust_y, gust_z;              // amplitude of the air's velocity in gusts, R/s
  float gust_sin, gust_cos;                  // sine and cosine of 2 pi f t; f is the frequency of the gusts
  float turn_x, turn_y, turn_z;              // angular velocity of the object, rad/s
  float turn_up_x, turn_up_y, turn_up_z;     // derivative of the angular velocity, rad/s^2
  // Columns of the matrix that rotates vectors from the object's frame to the world frame.
  float x_x, x_y, x_z, y_x, y_y, y_z, z_x, z_y, z_z;
} ChainMoment;

// Column numbers in the table of the strands' constants. Root, rest and normal have three columns each. They are
// vectors in the object's frame: the position of the root in R, the direction of the strand at rest, and the normal of
// the skin.
enum {
  STRAND_ROOT = 0,
  STRAND_REST = 3,
  STRAND_NORMAL = 6,
  STRAND_SHORTNESS = 9,    // R / L
  STRAND_STIFF_FIRST,      // k1, stiffness between the skin and the first segment, 1/s^2
  STRAND_STIFF_SECOND,     // k2, stiffness between the two segments, 1/s^2
  STRAND_LIMIT_FIRST,      // cosine of the largest angle between the rest direction and the first segment
  STRAND_LIMIT_SECOND,     // cosine of the largest angle between the two segments
  STRAND_PHASE_COS,        // cosine and sine of the gust's phase at the root
  STRAND_PHASE_SIN,
  STRAND_DRAG,             // factors of the drag and of d1 and d2. Only used if CHAIN_DAMPING is 1.
  STRAND_DAMPING,
  STRAND_COLUMNS
};

// Column numbers in the table of a frame of the skin, which has STRAND_COLUMNS columns. Root, rest and normal are in the
// columns STRAND_ROOT, STRAND_REST and STRAND_NORMAL. The vectors are in the world: velocity of the root in R/s, and its
// acceleration in R/s^2.
enum { SKIN_VELOCITY = 9, SKIN_ACCELERATION = 12 };

// Column numbers in the table that the strands have in addition if CHAIN_BODY is 1: the depths in R to which joint and tip
// may lie in the body, and the impulses of the stops 4 and 5 in the last substep.
enum { BODY_JOINT_ALLOWED, BODY_TIP_ALLOWED, BODY_STOP, BODY_COLUMNS = 4 };

// Column numbers in the table of the strands' states: the directions of the segments, their rates in rad/s, and the
// impulses of the four stops in the last substep. Directions and rates are vectors in the world, three columns each.
enum {
  CHAIN_FIRST = 0,
  CHAIN_SECOND = 3,
  CHAIN_FIRST_RATE = 6,
  CHAIN_SECOND_RATE = 9,
  CHAIN_STOP = 12,
  CHAIN_COLUMNS = 16
};

#endif
