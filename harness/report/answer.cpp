#include "harness/report/answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "harness/base/numbers.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/report/case_table.hpp"
#include "harness/report/sections.hpp"

namespace pelage {
namespace {

/// A metric by which cases are chosen, and its limits, the weakest first.
struct Quality {
  std::string metric;
  bool error;  ///< true: at most the limit; false: at least the limit
  std::vector<double> limits;
  double weak, strong;  ///< the two limits of the sentence
  bool against_control() const { return metric.starts_with("baseline_"); }
};

const Quality qualities[] = {{"error_rms", true, {0.05, 0.01, 0.001, 0.0001}, 0.05, 0.01},
                             {"baseline_ssim", false, {0.9, 0.95, 0.99}, 0.95, 0.99},
                             {"baseline_psnr", false, {25, 30, 35, 40}, 30, 40},
                             {"raycast_ssim", false, {0.9, 0.95, 0.99}, 0.95, 0.99},
                             {"raycast_coarse_psnr", false, {25, 30, 35, 40}, 25, 30}};

/// The value of these metrics for a picture and itself.
bool equal_pictures(const Cell& cell) {
  const Metric* psnr = cell.metric("baseline_psnr");
  return psnr && psnr->value >= decibels_of_equal_pictures;
}

bool reaches(const Quality& quality, double limit, const Cell& cell) {
  const Metric* metric = cell.metric(quality.metric);
  if (!timed(cell) || !metric || (quality.against_control() && equal_pictures(cell))) return false;
  const double shown = std::stod(fmt::format("{:.3g}", metric->value));  // a table shows 0.98997 as 0.990
  return quality.error ? shown <= limit : shown >= limit;
}

/// Returns the key columns (axes and "variant") that have several values.
std::vector<std::string> keys_of(const std::vector<Cell>& cells) {
  return varying_keys(table_of(cells, case_columns(cells)), cells);
}

std::string key_value(const Cell& cell, const std::string& key) {
  return key == "variant" ? cell.variant : cell.axis(key);
}

std::vector<std::string> key_values(const Cell& cell, const std::vector<std::string>& keys) {
  std::vector<std::string> values(keys.size());
  std::ranges::transform(keys, values.begin(), [&](const auto& key) { return key_value(cell, key); });
  return values;
}

/// Returns the values of these keys as text; a number has the name of its axis.
std::string choice_text(const Cell& cell, const std::vector<std::string>& keys) {
  std::vector<std::string> parts;
  for (const std::string& key : keys) {
    const std::string value = key_value(cell, key);
    if (!value.empty()) parts.push_back(number_of(value) ? fmt::format("{} {}", key, value) : value);
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::string control_of(const std::vector<Cell>& cells) {
  std::vector<Cell> controls;
  for (const Cell& c : cells)
    if (equal_pictures(c)) controls.push_back(c);
  std::vector<std::string> shared;
  for (const std::string& key : keys_of(cells))
    if (!controls.empty() && std::ranges::all_of(controls, [&](const Cell& c) {
          return key_value(c, key) == key_value(controls.front(), key);
        }))
      shared.push_back(key);
  return controls.empty() ? "" : choice_text(controls.front(), shared);
}

std::string words_of(const std::string& metric, const std::vector<Cell>& cells) {
  const std::string control = control_of(cells);
  const std::string against = control.empty() ? "the control scene" : control;
  if (metric == "baseline_psnr") return fmt::format("PSNR against {}, dB", against);
  if (metric == "baseline_ssim") return fmt::format("SSIM against {}", against);
  if (metric == "raycast_coarse_psnr") return "PSNR of means of 8 x 8 pixels against ray-cast strands, dB";
  if (metric == "raycast_ssim") return "SSIM against ray-cast strands";
  if (metric == "error_rms") return "error (RMS), fur lengths";
  return {};
}

namespace {

/// Returns a limit in words, for instance "error_rms at most 1% of the fur's length".
std::string limit_text(const Quality& quality, double limit, const std::vector<Cell>& cells) {
  if (quality.error) return fmt::format("{} at most {:g}% of the fur's length", quality.metric, 100 * limit);
  const std::string control = quality.against_control() ? control_of(cells) : "";
  return fmt::format("{}{} at least {:g}", quality.metric, control.empty() ? "" : " against " + control,
                     limit);
}

bool is_numeric_key(const std::vector<Cell>& cells, const std::string& key) {
  return std::ranges::all_of(cells, [&](const Cell& c) { return number_of(key_value(c, key)).has_value(); });
}

/// Whether the cases differ from their control scenes in numbers alone, such as the number of layers. Other
/// cases, such as a wet one beside a dry control scene, are no approximations of it.
bool approximate_the_control(const std::vector<Cell>& cells, const std::vector<std::string>& keys) {
  std::vector<Cell> controls;
  for (const Cell& c : cells)
    if (equal_pictures(c)) controls.push_back(c);
  if (controls.empty()) return false;
  std::size_t numeric = 0;
  for (const std::string& key : keys) {
    const bool one = std::ranges::all_of(
        controls, [&](const Cell& c) { return key_value(c, key) == key_value(controls.front(), key); });
    if (one && !is_numeric_key(cells, key)) return false;
    numeric += one;
  }
  return numeric > 0;
}

/// Returns the qualities that the experiment is about: those that its view draws, all without a view.
std::vector<Quality> chosen_qualities(const std::vector<Cell>& cells, const std::vector<std::string>& keys) {
  const View view = view_of(cells);
  std::vector<Quality> chosen;
  for (const Quality& quality : qualities) {
    const bool named = std::ranges::count(view.y, quality.metric) > 0 || view.x == quality.metric;
    if (!named && !(view == View{})) continue;
    if (quality.against_control() && !approximate_the_control(cells, keys)) continue;
    const auto measured =
        std::ranges::count_if(cells, [&](const Cell& c) { return timed(c) && c.metric(quality.metric); });
    if (measured >= 2) chosen.push_back(quality);
  }
  return chosen;
}

/// Whether the key says what is drawn, and not how.
bool is_circumstance(const std::string& key) {
  // Each topology has an exact solution of its own, so its errors are errors of another motion.
  return key == "model" || key == "size" || key == "distance" || key == "dynamics.topology" ||
         key.starts_with("camera.");
}

using Groups = std::vector<std::pair<std::vector<std::string>, std::vector<const Cell*>>>;

/// Returns the cells by their values of these keys, in the order of their first cells.
Groups groups_by(const std::vector<Cell>& cells, const std::vector<std::string>& keys) {
  Groups groups;
  for (const Cell& c : cells) {
    const std::vector<std::string> values = key_values(c, keys);
    auto place = std::ranges::find(groups, values, &Groups::value_type::first);
    if (place == groups.end()) place = groups.insert(place, {values, {}});
    place->second.push_back(&c);
  }
  return groups;
}

/// The cheapest case that reaches a limit.
struct Choice {
  const Cell* cell = nullptr;
  /// The other cases that reach the limit and whose interval overlaps that of `cell`, the fastest first.
  std::vector<const Cell*> close = {};
};

Choice cheapest(const std::vector<const Cell*>& cells, const Quality& quality, double limit) {
  std::vector<const Cell*> reaching;
  for (const Cell* c : cells)
    if (reaches(quality, limit, *c)) reaching.push_back(c);
  if (reaching.empty()) return {};
  const Cell* best = *std::ranges::min_element(reaching, {}, [](const Cell* c) { return c->median_ms; });
  Choice choice{best};
  for (const Cell* c : reaching)
    if (c != best && c->interval_ms.low <= best->interval_ms.high) choice.close.push_back(c);
  std::ranges::stable_sort(choice.close, {}, [](const Cell* c) { return c->median_ms; });
  return choice;
}

/// Returns the names of at most `most` of the cases that are as fast, "" if there are none.
std::string close_text(const Choice& choice, const std::vector<std::string>& keys, std::size_t most) {
  std::vector<std::string> names;
  for (const Cell* c : choice.close)
    if (names.size() < most) names.push_back(choice_text(*c, keys));
  if (choice.close.size() > most) names.push_back(fmt::format("{} more", choice.close.size() - most));
  return fmt::format("{}", fmt::join(names, "; "));
}

std::string choices_sentence(const std::vector<Cell>& cells, const std::vector<std::string>& keys) {
  const std::vector<Quality> chosen = chosen_qualities(cells, keys);
  if (chosen.empty()) return {};
  std::vector<std::string> circumstances, choices;
  for (const std::string& key : keys) (is_circumstance(key) ? circumstances : choices).push_back(key);
  const Quality& quality = chosen.front();
  std::vector<std::string> parts;
  for (const double limit : {quality.weak, quality.strong}) {
    std::vector<std::string> best;
    for (const auto& [at, members] : groups_by(cells, circumstances)) {
      const Choice choice = cheapest(members, quality, limit);
      const Cell* cell = choice.cell;
      const std::string place = choice_text(*members.front(), circumstances);
      const std::string ties = close_text(choice, choices, 1);
      best.push_back(
          fmt::format("{}{}{}", place.empty() ? "" : "for ", place, place.empty() ? "" : " ") +
          (cell ? fmt::format("{} ({} ms{})", choice_text(*cell, choices), three_digits(cell->median_ms),
                              ties.empty() ? "" : "; within its interval: " + ties)
                : "none"));
    }
    parts.push_back(
        fmt::format("ith {}, the cheapest is {}", limit_text(quality, limit, cells), fmt::join(best, ", ")));
  }
  return fmt::format("W{}.", fmt::join(parts, "; w"));
}

using Number = std::function<std::optional<double>(const Cell&)>;

/// Returns "WHAT: 8.79 (geometric mean of 32 cases; 5.18 for torus to 17.6 for lion)."; "" without numbers.
std::string ratios_sentence(const std::vector<Cell>& cells, const std::vector<std::string>& keys,
                            const char* what, const Number& number) {
  std::vector<std::pair<double, const Cell*>> found;
  for (const Cell& c : cells)
    if (const auto value = timed(c) ? number(c) : std::nullopt; value && *value > 0)
      found.emplace_back(*value, &c);
  if (found.empty()) return {};
  if (found.size() == 1) return fmt::format("{}: {}.", what, three_digits(found.front().first));
  std::vector<double> ratios(found.size());
  std::ranges::transform(found, ratios.begin(), &std::pair<double, const Cell*>::first);
  const auto [least, most] = std::ranges::minmax_element(found);
  return fmt::format("{}: {} (geometric mean of {} cases; {} for {} to {} for {}).", what,
                     three_digits(geometric_mean(ratios)), found.size(), three_digits(least->first),
                     choice_text(*least->second, keys), three_digits(most->first),
                     choice_text(*most->second, keys));
}

/// The change of the time between two values of a key, with all other keys equal.
struct Effect {
  std::string key, from, to;
  std::vector<double> ratios;  ///< time at `to` / time at `from`
  double size() const { return ratios.empty() ? 0 : std::abs(std::log(geometric_mean(ratios))); }
};

/// Returns the effect of the key from its first to its last value if these are numbers, otherwise from its
/// fastest to its slowest value.
Effect effect_of(const std::vector<Cell>& cells, const std::string& key,
                 const std::vector<std::string>& keys) {
  std::vector<std::string> others = keys;
  std::erase(others, key);
  std::map<std::vector<std::string>, std::map<std::string, double>> groups;  // other keys -> value -> ms
  std::map<std::string, std::vector<double>> times;
  for (const Cell& c : cells)
    if (timed(c)) {
      groups[key_values(c, others)][key_value(c, key)] = c.median_ms;
      times[key_value(c, key)].push_back(c.median_ms);
    }
  std::vector<std::string> values(times.size());
  std::ranges::transform(times, values.begin(), [](const auto& at) { return at.first; });
  const bool numeric = std::ranges::all_of(values, [](const auto& v) { return number_of(v).has_value(); });
  std::ranges::sort(values, [&](const std::string& a, const std::string& b) {
    return numeric ? natural_less(a, b) : geometric_mean(times[a]) < geometric_mean(times[b]);
  });
  Effect effect{key, values.empty() ? "" : values.front(), values.empty() ? "" : values.back(), {}};
  for (const auto& [unused, at] : groups)
    if (at.contains(effect.from) && at.contains(effect.to) && effect.from != effect.to)
      effect.ratios.push_back(at.at(effect.to) / at.at(effect.from));
  return effect;
}

/// Returns "3.1 (geometric mean of 8 cases, 2.9 to 3.4)".
std::string mean_text(const std::vector<double>& ratios) {
  const auto [least, most] = std::ranges::minmax(ratios);
  return ratios.size() == 1
             ? three_digits(ratios.front())
             : fmt::format("{} (geometric mean of {} cases, {} to {})", three_digits(geometric_mean(ratios)),
                           ratios.size(), three_digits(least), three_digits(most));
}

std::string effects_sentence(const std::vector<Cell>& cells, const std::vector<std::string>& keys) {
  std::vector<double> times;
  for (const Cell& c : cells)
    if (timed(c)) times.push_back(c.median_ms);
  if (times.empty()) return {};
  const auto [least, most] = std::ranges::minmax(times);
  std::string text = sample_of(cells);
  text.front() = char(std::toupper(static_cast<unsigned char>(text.front())));
  text += times.size() == 1 ? fmt::format(": {} ms", three_digits(least))
                            : fmt::format(": {} to {} ms", three_digits(least), three_digits(most));
  std::vector<Effect> effects;
  constexpr double least_told = 0.01;
  for (const std::string& key : keys)
    if (Effect effect = effect_of(cells, key, keys); effect.size() > least_told)
      effects.push_back(std::move(effect));
  std::ranges::stable_sort(effects, std::greater<>(), &Effect::size);
  constexpr std::size_t shown = 2;
  for (std::size_t i = 0; i < std::min(shown, effects.size()); ++i)
    text += fmt::format("; {} {} takes {} times as long as {}", effects[i].key, effects[i].to,
                        mean_text(effects[i].ratios), effects[i].from);
  return text + ".";
}

/// Returns the cells of the usual reading, or all if there are none.
std::vector<Cell> of_usual_reading(const std::vector<Cell>& cells) {
  std::vector<Cell> usual;
  for (const Cell& c : cells)
    if (c.reading().empty()) usual.push_back(c);
  return usual.empty() ? cells : usual;
}

}  // namespace

std::string answer_of(const std::vector<Cell>& given) {
  if (given.empty()) return {};
  std::vector<Cell> cells = of_usual_reading(given);
  sort_cells(cells);
  const std::vector<std::string> keys = keys_of(cells);
  const auto metric = [](const char* name) {
    return [name](const Cell& c) {
      const Metric* found = c.metric(name);
      return found ? std::optional(found->value) : std::nullopt;
    };
  };
  const auto paper = [](const Cell& c) {
    const auto found = ratio_of(c);
    return found && found->relation.empty() ? std::optional(found->value) : std::nullopt;
  };
  for (const std::string& text :
       {choices_sentence(cells, keys),
        ratios_sentence(cells, keys, "OpenGL's frame time / our frame time", metric("opengl_ratio")),
        ratios_sentence(cells, keys, "Our frame rate / the paper's", paper),
        ratios_sentence(cells, keys, "Time / time of the control scene", metric("frame_over_baseline")),
        ratios_sentence(cells, keys, "Time with all layers / time with a quarter of them",
                        metric("frame_over_quarter"))})
    if (!text.empty()) return text;
  return effects_sentence(cells, keys);
}

std::vector<double> told_limits(const std::string& metric) {
  for (const Quality& quality : qualities)
    if (quality.metric == metric) return {quality.weak, quality.strong};
  return {};
}

std::vector<std::string> qualities_of(const std::vector<Cell>& cells) {
  if (cells.empty()) return {};
  std::vector<std::string> names;
  for (const Quality& quality : chosen_qualities(cells, keys_of(cells))) names.push_back(quality.metric);
  return names;
}

std::optional<Table> choices_of(std::vector<Cell> cells) {
  sort_cells(cells);
  const std::vector<std::string> keys = keys_of(cells);
  const std::vector<Quality> chosen = chosen_qualities(cells, keys);
  if (chosen.empty()) return {};
  // The lines are those of the plots' panels too, which may show choices such as topologies side by side.
  const View view = view_of(cells);
  std::vector<std::string> circumstances, choices;
  for (const std::string& key : keys)
    (is_circumstance(key) || std::ranges::count(view.panels, key) > 0 ? circumstances : choices)
        .push_back(key);
  if (choices.empty()) return {};
  Table table;
  table.title = title_of(cells) + ": the cheapest case for each limit";
  for (const std::string& key : circumstances) table.columns.push_back({key, key});
  table.columns.insert(table.columns.end(), {{"limit", "limit"},
                                             {"choice", "choice"},
                                             {"median_ms", fmt::format("{}, ms", sample_of(cells))},
                                             {"value", "value"},
                                             {"close", "as fast within its interval"}});
  table.layout.rows = circumstances;
  table.layout.rows.insert(table.layout.rows.end(), {"limit", "choice"});
  table.layout.values = {"median_ms", "value", "close"};
  for (const Quality& quality : chosen)
    for (const auto& [at, members] : groups_by(cells, circumstances))
      for (const double limit : quality.limits) {
        const Choice choice = cheapest(members, quality, limit);
        std::vector<Value>& line = table.lines.emplace_back();
        for (const std::string& value : at) line.push_back(text_value(value));
        line.push_back(text_value(limit_text(quality, limit, cells)));
        line.push_back(text_value(choice.cell ? choice_text(*choice.cell, choices) : "none"));
        const Metric* metric = choice.cell ? choice.cell->metric(quality.metric) : nullptr;
        line.push_back(number_value(metric ? std::optional(choice.cell->median_ms) : std::nullopt));
        line.push_back(number_value(metric ? std::optional(metric->value) : std::nullopt));
        line.push_back(text_value(close_text(choice, choices, 1)));
      }
  table.remarks = {
      "Value: the case's value of the limited metric. As fast: other cases that keep the limit and whose 95% interval of the time overlaps that of the cheapest."};
  if (std::ranges::count(keys, "dynamics.topology") > 0)
    table.remarks.push_back("The error of a topology is that against its own exact motion.");
  return table;
}

}  // namespace pelage
