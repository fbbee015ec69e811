#include "harness/report/claims.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <tuple>

#include "harness/measure/statistics.hpp"
#include "harness/scene/spring_kinds.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

struct Times {
  double frame = 0, simulate = 0;  // ms
};
using Key = std::tuple<std::string, std::string, std::string>;  // model, topology, solver
using Table = std::map<Key, Times>;

const std::string elephant = "banisch-elephant", dog = "banisch-dog", grass = "banisch-grass";
const std::string by_explicit(springs::Solver::explicit_euler.name),
    by_implicit(springs::Solver::backward_euler.name);
const std::vector<std::string> both{by_explicit, by_implicit};

/// Returns the names of the separable topologies, or of the others if `separable` is false. In a separable
/// topology neighbouring triangles of a layer are not connected.
std::vector<std::string> topologies(bool separable) {
  std::vector<std::string> names;
  for (const springs::Kind& kind : springs::kinds)
    if (kind.separable == separable) names.emplace_back(kind.name);
  return names;
}

std::vector<std::string> every_topology() {
  std::vector<std::string> names;
  for (const springs::Kind& kind : springs::kinds) names.emplace_back(kind.name);
  return names;
}

std::map<std::string, Table> tables_of(const std::vector<FoundRow>& rows) {
  std::map<std::string, std::map<Key, std::pair<std::vector<double>, std::vector<double>>>> samples;
  for (const auto& [row, journal, copies] : rows) {
    if (row.experiment != "banisch2006-update-time" || row.status != Status::ok || !row.overrides.empty())
      continue;
    auto& [frame, simulate] =
        samples[row.device][{row.axes.at("model"), row.axes.at("dynamics.topology"), row.variant}];
    const std::vector<double> whole = frame_ms(row);
    frame.insert(frame.end(), whole.begin(), whole.end());
    if (const auto found = row.samples.find("simulate"); found != row.samples.end())
      simulate.insert(simulate.end(), found->second.event_ms.begin(), found->second.event_ms.end());
  }
  std::map<std::string, Table> tables;
  for (const auto& [device, cells] : samples)
    for (const auto& [key, both_times] : cells)
      if (!both_times.first.empty() && !both_times.second.empty())
        tables[device][key] = {median(both_times.first), median(both_times.second)};
  return tables;
}

/// A function that computes one number from the times of one combination of model, topology and solver. It
/// returns no value if the times are missing.
using Number = std::optional<double> (*)(const Table&, const Key&);

