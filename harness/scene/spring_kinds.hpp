// The spring topologies and their solvers, as the properties that tell them apart.
#pragma once
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pelage::springs {

/// A topology of Banisch and Wuethrich 2006, section 4. Code tests a property, never a name. To add a
/// topology: a row in spring_kinds.cpp.
struct Kind {
  std::string_view name;   ///< as users write it
  bool separable = false;  ///< every triangle has sticks of its own at its three corners, so layers can part
  bool edges = false;      ///< springs also run along the edges of the outermost layer

  constexpr bool operator==(const Kind& other) const { return name == other.name; }
  bool shared_edges() const { return edges && !separable; }  ///< springs join a top to all neighbouring tops
  bool own_edges() const { return edges && separable; }  ///< springs join only the three tops of a triangle

  static const Kind sticks, prisms, separable_sticks, separable_prisms;
};
inline constexpr Kind Kind::sticks{"sticks", false, false};
inline constexpr Kind Kind::prisms{"prisms", false, true};
inline constexpr Kind Kind::separable_sticks{"separable-sticks", true, false};
inline constexpr Kind Kind::separable_prisms{"separable-prisms", true, true};

extern const std::span<const Kind> kinds;  ///< all of them

/// The name of the topology.
inline std::string_view name(const Kind& kind) {
  return kind.name;
}
/// Throws InputError with the known names.
Kind kind_of(const std::string& name);

constexpr bool separable(const Kind& kind) {
  return kind.separable;
}

inline std::ostream& operator<<(std::ostream& out, const Kind& kind) {
  return out << kind.name;
}

/// A time integration scheme. Code tests a property, never a name. To add a solver: a row in spring_kinds.cpp
/// and its step in kernels/springs/ and harness/springs/reference/reference.cpp.
struct Solver {
  std::string_view name;  ///< as users write it
  bool implicit = false;  ///< solves a linear system per step
  bool in_turn = false;   ///< moves positions with the new velocities
  int stages = 1;         ///< evaluations of the forces per step: 1, or 4 of the classical Runge-Kutta scheme

  constexpr bool operator==(const Solver& other) const { return name == other.name; }
  bool multistage() const { return stages > 1; }

  static const Solver explicit_euler, backward_euler, semi_implicit_euler, rk4;
};
inline constexpr Solver Solver::explicit_euler{"explicit-euler"};  ///< the paper's first solver
/// The paper's second solver: one linearised step (Baraff and Witkin 1998).
inline constexpr Solver Solver::backward_euler{"backward-euler", true, true};
inline constexpr Solver Solver::semi_implicit_euler{"semi-implicit-euler", false, true};
inline constexpr Solver Solver::rk4{"rk4", false, false, 4};

extern const std::span<const Solver> solvers;  ///< all of them

inline constexpr Solver highest_order =
    Solver::rk4;  ///< most accurate for steps at which all solvers are stable
inline constexpr Solver default_solver = Solver::semi_implicit_euler;

/// The name of the solver.
inline std::string_view name(const Solver& solver) {
  return solver.name;
}
/// Throws InputError with the known names.
Solver solver_of(const std::string& name);

inline std::ostream& operator<<(std::ostream& out, const Solver& solver) {
  return out << solver.name;
}

/// The names in the order of the tables.
std::vector<std::string_view> kind_names();
std::vector<std::string_view> solver_names();

}  // namespace pelage::springs
