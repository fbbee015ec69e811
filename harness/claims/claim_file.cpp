#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>

#include "harness/base/toml_table.hpp"
#include "harness/claims/claim.hpp"
#include "harness/data_folder.hpp"
#include "harness/error.hpp"
#include "harness/record/ratios.hpp"

namespace pelage::claims {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> kinds{"shape", "absolute"};
constexpr std::array<std::string_view, 5> quantities{"frame-time", "frame-rate", "phase-time", "phase-share",
                                                     "metric"};
constexpr std::array<std::string_view, 7> effects{"level",     "ratio",       "ratio-by-phase", "elasticity",
                                                  "linearity", "ratio-trend", "share-of-cases"};
constexpr std::array<std::string_view, 4> combinations{"every", "geometric-mean", "mean", "median"};

void read_rows(TomlTable table, Claim& claim) {
  claim.experiments = table.list("experiment");
  if (claim.experiments.empty()) table.refuse("experiment", "experiment = \"NAME\" is missing");
  claim.where = table.lists("where");
  claim.overridden = table.flag("overridden");
  claim.cases = std::size_t(table.number("cases", 1, 1, 1e6));
  table.finish();
}

void read_quantity(TomlTable& table, Claim& claim) {
  const bool by_phase = claim.effect == Effect::ratio_by_phase;
  if (by_phase && table.has("quantity"))
    table.refuse(
        "quantity",
        "the effect ratio-by-phase has no quantity: it uses the times of the phase and of the frame");
  claim.quantity = by_phase ? Quantity::phase_time : Quantity(table.choice("quantity", quantities, 0));
  if (claim.quantity == Quantity::phase_time || claim.quantity == Quantity::phase_share)
    claim.phase = table.required_text("phase");
  if (claim.quantity == Quantity::metric) claim.metric = table.required_text("metric");
  if (!by_phase) claim.per = table.text("per");
  const bool whole_frame = claim.quantity == Quantity::frame_time || claim.quantity == Quantity::frame_rate;
  if (whole_frame && !claim.axis.empty()) claim.phases = table.values("phases");
}

/// Reads `of` or `to`: a value of the claim's axis, or without an axis a table with the values of several
/// axes.
Selection read_selection(TomlTable& table, const char* key, const Claim& claim) {
  const bool one_axis = !claim.axis.empty();
  const toml::node* node = table.get(key);
  if (!node || node->is_table() == one_axis)
    table.refuse(
        key, one_axis ? fmt::format("{} = ... must be a value of the axis {}", key, claim.axis)
                      : fmt::format("{0} = ... must be a table {{ AXIS = VALUE, ... }}; for a single value, "
                                    "name its axis: axis = \"AXIS\"",
                                    key));
  if (one_axis) return {{claim.axis, table.axis_value(key)}};
  Selection selection;
  for (const auto& [axis, values] : table.lists(key)) {
    if (values.size() != 1) table.refuse(key, fmt::format("{}: give one value of the axis {}", key, axis));
    selection[axis] = values.front();
  }
  if (selection.empty()) table.refuse(key, fmt::format("{} names no axis", key));
  return selection;
}

void read_effect(TomlTable table, Claim& claim) {
  claim.effect = Effect(table.choice("name", effects, 0));
  const bool pairs = claim.effect == Effect::ratio || claim.effect == Effect::ratio_by_phase ||
                     claim.effect == Effect::ratio_trend;
  const bool slopes = claim.effect == Effect::elasticity || claim.effect == Effect::linearity;
  claim.axis = slopes ? table.required_text("axis") : pairs ? table.text("axis") : "";
  if (pairs) {
    claim.of = read_selection(table, "of", claim);
    claim.to = read_selection(table, "to", claim);
  }
  if (claim.effect == Effect::ratio_trend) claim.across = table.required_text("across");
  if (slopes || claim.effect == Effect::ratio_trend) {
    claim.along = table.text("along");
    claim.values = std::size_t(table.number("values", claim.effect == Effect::elasticity ? 2 : 3, 2, 1e6));
  }
  if (claim.effect == Effect::share_of_cases)
    claim.threshold = table.required_number("threshold", "the effect share-of-cases");
  read_quantity(table, claim);
  if (claim.effect != Effect::share_of_cases)
    claim.combine = Combine(table.choice("combine", combinations, 0));
  table.finish();
}

void read_relation(TomlTable table, Claim& claim) {
  Region& region = claim.region;
  const auto single = [&](std::string_view key, std::optional<double>& limit, bool strict) {
    const auto value = table.number(key);
    if (!value) return;
    if (!claim.relation.empty()) table.refuse(key, "a claim has only one relation");
    limit = value;
    region.strict = strict;
    claim.relation = fmt::format("{} {:g}", key, *value);
    std::replace(claim.relation.begin(), claim.relation.end(), '_', ' ');
  };
  single("at_most", region.high, false);
  single("at_least", region.low, false);
  single("below", region.high, true);
  single("above", region.low, true);
  if (const std::optional<double> value = table.number("about")) {
    if (!claim.relation.empty()) table.refuse("about", "a claim has only one relation");
    const double tolerance = table.required_number("tolerance", "the relation about");
    if (tolerance < 0 || tolerance >= 1)
      table.refuse("tolerance", "tolerance must be a fraction of the number `about`, from 0 to less than 1");
    region.low = *value - tolerance * std::abs(*value);
    region.high = *value + tolerance * std::abs(*value);
    claim.relation = fmt::format("{:.4g} +-{:g}%", *value, 100 * tolerance);
  } else if (const std::vector<double> limits = table.numbers("between"); !limits.empty()) {
    if (!claim.relation.empty()) table.refuse("between", "a claim has only one relation");
    if (limits.size() != 2 || limits[0] > limits[1])
      table.refuse("between", "between needs two numbers, the smaller one first: between = [0.8, 1.25]");
    const double low = limits[0], high = limits[1];
    region = {low, high};
    claim.relation =
        low == high ? fmt::format("exactly {:g}", low) : fmt::format("between {:g} and {:g}", low, high);
  }
  if (claim.relation.empty())
    table.refuse("", "the relation has no limit; give at_most, at_least, below, above, between or about");
  table.finish();
}

/// Reads `relation = "decreasing"`, which requires a slope below 0, or `relation = "increasing"`, which
/// requires a slope above 0.
void read_direction(const std::string& direction, const TomlTable& table, Claim& claim) {
  if (direction != "decreasing" && direction != "increasing")
    table.refuse(
        "relation",
        fmt::format(
            "relation = \"{}\" is unknown; give \"decreasing\", \"increasing\" or a table such as {{ at_most = 0.5 }}",
            direction));
  if (claim.effect != Effect::elasticity && claim.effect != Effect::ratio_trend)
    table.refuse("relation", fmt::format("\"{}\" needs the effect elasticity or ratio-trend", direction));
  (direction == "decreasing" ? claim.region.high : claim.region.low) = 0;
  claim.region.strict = true;
  claim.relation = direction;
}

Claim read_claim(const fs::path& file, const toml::table& source, const ClaimFile& settings) {
  TomlTable table(file, source, "claim");
  Claim claim;
  claim.id = table.required_text("id");
  table.rename("claim " + claim.id);
  claim.statement = table.required_text("statement");
  claim.test = table.text("test");
  claim.reading = table.text("reading");
  const bool known = claim.reading.empty() || claim.reading == "paper" || claim.reading == "pelage";
  // In files of earlier versions, `reading` explains the test.
  if (!known && claim.test.empty())
    claim.test = std::exchange(claim.reading, "");
  else if (!known)
    table.refuse("reading", "reading must be \"paper\" or \"pelage\"");
  if (auto inner = table.inner("source")) {
    claim.paper = inner->text("paper");
    claim.section = inner->text("section");
    inner->finish();
  }
  claim.absolute = table.choice("kind", kinds, 0) == 1;
  claim.why = table.text("why");
  claim.untestable = table.text("untestable");
  if (!claim.untestable.empty()) {
    table.finish();
    return claim;
  }
  claim.hardware = table.text("hardware");
  claim.process_spread = table.number("process_spread", settings.process_spread, 0, 1);
  const auto rows = table.inner("rows"), effect = table.inner("effect");
  if (!rows) table.refuse("rows", "rows = { experiment = \"NAME\" } or untestable = \"REASON\" is missing");
  read_rows(*rows, claim);
  if (!effect) table.refuse("effect", "effect = { name = \"level\" } is missing");
  read_effect(*effect, claim);
  for (std::string* name : {&claim.metric, &claim.per, &claim.along})
    *name = present_metric(*name, file.string());
  const toml::node* relation = table.get("relation");
  if (!relation) table.refuse("relation", "relation = { at_most = 0.5 } is missing");
  if (relation->is_string())
    read_direction(table.text("relation"), table, claim);
  else if (const auto inner = table.inner("relation"))
    read_relation(*inner, claim);
  table.finish();
  return claim;
}

/// Reads the list of claims, the only key of the table that is not read yet.
void read_list(const fs::path& file, TomlTable& table, ClaimFile& result, std::set<std::string>& ids) {
  const toml::node* claims = table.get("claim");
  table.finish();
  const toml::array* list = claims ? claims->as_array() : nullptr;
  if (!list || list->empty())
    refuse(file, nullptr, "there is no [[claim]]; docs/experiments.md describes the format");
  for (const toml::node& node : *list) {
    if (!node.is_table()) refuse(file, &node, "a claim must be a table [[claim]]");
    result.claims.push_back(read_claim(file, *node.as_table(), result));
    if (!ids.insert(result.claims.back().id).second)
      refuse(file, &node, fmt::format("two claims have the id {}", result.claims.back().id));
  }
}

}  // namespace

