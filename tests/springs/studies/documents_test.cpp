// Checks that the errors of the solvers in docs/springs.md are equal to the errors in the recorded results.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
const fs::path root = PELAGE_SOURCE_DIR;

// Reads the errors of `solver` with steps of 1/60 s from the recorded results. Returns one error per
// topology, in percent of the fur's length.
std::map<std::string, double> errors(const std::string& solver, const std::string& norm) {
  std::map<std::string, double> found;
  for (const auto& file : fs::directory_iterator(root / "results/banisch2006-work-precision")) {
    std::ifstream stream(file.path());
    for (std::string line; std::getline(stream, line);) {
      const auto row = nlohmann::json::parse(line);
      const auto& axes = row["axes"];
      const auto& written = axes["dynamics.step"];  // a number in old results, a string in new results
      const double step = written.is_string() ? std::stod(written.get<std::string>()) : written.get<double>();
      if (row["status"] != "ok" || axes["dynamics.solver"] != solver || std::abs(step - 1.0 / 60) > 1e-6)
        continue;
      found[axes["dynamics.topology"]] = 100 * row["metrics"]["error_" + norm]["value"].get<double>();
    }
  }
  return found;
}

// Returns text such as "2.0% of the fur's length on prisms and 4.7 to 4.8% on the other topologies".
std::string words(std::map<std::string, double> errors, int digits, const std::string& of) {
  EXPECT_EQ(errors.size(), 4u);
  const double prisms = errors["prisms"];
  errors.erase("prisms");
  const auto [least, most] = std::minmax_element(
      errors.begin(), errors.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return fmt::format("{:.{}f}%{} on prisms and {:.{}f} to {:.{}f}% on the other topologies", prisms, digits,
                     of, least->second, digits, most->second, digits);
}

TEST(Documents, ErrorsAreThoseOfTheRows) {
  std::ifstream stream(root / "docs/springs.md");
  const std::string text =
      std::regex_replace(std::string{std::istreambuf_iterator<char>(stream), {}}, std::regex("\\s+"), " ");
  for (const auto& [name, solver, digits] :
       {std::tuple("backward Euler", "backward-euler", 1), std::tuple("RK4", "rk4", 2)}) {
    const std::string expected =
        fmt::format("the rms error of {} is {}, and its 99th percentile is {}.", name,
                    words(errors(solver, "rms"), digits, " of the fur's length"),
                    words(errors(solver, "p99"), digits, ""));
    EXPECT_NE(text.find(expected), std::string::npos) << "docs/springs.md must say: " << expected;
  }
}

}  // namespace
