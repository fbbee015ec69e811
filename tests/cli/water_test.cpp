// Tests pelage water, and a scene whose water changes over time in the pipelines of pelage render.
#include <algorithm>
#include <sstream>
#include <vector>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

using Table = std::vector<std::vector<double>>;

Table numbers(const std::string& text) {
  Table table;
  std::istringstream lines(text);
  std::string line, value;
  std::getline(lines, line);
  EXPECT_EQ(line, "time_s,droplets,fell,unsoaked,held,evaporated,dripped");
  while (std::getline(lines, line)) {
    table.emplace_back();
    std::istringstream values(line);
    while (std::getline(values, value, ',')) table.back().push_back(std::stod(value));
    EXPECT_EQ(table.back().size(), 7u) << line;
  }
  return table;
}

struct WaterCommand : InFolder {};

TEST_F(WaterCommand, WritesTheAccountOfTheExample) {
  const Outcome printed = done("water rain --model torus --to 10 --fps 4");
  const Table table = numbers(printed.out);
  ASSERT_EQ(table.size(), 41u);
  double most = 0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::vector<double>& row = table[i];
    EXPECT_DOUBLE_EQ(row[0], double(i) / 4);
    EXPECT_NEAR(row[2], row[3] + row[4] + row[5] + row[6], 1e-7 * row[2]);
    most = std::max(most, row[4]);
  }
  EXPECT_GT(most, 0.3 * table.back()[2]);
  EXPECT_EQ(table.front()[1], 0) << "the example begins dry";
  EXPECT_EQ(table.back()[1], 0) << "and ends dry";
  EXPECT_EQ(table.back()[4], 0);
  const Outcome written = done("water rain --model torus --to 10 --fps 4 --csv water.csv");
  EXPECT_EQ(written.out, "");
  EXPECT_EQ(folder.read("water.csv"), printed.out);
}

TEST_F(WaterCommand, DrawsTheAccount) {
  done("water rain --model torus --to 10 --fps 4 --csv account.svg");
  EXPECT_EQ(numbers(folder.read("account.csv")).size(), 41u);
  expect_has(folder.read("account.svg"), {"unsoaked", "held", "evaporated", "dripped", "fell", "time, s"});
  EXPECT_EQ(folder.read("account.pdf").substr(0, 5), "%PDF-");
}

TEST_F(WaterCommand, UsesTheKeyframesOfItsTimes) {
  folder.write(
      "k.toml",
      "model = 'torus'\n[wetness]\nrandom = 50\nsoak = 1.0\n[keyframes]\n'wetness.radius' = [[0, 0.01], [1, 0.02]]\n");
  const Table table = numbers(done("water k.toml --to 1 --fps 1").out);
  ASSERT_EQ(table.size(), 2u);
  EXPECT_GT(table[1][2], 2 * table[0][2]) << "the discs are larger";
}

}  // namespace
}  // namespace pelage::cli
