// pelage compare: finds the cases that became slower or faster between two sets of results.
#include "harness/commands/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/error.hpp"
#include "harness/report/comparison.hpp"

namespace pelage {
namespace {

struct CompareOptions {
  std::string a, b, by, threshold = "5%";
  bool fail_on_regression = false, json = false;
};

std::string milliseconds(double value) {
  return value > 0 ? fmt::format("{:.3f}", value) : "-";
}

void print(const std::vector<Pair>& pairs, const CompareOptions& options) {
  if (options.json) {
    auto list = nlohmann::ordered_json::array();
    for (const Pair& p : pairs)
      list.push_back({{"case", p.name},
                      {"a", p.a},
                      {"b", p.b},
                      {"a_ms", p.a_ms},
                      {"b_ms", p.b_ms},
                      {"change", p.change},
                      {"verdict", to_text(p.verdict)}});
    fmt::print("{}\n", list.dump(2));
    return;
  }
  for (const Pair& p : pairs)
    fmt::print("{:>10} {:>10} {:>+8.1f}%  {:7} {}{}\n", milliseconds(p.a_ms), milliseconds(p.b_ms),
               100 * p.change, to_text(p.verdict), p.name,
               options.by.empty() ? "" : fmt::format("  ({} -> {})", p.a, p.b));
}

int compare(const CompareOptions& options) {
  const CompareBy by(options.by);
  const double threshold = threshold_from_text(options.threshold);
  const bool one_set = options.b.empty();
  if (one_set && by.text.empty())
    throw InputError(
        "give two sets of results (A and B), or one set with --by device, --by variant or --by axes.KEY");
  const std::vector<Cell> a = cells_of(read_results({options.a}));
  const std::vector<Cell> b = one_set ? a : cells_of(read_results({options.b}));
  const std::vector<Pair> pairs = compare_cells(a, b, one_set, by, threshold);
  print(pairs, options);
  const auto count = [&](Verdict v) {
    return std::count_if(pairs.begin(), pairs.end(), [v](const Pair& p) { return p.verdict == v; });
  };
  fmt::print(stderr, "pelage: {} faster, {} slower, {} without a time in B, {} unchanged (threshold {})\n",
             count(Verdict::faster), count(Verdict::slower), count(Verdict::lost), count(Verdict::same),
             options.threshold);
  const bool regressed = count(Verdict::slower) + count(Verdict::lost) > 0;
  return options.fail_on_regression && regressed ? 5 : 0;
}

}  // namespace

void add_compare(CLI::App& app, Chosen& chosen) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare", "Compare two sets of results, case by case");
  command->add_option("a", options->a, "First set of results")->required()->type_name("A");
  command
      ->add_option("b", options->b,
                   "Second set of results; without it, --by compares results of A with each other")
      ->type_name("B");
  command->add_option("--by", options->by, "Property in which the two results of a comparison may differ")
      ->type_name("device|variant|axes.KEY");
  command
      ->add_option("--threshold", options->threshold,
                   "Smallest relative change of the median time that counts as faster or slower")
      ->type_name("5%")
      ->capture_default_str();
  command->add_flag("--fail-on-regression", options->fail_on_regression,
                    "Exit with code 5 if a case is slower in B or has no time in B");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &chosen] { chosen = [options] { return compare(*options); }; });
}

}  // namespace pelage
