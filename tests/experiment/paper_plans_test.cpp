// Tests the plans of the papers (experiments/papers).
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/experiment/paper_plan.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

std::vector<Case> cases_named(const std::string& experiment) {
  const Experiment read = read_experiment(experiment_file(experiment));
  return cases_of(read, preset_of(read, "quick"));
}

// The panels show only cases that exist, and all cases of the collection `figures`.
TEST(PaperPlans, ShowEveryCaseOfTheFigures) {
  std::set<std::string> shown, known;
  for (const PaperPlan& plan : paper_plans())
    for (const PaperFigure& figure : plan.figures)
      for (const FigurePanel& panel : figure.panels) {
        if (panel.experiment.empty()) continue;
        const std::vector<Case> cases = cases_named(panel.experiment);
        const std::string name = panel.name + "-640x480";
        EXPECT_TRUE(std::ranges::count(cases, name, &Case::name) == 1) << panel.experiment << " " << name;
        // The diagrams `lines` and `wind` contain the picture of the case.
        if (panel.diagram.empty() || panel.diagram == "lines" || panel.diagram == "wind")
          shown.insert(panel.experiment + " " + name);
      }
  for (const std::filesystem::path& file : experiments_named("figures")) {
    const Experiment experiment = read_experiment(file);
    for (const Case& which : cases_of(experiment, preset_of(experiment, "quick")))
      known.insert(experiment.name + " " + which.name);
  }
  EXPECT_EQ(known.size(), 39u);
  EXPECT_EQ(shown, known);
}

TEST(PaperPlans, AreOneForEachPaper) {
  std::set<std::string> papers;
  for (const PaperPlan& plan : paper_plans()) {
    EXPECT_TRUE(papers.insert(plan.paper).second);
    EXPECT_FALSE(plan.tables.empty()) << plan.name;
    for (const PaperTable& table : plan.tables) EXPECT_NO_THROW(experiment_file(table.experiment));
    const std::vector<std::string> names = experiments_of(plan, {"layers", "layers", "no-such-experiment"});
    EXPECT_EQ(std::ranges::count(names, "layers"), 1);
    EXPECT_EQ(std::ranges::count(names, "no-such-experiment"), 0);
    EXPECT_EQ(paper_plan(plan.name).title, plan.title);
    EXPECT_EQ(paper_plan(plan.paper).name, plan.name);
  }
  EXPECT_EQ(papers.size(), 4u);
}

TEST(PaperPlans, WithErrorsNameTheLine) {
  const test::Folder folder;
  std::filesystem::create_directories(folder.path / "experiments/papers");
  folder.write("experiments/mine.toml", "");
  setenv("PELAGE_DATA", folder.path.c_str(), 1);
  const auto refusal = [&](const std::string& text) {
    folder.write("experiments/papers/mine.toml", text);
    try {
      paper_plans();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::string head = "paper = \"p\"\ntitle = \"t\"\nauthors = \"a\"\n";
  EXPECT_EQ(refusal(head), "accepted");
  test::expect_has(refusal("paper = \"p\"\n"), "title = \"...\" is missing");
  test::expect_has(refusal(head + "more = 1\n"), "mine.toml:4: the key more is unknown");
  test::expect_has(refusal(head + "[[figure]]\ntitle = \"f\"\ncaption = \"c\"\n"),
                   "differs = \"...\" is missing");
  test::expect_has(refusal(head + "[[figure]]\ntitle = \"f\"\ncaption = \"c\"\ndiffers = \"d\"\n"),
                   "a figure needs panels");
  test::expect_has(
      refusal(head +
              "[[figure]]\ntitle = \"f\"\ncaption = \"c\"\ndiffers = \"d\"\npanels = [{ label = \"l\" }]\n"),
      "either experiment and case, or scene");
  EXPECT_EQ(refusal(head), "accepted");
  try {
    paper_plan("silva");
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    test::expect_has(error.what(), "silva: no such paper; known: mine");
  }
  unsetenv("PELAGE_DATA");
}

}  // namespace
}  // namespace pelage
