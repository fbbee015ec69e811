// A subject is an object whose frames an experiment times. This file tests the subject that draws frames with
// two pipelines alternately, and the experiments that use this subject.
#include "harness/shells/opengl/opengl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "harness/measure/runner.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/subjects/pipelines.hpp"
#include "harness/subjects/with_opengl.hpp"

namespace pelage {
namespace {

/// A subject that draws a grey square. Its frames take 10 * factor ms, 11 * factor ms, 12 * factor ms, ...
class Grey : public Subject {
 public:
  Grey(double factor, float grey, std::string* order) : factor_(factor), grey_(grey), order_(order) {}
  FrameSample frame() override {
    *order_ += factor_ > 1 ? 'r' : 'o';
    return {factor_ * (10.0 + frames_++), {}};
  }
  Picture read() override { return {2, 2, std::vector<glm::vec4>(4, glm::vec4(grey_, grey_, grey_, 1.0f))}; }
  std::vector<Check> check(const Picture&) override { return {{"reference", "psnr", 80, 60, true}}; }
  void describe(Row& row) override {
    row.build_ms = factor_;
    row.metrics["triangles"] = {12, "triangles"};
    row.provenance[factor_ > 1 ? "rival_says" : "ours_says"] = "here";
  }

 private:
  double factor_;
  float grey_;
  std::string* order_;
  int frames_ = 0;
};

Row fought(float rivals_grey, std::string* order) {
  RunPlan plan;
  plan.experiment = "duels";
  plan.device = "none";
  plan.provenance = nlohmann::ordered_json::object();
  Case which;
  which.name = "case";
  which.variant = "shells+opengl";
  return run_case(plan, which, {0, 6, 6, 1.0, 10}, [&](const Case&) {
    return with_opengl(std::make_unique<Grey>(1.0, 0.5f, order),
                       std::make_unique<Grey>(8.0, rivals_grey, order));
  });
}

TEST(Duel, AlternatesAndGivesTheRatioOfEveryRound) {
  std::string order;
  const Row row = fought(0.5f, &order);
  // A round draws one frame with our pipeline (o) and then one frame with the baseline (r). There are eight
  // rounds: the first launch, one warm-up round, and six samples.
  EXPECT_EQ(order, "orororororororor");
  ASSERT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_EQ(row.samples.at("frame").wall_ms, (std::vector<double>{12, 13, 14, 15, 16, 17}));
  EXPECT_EQ(row.samples.at("opengl").wall_ms, (std::vector<double>{96, 104, 112, 120, 128, 136}));
  const Metric ratio = row.metrics.at("opengl_ratio");
  EXPECT_DOUBLE_EQ(ratio.value, 8.0);
  EXPECT_DOUBLE_EQ(ratio.low.value(), 8.0);
  EXPECT_DOUBLE_EQ(ratio.high.value(), 8.0);
  EXPECT_EQ(row.build_ms, 1.0);
  EXPECT_EQ(row.metrics.at("opengl_build_ms").value, 8.0);
  EXPECT_TRUE(row.provenance.contains("ours_says") && row.provenance.contains("rival_says"));
  EXPECT_EQ(row_from_line(to_line(row)).metrics.at("opengl_ratio").low, ratio.low);
}

TEST(Duel, AnotherPictureHasNoTime) {
  std::string order;
  const Row row = fought(0.498f, &order);  // the PSNR between the two pictures is 54 dB
  EXPECT_EQ(row.status, Status::failed_check);
  EXPECT_NE(row.reason.find("psnr against opengl is 53.97"), std::string::npos) << row.reason;
  EXPECT_TRUE(row.samples.empty());
}

TEST(Pipelines, AnUnknownOneIsUnsupported) {
  Case which;
  which.pipeline = "no-such-pipeline";
  try {
    subjects_of(make_context(cl::choose_device(""), {}, {}, {}))(which);
    ADD_FAILURE() << "a subject was made";
  } catch (const Unsupported& refusal) {
    EXPECT_STREQ(refusal.what(), "this build has no pipeline 'no-such-pipeline'");
  }
}

// The table of pipelines must contain every pipeline that a shipped experiment uses.
TEST(Pipelines, OfTheExperimentsAreThere) {
  std::set<std::string> known;
  for (const std::string_view name : pipelines()) EXPECT_TRUE(known.insert(std::string(name)).second);
  std::set<std::string> named;
  for (const std::filesystem::path& file : experiment_files()) {
    const Experiment experiment = read_experiment(file);
    for (const Case& which : cases_of(experiment, preset_of(experiment, "quick")))
      named.insert(which.pipeline);
  }
  EXPECT_TRUE(std::includes(known.begin(), known.end(), named.begin(), named.end()));
  EXPECT_GE(named.size(), 5u);
}

// The experiments with the baseline must draw the scenes of silva2010-table1.toml (Table 1 of Silva et al.
// 2010). The test skips cases in which the axis `reading` is not "default".
TEST(Rivals, MeetOnTheSceneOfTable1) {
  const std::filesystem::path folder = std::filesystem::path(PELAGE_SOURCE_DIR) / "experiments";
  const Experiment table = read_experiment(folder / "silva2010-table1.toml");
  std::map<std::string, std::string> expected;
  for (const Case& which : cases_of(table, preset_of(table, "quick")))
    expected[which.name] = scene_hash(scene_of(table, which));
  const auto compare_with = [&](const char* file, const char* preset, std::size_t cells) {
    const Experiment rivals = read_experiment(folder / file);
    std::size_t compared = 0;
    for (const Case& which : cases_of(rivals, preset_of(rivals, preset))) {
      if (which.axes.contains("reading") && which.axes.at("reading") != "default") continue;
      const std::string cell =
          which.axes.at("model") + "-" + which.axes.at("layers") + "-" + which.axes.at("size");
      ASSERT_TRUE(expected.contains(cell)) << cell;
      EXPECT_EQ(scene_hash(scene_of(rivals, which)), expected.at(cell)) << which.name;
      EXPECT_NE(which.pipeline.find("opengl"), std::string::npos);
      ++compared;
    }
    EXPECT_EQ(compared, cells) << file;
  };
  compare_with("rivals.toml", "paper", 32);
  compare_with("rivals.toml", "quick", 32);
  compare_with("rivals-strongest.toml", "quick", 32);
  compare_with("rival-options.toml", "quick", 18);
}

TEST(Rivals, EveryWritingOfTheExperimentIsOne) {
  const Experiment options =
      read_experiment(std::filesystem::path(PELAGE_SOURCE_DIR) / "experiments" / "rival-options.toml");
  std::set<std::string> written;
  for (const Case& which : cases_of(options, preset_of(options, "paper")))
    written.insert(to_text(opengl_options(which.opengl)));
  EXPECT_EQ(written.size(), 9u);
}

}  // namespace
}  // namespace pelage
