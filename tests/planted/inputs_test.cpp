// Tests that pelage detects a changed input: each test changes an input of an experiment after some rows were
// measured. The first table of docs/results.md lists these tests.
#include "tests/planted/runs.hpp"

namespace pelage::planted {
namespace {

TEST_F(Planted, EditedScene) {
  take("base");
  folder.edit("own.toml", "fur.length = 0.1", "fur.length = 0.12");
  refused(resume(), "measured something else: scene was ");
}

TEST_F(Planted, EditedKernel) {
  take("base");
  edit_kernel("dialect.clh", "\n", "\n// edited\n");
  refused(resume("--kernels mine"), "measured something else: kernel rasterize/");
}

TEST_F(Planted, EditedMesh) {
  take("files");
  folder.edit("own.obj", "v 1.4", "v 1.5");
  refused(resume(), "mesh was ");
}

TEST_F(Planted, EditedBufferOfAMesh) {
  take("files");
  std::string bytes = folder.read("own.bin");
  bytes[3] = '\x40';  // changes the first coordinate of the first vertex from 1.4 to about 5.6
  folder.write("own.bin", bytes);
  refused(resume(), "mesh was ");
}

TEST_F(Planted, EditedTexture) {
  take("files");
  write_red(path("own.png"), 0.1F);
  refused(resume(), "measured something else: scene was ");
}

TEST_F(Planted, EditedTuning) {
  folder.write("own.toml", base_experiment());
  folder.write("mine.toml", "SIMULATE_GROUP = 16\n");
  const std::string command = "run own.toml --filter -4- --tuning mine.toml ";
  done(command + "-o results");
  EXPECT_EQ(rows().front().tuning.at("SIMULATE_GROUP"), 16);
  folder.write("mine.toml", "SIMULATE_GROUP = 64\n");
  refused(pelage(command + "--resume results"), "measured something else: tuning was ");
}

TEST_F(Planted, EditedLimitsOfSampling) {
  take("base");
  folder.edit("own.toml", "most = 6", "most = 7");
  refused(resume(), "measured something else: sampling was ");
}

// With each of these environment variables, pelage must regard the device as another one. If the user has not
// set POCL_AFFINITY, pelage sets it to 1, and PoCL then pins its threads to CPU cores.
TEST_F(Planted, ChangedEnvironment) {
  take("base");
  if (!rows().front().provenance.contains("pocl_affinity"))
    GTEST_SKIP() << "the device is not PoCL's CPU device";
  // A device with one lane has another default mapping, which would be another variant with rows of its own.
  const std::string grouped = "run own.toml --filter -4- --mapping group ";
  done(grouped + "-o grouped");
  refused(pelage(grouped + "--resume grouped", "PELAGE_LANES=1"), "measured something else: device was ");
  refused(resume("", "POCL_AFFINITY=0"), "measured something else: device was ");
  refused(resume("", "POCL_WORK_GROUP_METHOD=cbs"), "measured something else: device was ");
}

TEST_F(Planted, RowsOfAnotherScene) {
  take("base");
  take("other", "second");
  EXPECT_EQ(kept_apart({path("results"), path("second")}), std::vector<std::string>{"scene"});
  for (const Cell& cell : cells_in({path("results"), path("second")}))
    EXPECT_EQ(cell.timings.processes.size(), 1U);
  expect_has(
      done("report results second -o page").err,
      "2 of 4 rows have the same names (case, variant, device and so on) as other rows but measured different inputs (scene); their files are in the folder inputs-2");
  for (const char* table : {"own", "all-phases"})
    EXPECT_TRUE(fs::exists(path("page/inputs-2/tables") / (std::string(table) + ".csv")));
}

TEST_F(Planted, MergedRunsOfDifferentScenes) {
  take("base");
  take("other", "second");
  refused(pelage("merge all results second"), "the rows measured different inputs: scene was ");
  EXPECT_FALSE(fs::exists(path("all")));
}

TEST_F(Planted, SettingsOfTheCommandLine) {
  take("base");
  const Outcome changed = done("run own.toml --filter -4- --set fur.length=0.12 -o second");
  const std::vector<Cell> cells = cells_in({path("results"), path("second")});
  ASSERT_EQ(cells.size(), 3U) << "the changed case is no part of the case with the same name";
  for (const Cell& cell : cells) EXPECT_EQ(cell.timings.processes.size(), 1U);
  done("run own.toml --filter -4- --resume second");
  EXPECT_EQ(rows("second").size(), 2U) << "the unchanged case is another case";
}

/// A row stores a hash of the compiler and its flags. This test changes the hash, so it needs no second
/// build.
TEST_F(Planted, AnotherBuild) {
  expect_apart([](Row& row) { row.identity["build"] = "0123456789abcdef"; }, "build",
               "measured something else: build was ");
}

TEST_F(Planted, RowsOfSchema1) {
  expect_apart(
      [](Row& row) {
        row.schema = 1;
        row.identity.clear();
      },
      "identity incomplete", "the row does not record the inputs of the measurement");
}

}  // namespace
}  // namespace pelage::planted