ClaimFile read_claims(const fs::path& file) {
  const toml::table source = read_toml(file);
  TomlTable table(file, source, "");
  ClaimFile result;
  result.file = file;
  result.process_spread = table.number("process_spread", result.process_spread, 0, 1);
  result.separate_processes = int(table.number("separate_processes", result.separate_processes, 1, 1000));
  const toml::node* include = table.get("include");
  std::set<std::string> ids;
  read_list(file, table, result, ids);
  if (!include) return result;
  const toml::array* names = include->as_array();
  if (!names || !names->is_homogeneous<std::string>())
    table.refuse("include", "include must be a list of files, such as [\"more.toml\"]");
  for (const toml::node& name : *names) {
    const fs::path other = file.parent_path() / *name.value<std::string>();
    const toml::table more = read_toml(other);
    TomlTable others(other, more, "");
    read_list(other, others, result, ids);
  }
  return result;
}

fs::path shipped_claims() {
  for (const fs::path& data : data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR))
    if (const fs::path file = data / "experiments" / "claims.toml"; fs::is_regular_file(file)) return file;
  throw InputError("experiments/claims.toml is not installed; give a file with --claims");
}

namespace {

/// Returns the metric in words, or its name if the name is plain.
std::string metric_words(const std::string& metric) {
  if (metric == "frame_over_baseline") return "frame time divided by the control scene's";
  if (metric == "baseline_psnr") return "PSNR against the control scene's picture";
  if (metric == "opengl_ratio") return "time of OpenGL divided by ours";
  if (metric == "raycast_coarse_psnr") return "PSNR against ray-cast strands";
  return metric;
}

std::string quantity_of(const Claim& claim) {
  std::string text = metric_words(claim.metric);
  if (claim.quantity == Quantity::frame_time) text = "frame time";
  if (claim.quantity == Quantity::frame_rate) text = "frame rate";
  if (claim.quantity == Quantity::phase_time) text = fmt::format("time of the phase {}", claim.phase);
  if (claim.quantity == Quantity::phase_share)
    text = fmt::format("fraction of the frame time that the phase {} takes", claim.phase);
  return claim.per.empty() ? text : fmt::format("{} divided by {}", text, claim.per);
}

std::string ratio_of(const Claim& claim, const std::string& quantity) {
  return fmt::format("{} with {}, divided by the value with {}", quantity, text_of(claim.of),
                     text_of(claim.to));
}

std::string effect_words(const Claim& claim) {
  const std::string quantity = quantity_of(claim);
  const std::string& against = claim.along.empty() ? claim.axis : claim.along;
  switch (claim.effect) {
    case Effect::level:
      break;
    case Effect::ratio:
      return ratio_of(claim, quantity);
    case Effect::ratio_by_phase:
      return fmt::format("{}, if only the time of the phase {} differed", ratio_of(claim, "frame time"),
                         claim.phase);
    case Effect::elasticity:
      return fmt::format("elasticity of the {} with respect to {}", quantity, against);
    case Effect::linearity:
      return fmt::format("slope of the {} above the middle value of {}, divided by the slope below it",
                         quantity, against);
    case Effect::ratio_trend:
      return fmt::format("slope of the logarithm of the ratio ({}) against the logarithm of {}",
                         ratio_of(claim, quantity), claim.along.empty() ? claim.across : claim.along);
    case Effect::share_of_cases:
      return fmt::format("fraction of the cases with a {} of at least {:g}", quantity, claim.threshold);
  }
  return quantity;
}

/// Texts of Combine::every, geometric_mean, mean and median.
constexpr const char* combination_names[] = {"each case", "geometric mean over the cases",
                                             "mean over the cases", "median over the cases"};

}  // namespace

bool Region::contains(double value) const {
  return contains(value, value);
}

bool Region::contains(double from, double to) const {
  return (!low || (strict ? from > *low : from >= *low)) && (!high || (strict ? to < *high : to <= *high));
}

bool Region::outside(double from, double to) const {
  return (low && (strict ? to <= *low : to < *low)) || (high && (strict ? from >= *high : from > *high));
}

std::string text_of(const Selection& selection) {
  std::string text;
  for (const auto& [axis, value] : selection)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", axis, value);
  return text;
}

std::string description_of(const Claim& claim) {
  if (!claim.untestable.empty()) return {};
  const std::string alternately = claim.phases.empty() ? "" : "; one process drew the cases alternately";
  if (claim.effect == Effect::share_of_cases) return effect_words(claim) + alternately;
  return fmt::format("{}; {}{}", effect_words(claim), combination_names[std::size_t(claim.combine)],
                     alternately);
}

}  // namespace pelage::claims
