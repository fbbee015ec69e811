#include "harness/experiment/experiment.hpp"

#include <algorithm>

#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using test::refusal;

const fs::path kExperiments = fs::path(PELAGE_SOURCE_DIR) / "experiments";

Experiment table1() {
  return read_experiment(kExperiments / "silva2010-table1.toml");
}

Experiment read_text(const std::string& text) {
  const test::Folder folder;
  return read_experiment(folder.write("e.toml", text));
}

std::string refusal_of(const std::string& text) {
  return refusal([&] { read_text(text); });
}

TEST(Experiment, TableOneIsThePapersThirtyTwoCells) {
  const Experiment e = table1();
  const std::vector<Case> cases = cases_of(e, preset_of(e, "quick"));
  EXPECT_EQ(cases.size(), 32u);
  double sum = 0;
  int censored = 0;
  for (const Case& c : cases) {
    ASSERT_TRUE(c.published) << c.name;
    sum += c.published->value;
    censored += c.published->relation == "<";
    const Scene scene = scene_of(e, c);
    EXPECT_EQ(scene.fur.texture, 256);
    EXPECT_EQ(scene.wetness.size, 256);
    EXPECT_GT(scene.curl.radius, 0);
    EXPECT_GT(scene.dynamics.wind.gust, 0);
    EXPECT_TRUE(scene.camera.framed);
  }
  // The frame rates are copied by hand from Table 1 of Silva et al. 2010. The number 1 stands for "< 1".
  EXPECT_EQ(sum, 267 + 117 + 256 + 117 + 154 + 80 + 78 + 63 + 66 + 52 + 24 + 22 + 25 + 21 + 3 + 3 +  //
                     90 + 35 + 84 + 34 + 51 + 24 + 28 + 21 + 23 + 17 + 8 + 8 + 7 + 7 + 1 + 1);
  EXPECT_EQ(censored, 2);
}

TEST(Experiment, WetTableEqualsTheOtherPapersCells) {
  const Experiment wet = read_experiment(kExperiments / "wetfur2010-table1.toml");
  const Experiment curling = table1();
  const auto cases = cases_of(wet, preset_of(wet, "quick"));
  EXPECT_EQ(cases.size(), 12u);
  const auto others = cases_of(curling, preset_of(curling, "quick"));
  for (const Case& c : cases) {
    EXPECT_EQ(scene_of(wet, c).shading.model, "wet");
    const auto same = std::ranges::find_if(others, [&](const Case& o) { return o.name == c.name; });
    ASSERT_NE(same, others.end());
    EXPECT_EQ(same->published->value, c.published->value) << c.name;
  }
}

TEST(Experiment, EveryShippedCaseIsAScene) {
  for (const fs::path& file : experiment_files()) {
    const Experiment e = read_experiment(file);
    EXPECT_EQ(e.name, file.stem());
    for (const auto& [name, preset] : e.presets)
      for (const Case& c : cases_of(e, preset)) EXPECT_NO_THROW(scene_of(e, c)) << c.name;
  }
}

TEST(Experiment, LaterSettingsWin) {
  const Experiment e = table1();
  const auto cases = cases_of(e, preset_of(e, "paper"));
  EXPECT_EQ(cases.size(), 64u);
  auto scene = [&](const std::string& name) {
    return scene_of(e, *std::ranges::find_if(cases, [&](const Case& c) { return c.name == name; }));
  };
  EXPECT_FLOAT_EQ(scene("horse-16-800x600").fur.length, 0.035f);
  EXPECT_FLOAT_EQ(scene("torus-64-1680x1050").fur.length, 0.08f);
  EXPECT_EQ(scene("torus-64-1680x1050").image.width, 1680);
  EXPECT_EQ(scene("torus-64-1680x1050").fur.layers, 64);
}

TEST(Experiment, CasesHaveTheReadingOfTheirAxis) {
  const Experiment e = table1();
  for (const Case& c : cases_of(e, preset_of(e, "recorded"))) {
    const Scene scene = scene_of(e, c);
    const bool paper = c.axes.at("reading") == "paper";
    EXPECT_EQ(c.name.ends_with("-pelage"), !paper) << c.name;
    EXPECT_EQ(scene.clump.cells, paper ? "literal" : "consistent") << c.name;
    EXPECT_EQ(scene.fur.comb == 0, paper) << c.name;
    EXPECT_EQ(scene.shading.lights.size(), paper ? 1u : 2u) << c.name;
    EXPECT_EQ(scene.curl.radius, c.axes.at("model") == "horse" ? .005f : .012f) << c.name;
  }
  const std::vector<Case> pelage = cases_of(e, preset_of(e, "quick"), Overrides{.reading = "pelage"});
  EXPECT_EQ(pelage.size(), 32u);
  for (const Case& c : pelage)
    EXPECT_TRUE(c.published && c.overrides.empty() && c.name.ends_with("-pelage")) << c.name;
}

