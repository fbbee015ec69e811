// The mass-spring topologies and their solvers, each described by its properties.
#pragma once
#include <ostream>
#include <span>
#include <string>
#include <string_view>

namespace pelage::springs {

/// A topology of Banisch and Wuethrich 2006, section 4, described by its properties. A stick is a spring from
/// a base on the surface to a moving mass, its top mass. Other code tests the properties and never the name
/// of the topology. To add a topology, add a row to kind_table in spring_kinds.cpp.
struct Kind {
  std::string_view name;   ///< name in scene files and on the command line
  bool separable = false;  ///< each triangle has its own three sticks, so gaps can open between triangles
  bool edges = false;      ///< in each triangle, springs connect the top masses of the three sticks

  constexpr bool operator==(const Kind& other) const { return name == other.name; }
  /// True if springs connect the top masses, and adjacent triangles share the springs of their common edge.
  bool shared_edges() const { return edges && !separable; }
  /// True if springs connect the top masses of each triangle, and adjacent triangles share no springs.
  bool own_edges() const { return edges && separable; }

  static const Kind sticks, prisms, separable_sticks, separable_prisms;
};
inline constexpr Kind Kind::sticks{"sticks", false, false};
inline constexpr Kind Kind::prisms{"prisms", false, true};
inline constexpr Kind Kind::separable_sticks{"separable-sticks", true, false};
inline constexpr Kind Kind::separable_prisms{"separable-prisms", true, true};

extern const std::span<const Kind> kinds;  ///< the table of topologies

/// Returns the topology with this name. Throws InputError with a list of the valid names if the name is
/// unknown.
Kind kind_of(const std::string& name);

inline std::ostream& operator<<(std::ostream& out, const Kind& kind) {
  return out << kind.name;
}

/// A time integration scheme, described by its properties. Other code tests these properties and never the
/// name of the scheme. To add a scheme, add a row to solver_table in spring_kinds.cpp. Implement the
/// time step of the scheme in kernels/springs/ and in harness/springs/reference/reference.cpp.
struct Solver {
  std::string_view name;  ///< name in scene files and on the command line
  bool implicit = false;  ///< true if a step solves a linear system
  bool in_turn = false;   ///< true if a step updates the positions with the new velocities
  int stages = 1;         ///< number of force evaluations per step
  bool newton = true;     ///< false: a stick follows a force at once, and no step depends on its duration

  constexpr bool operator==(const Solver& other) const { return name == other.name; }
  bool multistage() const { return stages > 1; }

  static const Solver explicit_euler, backward_euler, semi_implicit_euler, rk4, predictor_corrector,
      wind_vectors;
};
/// The first scheme of Banisch and Wuethrich 2006.
inline constexpr Solver Solver::explicit_euler{"explicit-euler"};
/// The second scheme of Banisch and Wuethrich 2006. A step solves one linearised system, as in Baraff and
/// Witkin 1998.
inline constexpr Solver Solver::backward_euler{"backward-euler", true, true};
inline constexpr Solver Solver::semi_implicit_euler{"semi-implicit-euler", false, true};
/// The classical Runge-Kutta scheme, an example of an explicit scheme in Banisch and Wuethrich 2006.
inline constexpr Solver Solver::rk4{"rk4", false, false, 4};
/// The trapezoidal rule by two corrections of an explicit Euler step: an example of the predictor-corrector
/// schemes that Banisch and Wuethrich 2006 call implicit.
inline constexpr Solver Solver::predictor_corrector{"predictor-corrector", false, false, 3};

/// The method that Banisch and Wuethrich 2006 compare theirs with (docs/springs.md): the mean of the forces
/// of two steps leans a stick. Only for topologies without springs between tops.
inline constexpr Solver Solver::wind_vectors{.name = "wind-vectors", .newton = false};

extern const std::span<const Solver> solvers;  ///< the table of time integration schemes
extern const std::span<const Solver> methods;  ///< the schemes, and then the methods without Newton's law

/// The scheme of the highest order, which has the smallest error if the step is short enough.
inline constexpr Solver highest_order = Solver::rk4;
inline constexpr Solver default_solver = Solver::semi_implicit_euler;

/// Returns the scheme with this name. Throws InputError with a list of the valid names if the name is
/// unknown.
Solver solver_of(const std::string& name);

inline std::ostream& operator<<(std::ostream& out, const Solver& solver) {
  return out << solver.name;
}

}  // namespace pelage::springs
