// Tests the subjects that draw strands: the smoke preset of the experiment on their number, alone and in
// turns with the OpenGL baseline.
#include <gtest/gtest.h>

#include "harness/error.hpp"
#include "harness/measure/runner.hpp"
#include "harness/strands/opengl/ribbons.hpp"
#include "harness/subjects/pipelines.hpp"

namespace pelage {
namespace {

TEST(StrandSubjects, DrawCheckedPicturesInTurnsWithOpenGl) {
  const Experiment experiment = read_experiment(experiment_file("demoreuille2011-scaling"));
  const Preset& preset = preset_of(experiment, "smoke");
  const auto context = make_context(cl::choose_device(""), experiment, {}, [](const std::string&) {});
  RunPlan plan;
  plan.experiment = experiment.name;
  plan.device = "device";
  plan.provenance = nlohmann::ordered_json::object();
  std::size_t rows = 0;
  for (const Case& which : cases_of(experiment, preset)) {
    SCOPED_TRACE(which.name);
    const Row row = run_case(plan, which, preset.limits, subjects_of(context));
    if (row.status == Status::unsupported && which.pipeline == "strands+opengl") continue;
    ++rows;
    ASSERT_EQ(row.status, Status::ok) << row.reason;
    EXPECT_EQ(row.metrics.at("strands").value, 10000);
    EXPECT_GT(row.metrics.at("drawn_strands").value, 1000);
    EXPECT_EQ(row.samples.contains("simulate"), which.pipeline == "strands");
    EXPECT_EQ(row.metrics.contains("opengl_ratio"), which.pipeline == "strands+opengl");
    for (const char* program : {"strands/chain/chain.cl", "strands/draw/keys.cl", "strands/draw/bins.cl"})
      EXPECT_TRUE(row.identity.contains(std::string("kernel ") + program)) << program;
  }
  EXPECT_GE(rows, 1u);
}

TEST(StrandSubjects, OptionsOfTheBaselineAreChecked) {
  EXPECT_EQ(strands::to_text(strands::ribbon_options("")), "expand=instanced,target=rgba32f");
  EXPECT_EQ(strands::to_text(strands::ribbon_options("target=rgba8,expand=indexed")),
            "expand=indexed,target=rgba8");
  for (const char* wrong : {"expand=lines", "target", "colour=red", "expand=indexed,,"})
    EXPECT_THROW(strands::ribbon_options(wrong), InputError) << wrong;
}

}  // namespace
}  // namespace pelage