std::optional<Times> times(const Table& table, const Key& key) {
  const auto found = table.find(key);
  return found == table.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> share(const Table& table, const Key& key) {
  const auto t = times(table, key);
  return t ? std::optional(t->simulate / t->frame) : std::nullopt;
}

std::optional<double> implicit_by_explicit(const Table& table, const Key& key) {
  const auto& [model, topology, solver] = key;
  const auto slow = times(table, {model, topology, by_implicit}),
             fast = times(table, {model, topology, by_explicit});
  // The result is the ratio of the two solvers' frame times. The solver changes only the simulation time of a
  // frame. The noise of the other phases is larger than the difference between the two simulation times.
  // Therefore both frame times contain the other phases' time from the frame of the explicit solver.
  return slow && fast ? std::optional(1 + (slow->simulate - fast->simulate) / fast->frame) : std::nullopt;
}

std::optional<double> separable_by_shared(const Table& table, const Key& key) {
  const auto& [model, topology, solver] = key;
  const auto apart = times(table, {model, "separable-" + topology, solver}),
             one = times(table, {model, topology, solver});
  return apart && one ? std::optional(apart->simulate / one->simulate) : std::nullopt;
}

std::optional<double> updates(const Table& table, const Key& key) {
  const auto t = times(table, key);
  return t ? std::optional(1000 / t->frame) : std::nullopt;
}

/// `words` quotes a statement of the paper, `where` names its place, and `reading` is the condition that is
/// tested.
struct Sentence {
  const char *words, *where, *reading;
  std::vector<std::string> models, topologies, solvers;
  Number number;
  bool at_most;
  double limit;
};

const std::vector<Sentence>& sentences() {
  static const std::vector<Sentence> all{
      {"for the moving fur simulation of the dog and the elephant, using non-separable topologies, the "
       "computational power needed for rendering the shell layers takes the greater part of the total "
       "performance",
       "the paper's statement about Figures 9 and 10",
       "the simulation's share of the frame time is at most 1/2",
       {elephant, dog},
       topologies(false),
       both,
       share,
       true,
       0.5},
      {"Even when using the potentially slower implicit solution method, no significant slowdown can be "
       "noticed",
       "the paper's statement about the elephant with spring-sticks or prisms in Figure 9",
       "the frame time with simulation by the implicit solver, divided by the frame time with simulation by "
       "the explicit solver, is at most 1.1",
       {elephant},
       topologies(false),
       {by_implicit},
       implicit_by_explicit,
       true,
       1.1},
      {"the number of mass points and springs needed for an entire surface is increased using these "
       "topologies",
       "the paper's statement about the separable topologies, in section 4",
       "the simulation time of separable-sticks or separable-prisms, divided by the simulation time of "
       "sticks or prisms, is at least 1",
       {elephant, dog},
       topologies(false),
       both,
       separable_by_shared,
       false,
       1},
      {"the separable topologies simulated using the explicit solver run at update rates which are still "
       "interactive",
       "the paper's statement about the elephant in Figure 9",
       "the number of updates per second is at least 17; the paper calls 17 updates per second near the "
       "limits of interactive application",
       {elephant},
       topologies(true),
       {by_explicit},
       updates,
       false,
       17},
      {"Using the spring-sticks for the dynamical simulation does not noticeably slow down the system",
       "the paper's statement about the dog in Figure 10",
       "the simulation's share of the frame time is at most 1/20",
       {dog},
       {std::string(springs::Kind::sticks.name)},
       both,
       share,
       true,
       0.05},
      {"Nearly all the time needed to process the animation is required by the rendering, not by the "
       "physical system",
       "the paper's statement about the grass in Figure 11",
       "the simulation's share of the frame time is at most 1/10",
       {grass},
       every_topology(),
       both,
       share,
       true,
       0.1},
  };
  return all;
}

Claim judged(const Sentence& s, const std::string& device, const Table& table) {
  Claim claim{device, s.words, s.where, s.reading, Held::not_measured, {}};
  double least = 0, most = 0;
  std::size_t cells = 0;
  Key worst;
  for (const std::string& model : s.models)
    for (const std::string& topology : s.topologies)
      for (const std::string& solver : s.solvers) {
        const Key key{model, topology, solver};
        const std::optional<double> value = s.number(table, key);
        if (!value) {
          claim.found = fmt::format("there is no time for model {}, topology {} and solver {}", model,
                                    topology, solver);
          return claim;
        }
        if (cells == 0 || (s.at_most ? *value > most : *value < least)) worst = key;
        least = cells == 0 ? *value : std::min(least, *value);
        most = cells == 0 ? *value : std::max(most, *value);
        ++cells;
      }
  const double decisive = s.at_most ? most : least;
  claim.held = (s.at_most ? decisive <= s.limit : decisive >= s.limit) ? Held::yes : Held::no;
  claim.found = fmt::format(
      "measured {:.3g} to {:.3g} for {} combinations of model, topology and solver; the decisive "
      "value is {:.3g} for model {}, topology {} and solver {}",
      least, most, cells, decisive, std::get<0>(worst), std::get<1>(worst), std::get<2>(worst));
  return claim;
}

}  // namespace

std::string_view to_text(Held held) {
  switch (held) {
    case Held::yes:
      return "holds";
    case Held::no:
      return "does not hold";
    case Held::not_measured:
      break;
  }
  return "not measured";
}

std::vector<Claim> claims_of(const std::vector<FoundRow>& rows) {
  std::vector<Claim> claims;
  for (const auto& [device, table] : tables_of(rows))
    for (const Sentence& sentence : sentences()) claims.push_back(judged(sentence, device, table));
  return claims;
}

std::string csv_of(const std::vector<Claim>& claims) {
  std::string text = csv_line({"device", "claim", "where", "read_as", "verdict", "found"});
  for (const Claim& c : claims)
    text += csv_line({c.device, c.sentence, c.source, c.reading, std::string(to_text(c.held)), c.found});
  return text;
}

std::string text_of(const std::vector<Claim>& claims) {
  std::string text;
  for (const Claim& c : claims) {
    if (text.empty()) text = "Statements of the paper on Figures 9 to 11, tested on this device\n";
    text += fmt::format("  {}: \"{}\" ({})\n    {}: {}\n", to_text(c.held), c.sentence, c.source, c.reading,
                        c.found);
  }
  return text;
}

std::string html_of(const std::vector<Claim>& claims) {
  if (claims.empty()) return {};
  std::string html =
      "<h2>The paper's statements on Figures 9 to 11</h2>\n<p class=\"soft\">Each statement is tested by a "
      "number in every cell that it covers; <a href=\"tables/claims.csv\">CSV</a>.</p>\n<ul>\n";
  for (const Claim& c : claims)
    html += fmt::format("<li><b>{}</b>: &ldquo;{}&rdquo; ({})<br><span class=\"soft\">{}: {}</span></li>\n",
                        to_text(c.held), c.sentence, c.source, c.reading, c.found);
  return html + "</ul>\n";
}

}  // namespace pelage
