// Tests axes whose names the author of the experiment file chose, such as `mood`, and the checks of all axes.
#include "harness/experiment/axes.hpp"

#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

const std::string quick = "[preset.quick]\n";
const std::string moods =
    "name = \"e\"\n[axes]\nmodel = [\"torus\"]\nlayers = [8, 16]\nmood = [\"calm\", \"storm\"]\n";
const std::string storm = "[mood.storm]\ndynamics.wind.strength = 0.01\ncurl.turns = 3\n";

struct Axes : test::InFolder {
  Experiment read(const std::string& text) const {
    folder.write("e.toml", text);
    return read_experiment(folder.path / "e.toml");
  }
  std::string refusal(const std::string& text, const Overrides& overrides = {}) const {
    return test::refusal([&] {
      const Experiment e = read(text);
      for (const Case& c : cases_of(e, preset_of(e, "quick"), overrides)) scene_of(e, c);
    });
  }
  void refuses(const std::string& text, const std::string& part, const Overrides& overrides = {}) const {
    test::expect_has(refusal(text, overrides), part);
  }
};

TEST_F(Axes, ANamedValueSetsSeveralKeys) {
  const Experiment e = read(moods + storm + quick);
  const auto cases = cases_of(e, preset_of(e, "quick"));
  const SamplingLimits limits = preset_of(e, "quick").limits;
  EXPECT_EQ(std::tuple(limits.least, limits.most, limits.limit_s), std::tuple(10, 200, 20.0));
  ASSERT_EQ(cases.size(), 4u);
  EXPECT_EQ(cases[0].name, "torus-8-calm");
  EXPECT_EQ(cases[3].name, "torus-16-storm");
  EXPECT_EQ(cases[3].axes.at("mood"), "storm");
  EXPECT_TRUE(cases[3].overrides.empty());
  const Scene calm = scene_of(e, cases[0]), stormy = scene_of(e, cases[1]);
  EXPECT_FLOAT_EQ(calm.curl.turns, 0);
  EXPECT_FLOAT_EQ(calm.dynamics.wind.strength, 0);
  EXPECT_FLOAT_EQ(stormy.curl.turns, 3);
  EXPECT_FLOAT_EQ(stormy.dynamics.wind.strength, 0.01f);
}

TEST_F(Axes, ASceneKeyMayVaryOverLists) {
  const std::string file =
      "name = \"e\"\n[axes]\nlayers = [8]\ncamera.eye = [[0.0, 0.5, 2], [0, -0.5, 2.0]]\n";
  const Experiment e = read(file + quick);
  const auto cases = cases_of(e, preset_of(e, "quick"));
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].name, "8-0.0_0.5_2");
  EXPECT_EQ(cases[1].name, "8-0__0.5_2.0") << "_ instead of the minus sign";
  EXPECT_EQ(cases[1].axes.at("camera.eye"), "[0, -0.5, 2.0]");
  EXPECT_EQ(scene_of(e, cases[0]).camera.eye, glm::vec3(0, 0.5, 2));
  EXPECT_EQ(scene_of(e, cases[1]).camera.eye, glm::vec3(0, -0.5, 2));
  refuses(
      "name = \"e\"\n[axes]\nlayers = [8]\nmood = [[0, 1], [1, 0]]\n" + quick,
      "the values of axis mood must be numbers or strings; only the axis of a scene key such as camera.eye may have "
      "lists of numbers");
  refuses("name = \"e\"\n[axes]\ncamera.eye = [[0, 1]]\n" + quick, "camera.eye");
  refuses("name = \"e\"\n[axes]\ncamera.eye = [[]]\n" + quick, "the values of axis camera.eye must be");
}

TEST_F(Axes, TheCommandLineMayChooseAmongTheValuesOfTheFile) {
  EXPECT_EQ(refusal(moods + storm + quick, {.axes = {{"mood", {"calm"}}}}), "accepted");
  EXPECT_EQ(refusal(moods + storm + "[mood.calm]\n[mood.fog]\ncurl.turns = 2\n" + quick,
                    {.axes = {{"mood", {"fog"}}}}),
            "accepted");
  refuses(moods + storm + quick, "axis mood has no value 'clam'; the file has the values calm, storm",
          {.axes = {{"mood", {"clam"}}}});
}

// pelage refuses an experiment file with a wrong scene key. It does so even if the command line selects only
// cases that do not use the table with this key.
TEST_F(Axes, AWrongSceneKeyIsRefusedWithItsLine) {
  refuses(moods + storm + "[mood.calm]\nfur.lenght = 1\n" + quick,
          "e.toml:10: fur.lenght: no such key; did you mean fur.length?", {.axes = {{"mood", {"storm"}}}});
  refuses(moods + "[mood.storm]\nfur.length = 99\n" + quick, "e.toml:7: fur.length: 99 is out of range");
}

