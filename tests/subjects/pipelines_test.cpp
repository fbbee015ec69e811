// Tests the table of pipelines, and the experiments with the OpenGL baseline.
#include "harness/subjects/pipelines.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "harness/scene/scene_toml.hpp"
#include "harness/shells/opengl/opengl.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

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
// 2010). The test skips plain shells.
TEST(Baselines, MeetOnTheSceneOfTable1) {
  const std::filesystem::path folder = std::filesystem::path(PELAGE_SOURCE_DIR) / "experiments";
  const Experiment table = read_experiment(folder / "silva2010-table1.toml");
  std::map<std::string, std::string> expected;
  for (const Case& which : cases_of(table, preset_of(table, "recorded")))
    expected[which.name] = scene_hash(scene_of(table, which));
  const auto compare_with = [&](const char* file, const char* preset, std::size_t cells) {
    const Experiment rivals = read_experiment(folder / file);
    std::size_t compared = 0;
    for (const Case& which : cases_of(rivals, preset_of(rivals, preset))) {
      if (which.axes.contains("effects") && which.axes.at("effects") != "all") continue;
      const std::string cell = which.axes.at("model") + "-" + which.axes.at("layers") + "-" +
                               which.axes.at("size") + (which.axes.at("reading") == "paper" ? "" : "-pelage");
      ASSERT_TRUE(expected.contains(cell)) << cell;
      EXPECT_EQ(scene_hash(scene_of(rivals, which)), expected.at(cell)) << which.name;
      test::expect_has(which.pipeline, "opengl");
      ++compared;
    }
    EXPECT_EQ(compared, cells) << file;
  };
  compare_with("rivals.toml", "paper", 64);
  compare_with("rivals.toml", "quick", 32);
  compare_with("rivals-strongest.toml", "quick", 32);
  compare_with("rival-options.toml", "quick", 18);
}

TEST(Baselines, EveryWritingOfTheExperimentIsOne) {
  const Experiment options =
      read_experiment(std::filesystem::path(PELAGE_SOURCE_DIR) / "experiments" / "rival-options.toml");
  std::set<std::string> written;
  for (const Case& which : cases_of(options, preset_of(options, "paper")))
    written.insert(to_text(opengl_options(which.opengl)));
  EXPECT_EQ(written.size(), 9u);
}

}  // namespace
}  // namespace pelage
