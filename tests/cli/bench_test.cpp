// Runs pelage-bench on a small picture. The JSON output of Google Benchmark must contain the time and the
// counters of every kernel.
#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/shell.hpp"

#ifdef PELAGE_BENCH  // CMake defines PELAGE_BENCH if it builds pelage-bench

namespace pelage::cli {
namespace {

const std::filesystem::path bench = std::filesystem::path(PELAGE_BINARY).parent_path() / "pelage-bench";

Outcome run(const Folder& folder, const std::string& arguments) {
  return pelage(folder, arguments, "", bench.string());
}

TEST(Bench, EveryKernelHasATimeAndItsCounters) {
  const Folder folder;
  const Outcome outcome = run(
      folder,
      "--set model=torus --set image.width=96 --set image.height=64 --set fur.layers=4 --set fur.texture=64 --set wetness.random=20 --seconds 0.01 --benchmark_format=json --benchmark_out=out.json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(folder.read("out.json"));
  EXPECT_TRUE(json.at("context").contains("kernel_hash"));
  std::map<std::string, nlohmann::json> rows;
  for (const auto& row : json.at("benchmarks")) {
    const std::string name = row.at("name");
    EXPECT_FALSE(row.contains("error_occurred")) << row;
    EXPECT_GT(row.at("real_time"), 0) << name;
    EXPECT_EQ(row.at("time_unit"), "ms");
    rows[name.substr(0, name.find('/'))] = row;
  }
  for (const char* kernel :
       {"frame", "strand_frame", "wetness_mask", "vertex_tips", "layer_vertices", "vertex_records",
        "bin_count", "bin_sum", "bin_start", "bin_fill", "tile_shells"})
    EXPECT_TRUE(rows.contains(kernel)) << kernel;
  for (const auto& [name, row] : rows)
    EXPECT_GT(name == "frame" ? 1.0 : row.at("bytes_per_second").get<double>(), 0) << name;
  for (const char* counter : {"covered", "shaded", "blended"})
    EXPECT_GT(rows.at("tile_shells").at(counter), 0) << counter;
  EXPECT_GE(rows.at("tile_shells").at("covered"), rows.at("tile_shells").at("shaded"));
  EXPECT_GE(rows.at("tile_shells").at("shaded"), rows.at("tile_shells").at("blended"));
}

TEST(Bench, BadUsageIsExitTwo) {
  const Folder folder;
  EXPECT_EQ(run(folder, "--no-such-option").code, 2);
  EXPECT_EQ(run(folder, "--set fur.layers=0").code, 2);
  EXPECT_EQ(run(folder, "no-such-scene.toml").code, 2);
}

}  // namespace
}  // namespace pelage::cli

#endif  // PELAGE_BENCH