TEST_F(Axes, ANameNeedsATable) {
  refuses(moods + quick, "axis mood: mood: no such key");
  refuses(moods + quick, "the file needs a table [mood.VALUE]");
  refuses("name = \"e\"\n[axes]\nreading = [\"calm\"]\n" + quick, "the file needs a table [reading.VALUE]");
  EXPECT_EQ(refusal("name = \"e\"\n[axes]\nreading = [\"calm\", \"b\"]\n[reading.b]\n" + quick), "accepted");
}

TEST_F(Axes, EveryCaseHasAName) {
  const Experiment e = read("name = \"e\"\n[axes]\nreading = [\"a\", \"b\"]\n[reading.b]\n" + quick);
  const auto cases = cases_of(e, preset_of(e, "quick"));
  EXPECT_EQ(cases[0].name, "e");
  EXPECT_EQ(cases[1].name, "b");
  const Overrides longest{.model = "x/" + std::string(198, 'm') + ".obj"};
  EXPECT_EQ(cases_of(e, preset_of(e, "quick"), longest)[1].name.size(), 200u);
}

TEST_F(Axes, MisspelledTablesAreRefusedWithTheirLine) {
  refuses(moods + "[mood.strom]\ncurl.turns = 3\n" + quick,
          "e.toml:6: the axis mood has no value strom, and its value calm has no table [mood.calm]");
  refuses(moods + "[moods.storm]\ncurl.turns = 3\n" + quick, "e.toml:6: unknown key moods (known: axes");
  refuses(moods + "[mood]\nstorm = 3\n" + quick, "mood.storm must be a table of scene keys");
  refuses("name = \"e\"\n[axes]\npreset = [\"a\"]\n" + quick,
          "e.toml:3: an axis cannot have the name preset");
  refuses("name = \"e\"\n[axes]\ndevice = [\"a\"]\n" + quick, "device is a column of CSV files");
}

TEST_F(Axes, ATableMustNotContradictAnAxis) {
  refuses(moods + "[mood.storm]\nfur.layers = 4\n" + quick,
          "the table [mood.storm] sets fur.layers, which the axis layers varies");
  refuses(moods + "[model.torus]\nfur.layers = 4\n[mood.storm]\n" + quick, "[model.torus] sets fur.layers");
  refuses(moods + storm + quick, "--set fur.layers: the axis layers of e varies this key",
          {.set = {{"fur.layers", "4"}}});
  refuses(moods + storm + quick, "e: the axes layers and fur.layers both vary fur.layers; remove one of them",
          {.axes = {{"fur.layers", {"4"}}}});
  // The command line may set the number of layers to 6, although the table [mood.storm] sets it to 4.
  const Experiment e = read(
      "name = \"e\"\n[axes]\nmodel = [\"own\"]\nmood = [\"storm\"]\n[model.own]\nmodel = \"m.obj\"\n"
      "[mood.storm]\nfur.layers = 4\n" +
      quick);
  const auto cases = cases_of(e, preset_of(e, "quick"), {.axes = {{"layers", {"6"}}}});
  EXPECT_EQ(scene_of(e, cases.front()).fur.layers, 6);
  EXPECT_TRUE(scene_of(e, cases.front()).model.ends_with("/m.obj"));
}

TEST_F(Axes, NumbersPrintAsTheyAreWritten) {
  const Experiment e = read(
      "name = \"e\"\n[axes]\ncurl.radius = [\n  0.0100, # first\n  2e-2,\n  0.05]\nfur.taper = [0.10, 2]\n"
      "mood = [\"\xc3\xa9\xc3\xa9\xc3\xa9\",10,20]\n" +
      quick);
  EXPECT_EQ(e.axes[0].values, (std::vector<std::string>{"0.0100", "2e-2", "0.05"}));
  EXPECT_EQ(e.axes[1].values, (std::vector<std::string>{"0.10", "2"}));
  EXPECT_EQ(e.axes[2].values[2], "20");  // the text before it has three more bytes than characters
  EXPECT_EQ(canonical("0.0100"), canonical("1e-2"));
  EXPECT_NE(canonical("0.01"), canonical("0.02"));
  EXPECT_EQ(canonical("0x10"), "0x10");
}

TEST_F(Axes, EqualNumbersAreTheSameValue) {
  refuses("name = \"e\"\n[axes]\ncurl.radius = [0.0100, 1e-2]\n" + quick, "contains the value 1e-2 twice");
  const Experiment e = read(
      "name = \"e\"\n[axes]\ncurl.radius = [0.0100, 0.05]\n[published]\nunit = \"fps\"\n"
      "keys = [\"curl.radius\"]\ncells = [[0.01, \"20\"]]\n" +
      quick);
  const auto cases = cases_of(e, preset_of(e, "quick"));
  EXPECT_EQ(cases[0].name, "0.0100");
  ASSERT_TRUE(cases[0].published);
  EXPECT_FALSE(cases[1].published);
}

}  // namespace
}  // namespace pelage
