#include "harness/claims/cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "harness/measure/cpu_use.hpp"

namespace pelage::claims {
namespace {

bool covers(const Claim& claim, const Row& row) {
  if (std::find(claim.experiments.begin(), claim.experiments.end(), row.experiment) ==
      claim.experiments.end())
    return false;
  if (!row.overrides.empty() && !claim.overridden) return false;
  return std::all_of(claim.where.begin(), claim.where.end(), [&row](const auto& condition) {
    const auto& [axis, values] = condition;
    const auto found = row.axes.find(axis);
    const std::string& value = found == row.axes.end() && axis == "variant" ? row.variant
                               : found == row.axes.end()                    ? ""
                                                                            : found->second;
    return std::find(values.begin(), values.end(), value) != values.end();
  });
}

/// Returns why the claim's quantity cannot be computed from the row, or "" if it can.
std::string missing(const Claim& claim, const Row& row, const std::string& phase) {
  if (row.status != Status::ok)
    return fmt::format("{}{}{}", to_text(row.status), row.reason.empty() ? "" : ": ", row.reason);
  if (claim.quantity == Quantity::metric && !row.metrics.contains(claim.metric))
    return fmt::format("the row has no metric {}", claim.metric);
  if (!claim.per.empty() && !row.metrics.contains(claim.per))
    return fmt::format("the row has no metric {}", claim.per);
  const bool needs_frame = claim.quantity != Quantity::metric && claim.quantity != Quantity::phase_time;
  for (const std::string& name :
       {needs_frame || claim.effect == Effect::ratio_by_phase ? phase : std::string(), claim.phase})
    if (!name.empty() && times_of(row, name).empty())
      return fmt::format("the row has no times of the phase {}", name);
  return {};
}

/// Returns the cells to which the row belongs: one cell, or one cell per phase if the claim has `phases`.
/// They do not contain the row yet.
std::vector<Cell> empty_cells(const Claim& claim, const Row& row) {
  Cell cell{row.case_name, row.axes, "frame", {}};
  cell.axes.try_emplace("variant", row.variant);
  if (claim.experiments.size() > 1) cell.axes["experiment"] = row.experiment;
  for (const auto& [key, value] : row.overrides) cell.axes.try_emplace(key, value);
  if (claim.phases.empty()) return {cell};
  std::vector<Cell> cells;
  for (const auto& [phase, value] : claim.phases) {
    cells.push_back(cell);
    cells.back().phase = phase;
    cells.back().axes[claim.axis] = value;
    cells.back().name = fmt::format("{} {}", row.case_name, phase);
  }
  return cells;
}

}  // namespace

Cells cells_of(const Claim& claim, const std::vector<const Row*>& rows) {
  Cells result;
  std::map<std::tuple<std::map<std::string, std::string>, std::string>, std::size_t> known;
  std::vector<bool> usable;
  for (const Row* row : rows) {
    if (!covers(claim, *row)) continue;
    result.contended += !load_warning(*row).empty();
    for (Cell& cell : empty_cells(claim, *row)) {
      const auto [place, added] = known.try_emplace({cell.axes, cell.name}, result.cells.size());
      if (added) {
        result.cells.push_back(std::move(cell));
        usable.push_back(true);
      }
      // A cell is left out if any of its rows is unusable. The tables of pelage report follow the same rule.
      const std::size_t at = place->second;
      if (!usable[at]) continue;
      if (const std::string why = missing(claim, *row, result.cells[at].phase); !why.empty()) {
        result.left_out.push_back(fmt::format("{} ({})", result.cells[at].name, why));
        usable[at] = false;
      }
      result.cells[at].processes.push_back(row);
    }
  }
  std::vector<Cell> kept;
  for (std::size_t i = 0; i < result.cells.size(); ++i)
    if (usable[i]) kept.push_back(std::move(result.cells[i]));
  result.cells = std::move(kept);
  return result;
}

}  // namespace pelage::claims
