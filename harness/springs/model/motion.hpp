// Wind, and the motion of the object that carries the fur. R counts as 1 m.
#pragma once
#include <glm/vec3.hpp>

#include "harness/scene/scene.hpp"

namespace pelage::springs {

/// The wind blows along `direction`. Let d be the unit vector of `direction`, and let x be the position of a
/// stick's base at time 0. At time t the wind at this stick has the speed `speed` * (1 + gust * sin(2 pi
/// (frequency * t - x . d / wavelength))).
struct Wind {
  glm::vec3 direction{1, 0, 0};  ///< any length except 0
  float speed = 0;               ///< mean speed in m/s
  float gust = 0;                ///< amplitude as a fraction of `speed`; 0 for steady wind
  float frequency = 1;           ///< Hz
  float wavelength = 1;          ///< R
};

/// The object's motion: a rotation by theta(t) about `axis` through the origin, followed by the translation
/// T(t). T = velocity * t + shake * (1 - cos(2 pi shake_frequency * t)), theta = spin * t + swing * sin(2 pi
/// swing_frequency * t).
struct Motion {
  glm::vec3 velocity{0};      ///< R/s
  glm::vec3 shake{0};         ///< R
  float shake_frequency = 0;  ///< Hz
  glm::vec3 axis{0, 1, 0};    ///< any length except 0
  float spin = 0;             ///< rad/s
  float swing = 0;            ///< rad
  float swing_frequency = 0;  ///< Hz
};

/// The object's motion at one time.
struct Pose {
  glm::dvec3 velocity;      ///< T', R/s
  glm::dvec3 acceleration;  ///< T'', R/s^2
  glm::dvec3 axis;          ///< unit vector of the rotation axis
  double angle;             ///< theta, rad
  double rate;              ///< theta', rad/s
  double rate_up;           ///< theta'', rad/s^2
};

/// Converts the scene's keys. The wind has the speed strength / drag, or 0 if `drag` is 0: at rest, it exerts
/// the force `strength` on what has this drag.
Wind wind_of(const WindScene& scene, float drag);
Motion motion_of(const MotionScene& scene);

/// Returns the phase of the gusts at the position `at` (R), in rad: 2 pi (x . d / wavelength).
double gust_phase(const Wind& wind, glm::dvec3 at);

/// Returns whether the object rotates. The coordinate frame of a rotating object is not inertial.
bool turns(const Motion& motion);

/// Returns the object's motion at `time` in seconds.
Pose pose_at(const Motion& motion, double time);

/// Rotates v by `angle` (rad) about the unit vector `axis`. With the angle of a pose, the function
/// transforms v from the object's frame to the world. With the negative angle, it transforms v back.
glm::dvec3 turned(glm::dvec3 v, glm::dvec3 axis, double angle);

}  // namespace pelage::springs
