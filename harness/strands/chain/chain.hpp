// The model of a strand's motion: a chain of two rigid segments (docs/strands.md, section "Chains"). This
// file has the constants and the states of chains, and their memory layout in the kernels. R is the radius of
// the mesh's bounding sphere, and L is the length of a strand.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "harness/distance/field.hpp"
#include "harness/springs/model/motion.hpp"
#include "harness/strands/body/skin.hpp"
#include "kernels/strands/chain/params.h"

namespace pelage::strands {

/// The constants of one strand. Vectors are in the object's frame.
struct Chain {
  glm::vec3 root{0};             ///< position of the root, R
  glm::vec3 rest{0, 1, 0};       ///< direction of the strand at rest, unit vector, not below the skin
  glm::vec3 normal{0, 1, 0};     ///< normal of the skin at the root, unit vector
  float length = 0.1f;           ///< length L of the strand, R
  float stiffness_first = 800;   ///< stiffness k1 between the skin and the first segment, 1/s^2
  float stiffness_second = 400;  ///< stiffness k2 between the two segments, 1/s^2
  float limit_first = 80;        ///< largest angle between the rest direction and the first segment, degrees
  float limit_second = 80;       ///< largest angle between the two segments, degrees
  float drag = 1, damping = 1;   ///< factors of the drag and of both dampings of ChainDynamics
};

/// The state of one strand: directions of its segments in the world (unit vectors) and their derivatives with
/// respect to time (rad/s). Segment 0 joins the root to the joint, and segment 1 the joint to the tip.
struct ChainState {
  std::array<glm::vec3, 2> direction{};
  std::array<glm::vec3, 2> rate{};
  /// Impulses of the four stops (constraints) in the last step. The stops are: Chain::limit_first, the skin
  /// below the joint, Chain::limit_second, and the skin below the tip. The impulse of a stop that did not act
  /// is 0.
  std::array<float, 4> stop{};
  /// Impulses of the stops 4 and 5 in the last step: the body at the joint, and the body at the tip. They are
  /// 0 without ChainDynamics::body.
  std::array<float, 2> body{};
};

/// The values that all strands share. The unit of mass is the mass of the strand. The unit of length is L,
/// except in the values whose comment names R.
struct ChainDynamics {
  float step = 1.0f / 240;          ///< h, duration of a substep, s
  float first_segment = 0.5f;       ///< length of the first segment in L; the second segment has the rest
  float tip_mass = 0.4f;            ///< mass at the tip; the joint has the rest
  float drag = 4.0f;                ///< drag coefficient of joint and tip divided by their mass, 1/s
  float damping_first = 0.2f;       ///< damping of the first segment's rate (ChainState::rate), 1/s
  float damping_second = 0.2f;      ///< damping of the difference between the two segments' rates, 1/s
  glm::vec3 gravity{0, -9.81f, 0};  ///< R/s^2
  springs::Wind wind;               ///< R counts as 1 m
  springs::Motion motion;
  /// The body in the object's frame, or null: the strands then collide with the plane of their own skin only.
  std::shared_ptr<const DistanceField> body;
};

/// Throws InputError if a value is not finite or outside its valid range. The message names the value and the
/// valid range.
void check(const ChainDynamics& dynamics);

/// Returns whether some chain has a drag or a damping of its own: a factor other than 1.
bool has_own_damping(const std::vector<Chain>& chains);

/// Returns the kernels' constants. Members that depend on the launch or on the number of strands are 0.
ChainParams params(const ChainDynamics& dynamics);

/// Returns gravity, wind and motion of the object at the ends of `count` steps: at the times
/// (first + 1 + i) h for i = 0 to count - 1. `first` is the index of the first step, and h is the duration of
/// a step. The values are computed in double precision and rounded to float.
std::vector<ChainMoment> moments(const ChainDynamics& dynamics, long first, int count);

/// Returns the strands' constants in the memory layout of the kernels: slices of 16 strands with
/// STRAND_COLUMNS columns (kernels/common/slices.clh). Unused places of the last slice hold upright strands.
/// Throws InputError if a constant is not finite or outside its valid range.
std::vector<float> strand_columns(const std::vector<Chain>& chains, const springs::Wind& wind);

/// Returns the state at time 0 of a strand at rest: both segments point in the rest direction, and the rates
/// are 0.
ChainState at_rest(const Chain& chain);

/// Returns, with BODY_COLUMNS columns, how deep joint and tip may lie in the body (docs/strands.md, section
/// Body), and the impulses of the stops 4 and 5.
std::vector<float> body_columns(const std::vector<Chain>& chains, const ChainDynamics& dynamics,
                                const std::vector<ChainState>& states);

/// Returns a skin's frame in the memory layout of the kernels. The table has STRAND_COLUMNS columns. Root,
/// direction at rest and normal have the same columns as in strand_columns(). The velocity and the
/// acceleration follow. Throws InputError if a value is not finite, if a direction is not a unit vector, or
/// if the length of a list is not `strands`.
std::vector<float> skin_columns(const SkinFrame& frame, std::size_t strands);

/// state_columns() converts states to the memory layout of the kernels, with CHAIN_COLUMNS columns.
/// states_of() converts them back, but without the impulses of the stops 4 and 5. Unused places hold upright
/// strands.
std::vector<float> state_columns(const std::vector<ChainState>& states);
std::vector<ChainState> states_of(const std::vector<float>& columns, std::size_t strands);

}  // namespace pelage::strands
