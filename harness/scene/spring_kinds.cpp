#include "harness/scene/spring_kinds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "harness/error.hpp"

namespace pelage::springs {
namespace {

constexpr Kind kind_table[] = {Kind::sticks, Kind::prisms, Kind::separable_sticks, Kind::separable_prisms};

constexpr Solver solver_table[] = {Solver::explicit_euler,      Solver::backward_euler,
                                   Solver::semi_implicit_euler, Solver::rk4,
                                   Solver::predictor_corrector, Solver::wind_vectors};

template <class Row>
std::vector<std::string_view> names_in(std::span<const Row> table) {
  std::vector<std::string_view> names;
  for (const Row& row : table) names.push_back(row.name);
  return names;
}

template <class Row>
Row row_named(const std::string& wanted, std::span<const Row> table, std::string_view one,
              std::string_view many) {
  for (const Row& row : table)
    if (row.name == wanted) return row;
  throw InputError(
      fmt::format("unknown {} \"{}\"; the {} are {}", one, wanted, many, fmt::join(names_in(table), ", ")));
}

}  // namespace

constinit const std::span<const Kind> kinds = kind_table;
constinit const std::span<const Solver> solvers = std::span(solver_table).first<5>();
constinit const std::span<const Solver> methods = solver_table;

Kind kind_of(const std::string& name) {
  return row_named(name, kinds, "topology", "topologies");
}

Solver solver_of(const std::string& name) {
  return row_named(name, methods, "solver", "solvers");
}

}  // namespace pelage::springs