// An experiment of a user's own needs no tables. A table of another axis overrides the reading.
TEST(Experiment, AnyExperimentCanBeReadAsThePaper) {
  const Experiment e = read_text(
      "name = \"e\"\n[axes]\nfur = [\"loose\", \"combed\"]\n[scene]\nshading.model = \"wet\"\n"
      "[fur.combed]\nfur.comb = 0.4\n[preset.quick]\nleast = 3\n");
  const std::vector<Case> cases = cases_of(e, preset_of(e, "quick"), Overrides{.reading = "paper"});
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].name, "loose-paper");
  EXPECT_EQ(scene_of(e, cases[0]).shading.tangent, "printed");
  EXPECT_EQ(scene_of(e, cases[0]).fur.comb, 0);
  EXPECT_EQ(scene_of(e, cases[1]).fur.comb, .4f);
  EXPECT_EQ(control_case(e, cases[1]).axes.at("reading"), "paper");
  EXPECT_EQ(control_case(e, cases[1]).axes.at("fur"), "loose");
}

// `baseline` names the axes that the control scene sets to their first values: others keep theirs, and axes
// of numbers can be among them.
TEST(Experiment, TheBaselineNamesItsAxes) {
  const std::string rest =
      "[axes]\nlayers = [4, 8]\nfur = [\"loose\", \"combed\"]\nplace = [\"near\", \"far\"]\n"
      "[fur.combed]\nfur.comb = 0.4\n[place.far]\nfur.length = 0.3\n[preset.quick]\nleast = 3\n";
  const auto control = [&](const std::string& baseline) {
    const Experiment e = read_text("name = \"e\"\n" + baseline + rest);
    return control_case(e, cases_of(e, preset_of(e, "quick")).back()).axes;
  };
  using Axes = std::map<std::string, std::string>;
  const auto with = [](const char* layers, const char* fur, const char* place) {
    return Axes{{"layers", layers}, {"fur", fur}, {"place", place}};
  };
  const auto expect = [](Axes found, const Axes& wanted) {
    found.erase("variant");
    EXPECT_EQ(found, wanted);
  };
  expect(control(""), with("8", "loose", "near"));
  expect(control("baseline = \"fur\"\n"), with("8", "loose", "far"));
  expect(control("baseline = [\"layers\", \"place\"]\n"), with("4", "combed", "near"));
  try {
    control("baseline = [\"coat\"]\n");
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    test::expect_has(error.what(), ":2: baseline: there is no axis coat");
  }
}

TEST(Experiment, OverridesAreRecordedAndLeaveThePapersTable) {
  const Experiment e = table1();
  Overrides o;
  o.set = {{"fur.length", "0.05"}};
  o.axes = {{"layers", {"8"}}, {"coat.pattern", {"plain", "spots"}}};
  o.model = "bunny";
  const auto cases = cases_of(e, preset_of(e, "quick"), o);
  ASSERT_EQ(cases.size(), 4u);
  for (const Case& c : cases) {
    EXPECT_EQ(c.overrides.at("fur.length"), "0.05");
    EXPECT_EQ(c.overrides.at("layers"), "8");
    EXPECT_EQ(c.overrides.at("coat.pattern"), "plain,spots");
    EXPECT_EQ(c.overrides.at("model"), "bunny");
    EXPECT_FALSE(c.published);
    const Scene scene = scene_of(e, c);
    EXPECT_FLOAT_EQ(scene.fur.length, 0.05f);
    EXPECT_EQ(scene.coat.pattern, c.axes.at("coat.pattern"));
  }
  EXPECT_EQ(cases[0].name, "bunny-8-800x600-plain");
}

TEST(Experiment, BadOverridesAreRefused) {
  const Experiment e = table1();
  const Preset& preset = preset_of(e, "smoke");
  for (const Overrides& wrong :
       {Overrides{.set = {{"fur.lenght", "1"}}}, Overrides{.set = {{"fur.length", "-1"}}},
        Overrides{.axes = {{"size", {"800"}}}}, Overrides{.axes = {{"layers", {"1"}}}},
        Overrides{.axes = {{"reading", {"loose"}}}}, Overrides{.axes = {{"variant", {"gl"}}}}})
    EXPECT_NE(refusal([&] { scene_of(e, cases_of(e, preset, wrong).front()); }), "accepted");
  test::expect_has(refusal([&] { preset_of(e, "fast"); }), "quick");
  test::expect_has(refusal([&] { experiment_file("table-9"); }), "silva2010-table1");
}

TEST(Experiment, PublishedFiguresAndTheirRelations) {
  const Metric whole = published_figure("267", "fps"), below = published_figure("< 1", "fps");
  EXPECT_EQ(whole.relation, "=");
  EXPECT_EQ(*whole.low, 266.5);
  EXPECT_EQ(*whole.high, 267.5);
  EXPECT_EQ(below.relation, "<");
  EXPECT_FALSE(below.low);
  EXPECT_EQ(*below.high, 1);
  EXPECT_EQ(*published_figure("2.5", "ms").low, 2.45);
  EXPECT_EQ(published_figure("~ 30", "fps").relation, "about");
  EXPECT_EQ(published_figure("20..30", "fps").value, 25);
  EXPECT_EQ(published_figure("20..20", "fps").value, 20);
  for (const std::string text : {"", "fast", "-3", "> 4", "1e3", "1 2", "30..20"})
    EXPECT_NE(refusal([&] { published_figure(text, "fps"); }), "accepted") << text;
}

