// Tests the experiments of the papers' figures, and the collections of experiments.
#include <algorithm>
#include <set>

#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

std::vector<Experiment> figures() {
  std::vector<Experiment> found;
  for (const fs::path& file : experiments_named("figures")) found.push_back(read_experiment(file));
  return found;
}

TEST(FigureExperiments, AreAllExperimentsNamedAfterAFigure) {
  std::set<std::string> named, collected;
  for (const fs::path& file : experiment_files())
    if (file.stem().string().find("-fig") != std::string::npos) named.insert(file.stem().string());
  for (const Experiment& e : figures()) collected.insert(e.name);
  EXPECT_EQ(collected, named);
  EXPECT_EQ(collected.size(), 16u);
}

TEST(FigureExperiments, AreDrawnWithTheReadingsOfTheSharedScene) {
  for (const Experiment& e : figures()) {
    EXPECT_EQ(e.scene_file.filename(), "figures.toml") << e.name;
    for (const Case& which : cases_of(e, preset_of(e, "quick"))) {
      const Scene scene = scene_of(e, which);
      EXPECT_EQ(scene.blend.faces, "back-then-front") << which.name;
      EXPECT_EQ(scene.clump.scale, "converge") << which.name;
      EXPECT_EQ(scene.clump.cells, "consistent") << which.name;
      EXPECT_EQ(scene.shading.tangent, "strand") << which.name;
      EXPECT_EQ(scene.wetness.blend, "overlap") << which.name;
      EXPECT_EQ(scene.wetness.seams, "joined") << which.name;
      EXPECT_EQ(scene.shading.model, e.paper == "silva2010-wet-fur" ? "wet" : "curling") << which.name;
    }
  }
}

TEST(Collections, AWordThatIsNoCollectionIsAnExperiment) {
  ASSERT_EQ(experiments_named("layers").size(), 1u);
  EXPECT_EQ(experiments_named("layers").front().stem(), "layers");
  EXPECT_THROW(experiments_named("figurez"), InputError);
  EXPECT_THROW(experiments_named("figures.toml"), InputError);
}

TEST(Collections, AFolderOfTheUserReplacesTheShippedExperiments) {
  const test::Folder own;
  setenv("PELAGE_DATA", own.path.c_str(), 1);
  EXPECT_EQ(experiment_file("layers").stem(), "layers");  // the folder has no experiments yet
  fs::create_directory(own.path / "experiments");
  const std::vector<fs::path> files{own.write("experiments/a.toml", "not TOML")};
  EXPECT_EQ(experiment_files(), files);
  EXPECT_EQ(experiments_named("a"), files);  // reads no file, because no collection is searched
  unsetenv("PELAGE_DATA");
}

}  // namespace
}  // namespace pelage
