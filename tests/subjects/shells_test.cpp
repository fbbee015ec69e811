// Tests what the OpenCL and the OpenGL pipeline write into a row of results.
#include "harness/shells/opencl/shells.hpp"

#include "harness/measure/runner.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/subjects/frames.hpp"
#include "harness/subjects/pipelines.hpp"
#include "tests/support/fake.hpp"

namespace pelage {
namespace {

constexpr const char* small_scene =
    "name = 'one'\ntitle = 'one'\n[axes]\nmodel = ['torus']\nlayers = [4]\nsize = ['320x240']\n"
    "[scene]\nfur.texture = 64\nwetness.random = 50\n"
    "[preset.quick]\nwarm_up_s = 0.0\nleast = 3\nmost = 3\nprecision = 1.0\nlimit_s = 20.0\n";

struct OneRow {
  test::Folder folder;
  cl::Device device = cl::choose_device("");
  Experiment experiment;
  Case which;
  Row row;

  explicit OneRow(const std::string& pipeline = "shells") {
    folder.write("one.toml", small_scene);
    experiment = read_experiment(folder.path / "one.toml");
    const Preset& preset = preset_of(experiment, "quick");
    which = cases_of(experiment, preset).front();
    which.pipeline = pipeline;
    RunPlan plan = test::fake_plan(1);
    plan.cases = {which};
    row = run_case(plan, which, preset.limits, subjects_of(make_context(device, experiment, {}, {})));
    EXPECT_TRUE(row.status == Status::ok || (row.status == Status::unsupported && pipeline != "shells"))
        << row.reason;
  }
};

void expect_cpu_times(const Row& row, const std::string& phase) {
  const PhaseSamples& samples = row.samples.at(phase);
  ASSERT_EQ(samples.cpu_ms.size(), samples.wall_ms.size()) << phase;
  for (const double ms : samples.cpu_ms) EXPECT_GT(ms, 0) << phase;
}

TEST(ShellsRow, HasTheKernelHashOfItsShellsAndTheCpuTimeOfEveryFrame) {
  const OneRow one;
  const Scene scene = scene_of(one.experiment, one.which);
  const Shells shells(one.device, prepare(scene, load_scene_mesh(scene, {})));
  EXPECT_EQ(one.row.provenance.at("kernel_hash").get<std::string>(), shells.kernel_hash());
  expect_cpu_times(one.row, "frame");
}

TEST(ShellsRow, HasTheTimeOfTheKernelsThatRunOncePerMaskApartFromTheFrame) {
  const OneRow one;
  ASSERT_TRUE(one.row.metrics.contains("per_mask_ms"));
  EXPECT_GT(one.row.metrics.at("per_mask_ms").value, 0);
  EXPECT_EQ(one.row.metrics.at("per_mask_ms").unit, "ms");
  for (const auto& [phase, samples] : one.row.samples)
    EXPECT_TRUE(phase == "frame" || phase == "simulate" || phase == "transform" || phase == "bin" ||
                phase == "raster")
        << phase;
}

TEST(OpenGlRow, HasTheCpuTimeOfEveryFrameAndTheWarningsOfTheMesh) {
  const OneRow one("opengl");
  if (one.row.status == Status::unsupported) GTEST_SKIP() << one.row.reason;
  expect_cpu_times(one.row, "frame");
  EXPECT_TRUE(one.row.provenance.contains("mesh_warnings"));
}

TEST(DuelRow, HasTheCpuTimeOfBothPipelines) {
  const OneRow one("shells+opengl");
  if (one.row.status == Status::unsupported) GTEST_SKIP() << one.row.reason;
  for (const char* phase : {"frame", "opengl"}) expect_cpu_times(one.row, phase);
}

TEST(SimulationTimes, TakeTheMeanOfTheTwoMiddleTimes) {
  SimulationTimes times;
  for (const double ms : {4.0, 1.0, 2.0, 9.0}) times.add({10, {{"simulate", ms}}});
  Row row;
  times.describe(row, 1000);
  EXPECT_EQ(row.metrics.at("simulate_ns_per_segment").value, 1e6 * 3 / 1000);
}

}  // namespace
}  // namespace pelage