TEST(Experiment, BadFilesAreRefusedWithTheirLine) {
  const std::string good = "name = \"e\"\n[axes]\nmodel = [\"torus\"]\n[preset.quick]\nleast = 3\n";
  EXPECT_NO_THROW(read_text(good));
  test::expect_refusals({{"name = ", "e.toml:1: not TOML"},
                         {good + "[speed]\nx = 3\n", "e.toml:6: unknown key speed"},
                         {good + "lest = 3\n", "preset quick: the key lest is unknown"},
                         {good + "most = 2\n", "'most' must not be smaller"},
                         {good + "precision = nan\n", "precision must be"},
                         {good + "precision = 2\n", "precision = 2 is not between 0 and 1"},
                         {good + "limit_s = \"1\"\n", "limit_s must be"},
                         {good + "limit_s = 86401\n", "limit_s = 86401 is not between 0 and 86400"},
                         {good + "warm_up_s = 3601\n", "warm_up_s = 3601 is not between 0 and 3600"},
                         {good + "most = 3.5\n", "most must be a whole number"},
                         {good + "[published]\nkeys=[\"model\"]\n", "[published] must have keys"},
                         {good + "[published]\nkeys=[\"layer\"]\ncells=[]\n", "no axis has the name"},
                         {good + "[published]\nunits=\"fps\"\n", "the key units is unknown"},
                         {"name = \"../e\"\n[axes]\nmodel = [\"a\"]\n[preset.quick]\n", "name must"},
                         {"name = \"e\"\n[axes]\nmodel = \"a\"\n[preset.quick]\n", "must be a list"},
                         {"name = \"e\"\n[axes]\nmodel = [\"a\", \"a\"]\n[preset.quick]\n", "twice"},
                         {"name = \"e\"\n[preset.quick]\n", "no [axes]"},
                         {"name = \"e\"\n[axes]\nmodel = [\"a\"]\n", "preset"},
                         {good + "[published]\nunit=\"fps\"\nkeys=[\"model\"]\ncells=[[\"a\"]]\n", "cell"}},
                        read_text);
}

TEST(Experiment, MetricsAreRequiredOfAllCasesOrOfSome) {
  const Experiment e = table1();
  for (const Case& c : cases_of(e, preset_of(e, "quick"))) EXPECT_EQ(c.require.at("wet_share"), 0.3);
  const std::string good =
      "name = \"e\"\n[axes]\nmodel = [\"torus\"]\nmood = [\"calm\"]\n[preset.quick]\nleast = 3\n";
  EXPECT_NO_THROW(read_text(good + "[require]\nx = 1\n[require.mood.calm]\nx = 2\n"));
  test::expect_has(refusal_of(good + "[require.mood.fog]\nx = 2\n"),
                   "e.toml:7: require.mood.fog: no axis has");
  test::expect_has(refusal_of(good + "[require.mood]\ncalm = 2\n"), "require.mood.calm must be a table");
  test::expect_has(refusal_of(good + "[require.mood.calm]\nx = \"2\"\n"), "x must be a finite number");
}

TEST(Experiment, ShardsAreReadStrictly) {
  EXPECT_EQ(shard_from_text("3/4").index, 3);
  for (const std::string text : {"4/4", "0/0", "-1/2", "1", "a/b", "1/2/3", ""})
    EXPECT_NE(refusal([&] { shard_from_text(text); }), "accepted") << text;
}

TEST(Experiment, FilterAndOrder) {
  const Experiment e = table1();
  const auto cases = cases_of(e, preset_of(e, "quick"));
  EXPECT_EQ(filtered(cases, "^torus").size(), 4u);
  EXPECT_EQ(filtered(cases, "-16-.*x600$").size(), 8u);
  EXPECT_TRUE(filtered(cases, "whale").empty());
  test::expect_has(refusal([&] { filtered(cases, std::string(80, '(')); }), std::string(80, '(') + ": this");
  test::expect_has(refusal([&] { filtered(cases, "x" + std::string(80, '(')); }),
                   "--filter x" + std::string(79, '(') + "...: this is not a valid regular expression");

  auto names = [](const std::vector<Case>& list) {
    std::vector<std::string> result;
    result.reserve(list.size());
    for (const Case& c : list) result.push_back(c.name);
    return result;
  };
  EXPECT_EQ(names(shuffled(filtered(cases, "^torus"), 5)),
            (std::vector<std::string>{"torus-64-1680x1050", "torus-16-800x600", "torus-16-1680x1050",
                                      "torus-64-800x600"}));
  EXPECT_NE(names(shuffled(cases, 5)), names(shuffled(cases, 6)));
  auto sorted = names(shuffled(cases, 5)), all = names(cases);
  std::ranges::sort(sorted);
  std::ranges::sort(all);
  EXPECT_EQ(sorted, all);
}

}  // namespace
}  // namespace pelage
