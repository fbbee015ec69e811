// Tests experiments whose table [scene] names a scene file: file = "my.toml".
#include "harness/experiment/experiment.hpp"
#include "harness/scene/scene_toml.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

/// Writes an experiment file into the folder e/. The experiment uses the scene file s/my.toml.
struct SceneFile : test::InFolder {
  void SetUp() override {
    fs::create_directories(folder.path / "e");
    fs::create_directories(folder.path / "s");
    scene(
        "model = \"torus\"\n[fur]\nlength = 0.05\nlayers = 8\n[coat]\nimage = \"coat.png\"\n"
        "[[shading.light]]\ndirection = [0, 1, 0]\n");
  }
  void scene(const std::string& text) const { folder.write("s/my.toml", text); }
  Experiment read(const std::string& keys, const std::string& file = "../s/my.toml") const {
    folder.write("e/e.toml", "name = \"e\"\n[axes]\ncurl.turns = [1, 2]\n[scene]\nfile = \"" + file + "\"\n" +
                                 keys + "\n[preset.quick]\n");
    return read_experiment(folder.path / "e/e.toml");
  }
  Scene first(const Experiment& e, const Overrides& overrides = {}) const {
    return scene_of(e, cases_of(e, preset_of(e, "quick"), overrides).front());
  }
  std::string refusal(const std::string& keys, const std::string& file = "../s/my.toml") const {
    return test::refusal([&] { first(read(keys, file)); });
  }
};

TEST_F(SceneFile, IsTakenAsItIs) {
  Scene expected = read_scene(folder.path / "s/my.toml");
  expected.curl.turns = 1;
  EXPECT_EQ(write_scene(first(read(""))), write_scene(expected));
  // A relative path in the scene file is relative to the folder of the scene file.
  EXPECT_EQ(first(read("")).coat.image, folder.path / "s/coat.png");
}

TEST_F(SceneFile, NamesThePipelineOfVariantsThatNameNone) {
  const auto pipelines = [&](const std::string& keys, const Overrides& overrides = {}) {
    const Experiment e = read(keys);
    std::string names;
    for (const Case& which : cases_of(e, preset_of(e, "quick"), overrides))
      if (which.axes.at("curl.turns") == "1") names += which.pipeline + " " + which.variant + ";";
    return names;
  };
  EXPECT_EQ(pipelines(""), "shells shells/tile;");
  scene("pipeline = \"strands\"\n");
  EXPECT_EQ(pipelines(""), "strands strands;");
  EXPECT_EQ(pipelines("pipeline = \"reference\""), "reference reference;");
  EXPECT_EQ(pipelines("", {.set = {{"pipeline", "shells"}}}), "shells shells/tile;");
}

TEST_F(SceneFile, IsOverriddenByKeysTablesAxesAndSet) {
  const Experiment e = read(
      "fur.length = 0.06\ncoat.image = \"own.png\"\n[variant.a]\nfur.layers = 12\n[variant.b]\n"
      "[preset.set]\naxes.variant = [\"a\", \"b\"]\naxes.fur.taper = [2.5]\n");
  EXPECT_FLOAT_EQ(first(e).fur.length, 0.06f);
  EXPECT_EQ(first(e).fur.layers, 8);
  EXPECT_EQ(first(e).shading.lights.size(), 1u);
  EXPECT_EQ(first(e).coat.image, folder.path / "e/own.png");
  const Scene set = scene_of(e, cases_of(e, preset_of(e, "set"), {.set = {{"fur.strands", "7"}}}).front());
  EXPECT_EQ(set.fur.layers, 12);
  EXPECT_FLOAT_EQ(set.fur.taper, 2.5f);
  EXPECT_EQ(set.fur.strands, 7);
}

TEST_F(SceneFile, ChangesTheHashOfTheCase) {
  const std::string before = scene_hash(first(read("")));
  scene("model = \"torus\"\n[fur]\nlength = 0.07\nlayers = 8\n");
  EXPECT_NE(scene_hash(first(read(""))), before);
}

TEST_F(SceneFile, ErrorsNameBothFiles) {
  const auto names_both = [&](const std::string& text, const std::string& part) {
    test::expect_has(text, {"e/e.toml", "s/my.toml", part});
  };
  // If a key of the experiment is wrong, the error message contains the line number of the key.
  test::expect_has(refusal("fur.lenght = 1"), "e.toml:6: fur.lenght: no such key; did you mean fur.length?");
  test::expect_has(refusal("", "../s/mine.toml"), "e.toml:5: scene.file: " + folder.path.string() +
                                                      "/s/mine.toml: there is no such scene file");
  scene("model = \"torus\"\n[fur]\nlength = 9\n");
  names_both(refusal(""), "my.toml:3: fur.length: 9 is out of range");
  scene("model = ");
  names_both(refusal(""), "my.toml:1: not TOML");
  test::expect_has(refusal("file.x = 1"), "e.toml");
  test::expect_has(refusal("", ""), "scene.file must be the path of a scene file");
}

}  // namespace
}  // namespace pelage
