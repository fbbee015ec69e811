// Helpers for tests of claims: rows of results with synthetic times, and claims as TOML text.
#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

#include "harness/claims/judge.hpp"
#include "tests/support/fake.hpp"

namespace pelage::claims::test {

using Axes = std::map<std::string, std::string>;

/// Returns a row of the experiment "own" with the status `ok` and 11 frame times from 0.99 `ms` to 1.01 `ms`.
inline FoundRow row(const Axes& axes, double ms, const std::string& run = "run") {
  FoundRow found;
  Row& row = found.row;
  row.run_id = run;
  row.experiment = "own";
  for (const auto& [axis, value] : axes) row.case_name += (row.case_name.empty() ? "" : "-") + value;
  row.variant = "shells";
  row.axes = axes;
  row.device = "device";
  for (int i = -5; i <= 5; ++i) row.samples["frame"].wall_ms.push_back(ms * (1 + 0.002 * i));
  row.provenance = {{"host", "h"}};
  return found;
}

/// Returns the rows of two models with 16 and 64 layers. By default, their frame times are 10, 30, 20 and 40
/// ms.
inline std::vector<FoundRow> layers_and_models(double b_16 = 20, double b_64 = 40) {
  return {row({{"layers", "16"}, {"model", "a"}}, 10), row({{"layers", "64"}, {"model", "a"}}, 30),
          row({{"layers", "16"}, {"model", "b"}}, b_16), row({{"layers", "64"}, {"model", "b"}}, b_64)};
}

/// Which rows decide a claim, and the spread between processes that the claims of the tests assume.
constexpr const char *own = "experiment = \"own\"", *no_spread = "process_spread = 0.0\n",
                     *some_spread = "process_spread = 0.07\n";

inline ClaimFile file_of(const std::string& text) {
  const pelage::test::Folder folder;
  folder.write("claims.toml", text);
  return read_claims(folder.path / "claims.toml");
}

inline std::string claim_text(const std::string& effect, const std::string& relation,
                              const std::string& rows = own) {
  return fmt::format(
      "[[claim]]\nid = \"c\"\nstatement = \"s\"\nrows = {{ {} }}\neffect = {{ {} }}\nrelation = {}\n", rows,
      effect, relation);
}

/// Returns the verdict on one claim about the experiment "own". All rows must be of one device.
inline Judged judged(const std::vector<FoundRow>& rows, const std::string& effect,
                     const std::string& relation, const std::string& which = own,
                     const std::string& settings = no_spread) {
  const std::vector<Judged> all = judge(file_of(settings + claim_text(effect, relation, which)), rows);
  EXPECT_EQ(all.size(), 1u);
  return all.front();
}

}  // namespace pelage::claims::test
