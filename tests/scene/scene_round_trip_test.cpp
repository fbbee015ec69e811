// Tests that writing and reading a scene preserves the value of every key: its default, its bounds and values
// between the bounds.
#include <fstream>
#include <map>
#include <random>
#include <regex>
#include <set>
#include <sstream>

#include "harness/error.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

/// Returns the name of the first key whose value differs between two scenes; empty if the scenes are equal.
std::string difference(Scene a, Scene b) {
  const auto first_in = [](const std::vector<Key>& left, const std::vector<Key>& right) -> std::string {
    for (std::size_t i = 0; i < left.size(); ++i) {
      const bool same = std::visit(
          [&](auto* value) { return *value == *std::get<decltype(value)>(right[i].slot); }, left[i].slot);
      if (!same) return std::string(left[i].name);
    }
    return {};
  };
  if (const std::string key = first_in(scene_keys(a), scene_keys(b)); !key.empty()) return key;
  const std::vector<KeyList> left = scene_lists(a), right = scene_lists(b);
  for (std::size_t n = 0; n < left.size(); ++n) {
    if (left[n].size() != right[n].size()) return std::string(left[n].name);
    for (std::size_t i = 0; i < left[n].size(); ++i)
      if (const std::string key = first_in(left[n].keys(i), right[n].keys(i)); !key.empty())
        return std::string(left[n].name) + "." + key;
  }
  return {};
}

/// Assigns a random permitted value to the key.
void vary(const Key& key, std::mt19937& random) {
  const auto between = [&] {
    const double end = std::uniform_int_distribution(0, 9)(random);
    if (end == 0) return key.least;
    if (end == 1) return key.most;
    const double t = std::uniform_real_distribution(0.0, 1.0)(random);
    // The third power of t makes values near the lower bound more frequent. Small values have many decimal
    // places, which must not be lost when the scene is written.
    return key.least + t * t * t * (key.most - key.least);
  };
  std::visit(
      [&](auto* slot) {
        using T = std::remove_reference_t<decltype(*slot)>;
        if constexpr (std::is_same_v<T, bool>) {
          *slot = random() % 2 == 0;
        } else if constexpr (std::is_same_v<T, std::string>) {
          if (key.choices.empty()) {
            *slot = "torus";
          } else {
            *slot = key.choices[random() % key.choices.size()];
          }
        } else if constexpr (std::is_same_v<T, fs::path>) {
          if (random() % 2 == 0) *slot = "/a \"quoted\" \\ path\twith\x01 odd characters.png";
        } else if constexpr (std::is_same_v<T, glm::vec3>) {
          *slot = glm::vec3(between(), between(), between());
        } else if constexpr (std::is_same_v<T, float>) {
          *slot = static_cast<float>(between());
        } else if constexpr (std::is_integral_v<T>) {
          *slot = static_cast<T>(between());
          if (key.power_of_two) *slot = T(16) << (random() % 7);
        }
      },
      key.slot);
}

TEST(SceneRoundTrip, TheEmptyFileIsTheDefaultScene) {
  EXPECT_EQ(difference(parse_scene("", "empty"), Scene{}), "");
  EXPECT_NO_THROW(check_scene(Scene{}));
}

TEST(SceneRoundTrip, EveryKeyAloneSurvives) {
  std::mt19937 random(1);
  Scene shape;
  const std::size_t count = scene_keys(shape).size();
  ASSERT_GT(count, 70u);
  for (std::size_t i = 0; i < count; ++i) {
    int changed = 0;
    for (int attempt = 0; attempt < 20; ++attempt) {
      Scene scene;
      const Key key = scene_keys(scene)[i];
      vary(key, random);
      changed += difference(scene, Scene{}).empty() ? 0 : 1;
      try {
        check_scene(scene);
      } catch (const InputError&) {
        continue;  // this value contradicts the default of another key
      }
      EXPECT_EQ(difference(parse_scene(write_scene(scene), "written"), scene), "") << write_scene(scene);
    }
    EXPECT_GT(changed, 0) << scene_keys(shape)[i].name << " never changed: the test shows nothing";
  }
}

TEST(SceneRoundTrip, ManyKeysTogetherSurvive) {
  std::mt19937 random(2);
  int read = 0;
  for (int attempt = 0; attempt < 3000; ++attempt) {
    Scene scene;
    for (const Key& key : scene_keys(scene))
      if (random() % 3 == 0) vary(key, random);
    scene.shading.lights.resize(1 + random() % 2);
    scene.wetness.droplets.resize(random() % 4);
    for (std::size_t i = 0; i < scene.wetness.droplets.size(); ++i) {
      const float t = static_cast<float>(random()) / 4294967296.0f;
      if (i % 2 == 0) scene.wetness.droplets[i].uv = glm::vec2(t, 1 - t);
      if (i % 2 == 1) scene.wetness.droplets[i].point = glm::vec3(t, -t, 1.5f * t);
      scene.wetness.droplets[i].wetness = t;
      scene.wetness.droplets[i].time = 3600 * t;
    }
    scene.strands.layers.resize(1 + random() % 3);
    scene.strands.fills.resize(random() % 3);
    for (const KeyList& list : scene_lists(scene))
      for (std::size_t i = 0; list.name.starts_with("strands.") && i < list.size(); ++i)
        for (const Key& key : list.keys(i))
          if (random() % 8 == 0) vary(key, random);
    try {
      check_scene(scene);
    } catch (const InputError&) {
      continue;
    }
    ++read;
    const Scene again = parse_scene(write_scene(scene), "written");
    ASSERT_EQ(difference(again, scene), "") << write_scene(scene);
    ASSERT_EQ(write_scene(again), write_scene(scene));
  }
  EXPECT_GT(read, 30);
}

TEST(SceneRoundTrip, SetEqualsTheFile) {
  Scene set;
  apply_set(set, "fur.length=0.11");
  apply_set(set, " shading.model = wet ");
  apply_set(set, "model=torus");
  apply_set(set, "camera.direction=[1, 2, 3]");
  apply_set(set, "camera.framed=false");
  apply_set(set, "dynamics.wind.strength=2");
  apply_set(set, "wetness.droplet=[{uv = [0.5, 0.25], radius = 0.1}]");
  apply_set(set, "shading.light=[{direction = [0, 1, 0], intensity = 1}]");
  const Scene file = parse_scene(R"(
model = "torus"
fur.length = 0.11
shading.model = "wet"
[camera]
direction = [1, 2.0, 3]
framed = false
[dynamics.wind]
strength = 2
[[wetness.droplet]]
uv = [0.5, 0.25]
radius = 0.1
[[shading.light]]
direction = [0, 1, 0]
intensity = 1
)",
                                 "file");
  EXPECT_EQ(difference(set, file), "");
  EXPECT_EQ(file.wetness.droplets.at(0).wetness, DropletScene{}.wetness);
}

TEST(SceneRoundTrip, PathsAreRelativeToTheFile) {
  const test::Folder folder;
  const Scene scene =
      read_scene(folder.write("s.toml", "model = 'meshes/a.obj'\ncoat.image = '../coat.png'\n"));
  EXPECT_EQ(scene.model, (folder.path / "meshes/a.obj").string());
  EXPECT_EQ(scene.coat.image, folder.path.parent_path() / "coat.png");
  EXPECT_EQ(scene.wetness.image, fs::path());
}

TEST(SceneRoundTrip, TheHashFollowsTheValuesAndNotTheFolder) {
  const Scene plain;
  EXPECT_EQ(scene_hash(plain).size(), 16u);
  EXPECT_EQ(scene_hash(plain), scene_hash(parse_scene("fur.length = 0.09", "x")));
  std::mt19937 random(3);
  Scene shape;
  for (std::size_t i = 0; i < scene_keys(shape).size(); ++i) {
    Scene scene;
    for (int attempt = 0; attempt < 100 && difference(scene, plain).empty(); ++attempt)
      vary(scene_keys(scene)[i], random);
    const std::string_view name = scene_keys(scene)[i].name;
    EXPECT_EQ(scene_hash(scene) == scene_hash(plain), name == "pipeline") << name;
  }

  const test::Folder a, b;
  Scene here, there;
  here.coat.image = a.path / "coat.png";
  there.coat.image = b.path / "coat.png";
  for (const fs::path& file : {here.coat.image, there.coat.image}) std::ofstream(file) << "the same bytes";
  EXPECT_EQ(scene_hash(here), scene_hash(there));
  std::ofstream(there.coat.image) << "other bytes";
  EXPECT_NE(scene_hash(here), scene_hash(there));
}

TEST(SceneRoundTrip, TheWrittenSceneExplainsEveryKey) {
  Scene scene;
  const std::string text = write_scene(scene);
  for (const Key& key : scene_keys(scene)) {
    EXPECT_FALSE(key.help.empty()) << key.name;
    EXPECT_NE(text.find(describe_range(key)), std::string::npos) << key.name;
  }
  test::expect_has(text, {"default", "uv", "point", "r_drop", "[[shading.light]]"});
}

/// Returns the members of the structs in the headers of the scene as dotted keys: "float length = ..."
/// in "struct FurScene" gives "fur.length".
std::vector<std::string> members() {
  std::string text;
  for (const char* name : {"harness/scene/scene.hpp", "harness/scene/strands_scene.hpp"})
    text += test::text_of(fs::path(PELAGE_SOURCE_DIR) / name);
  std::map<std::string, std::string> tables;
  std::istringstream pairs(
      "FurScene fur. CurlScene curl. WetnessScene wetness. ClumpScene clump. SoakedScene soaked. BlendScene blend. WindScene dynamics.wind. DynamicsScene dynamics. ShadingScene shading. CoatScene coat. StrandsScene strands. ChainScene strands.chain. CameraScene camera. ImageScene image. SpringsScene dynamics.springs. MotionScene dynamics.motion. PokeScene dynamics.poke. MeshScene mesh. ContactMeshScene contact.mesh_ ContactMotion contact.mesh_");
  for (std::string type, table; pairs >> type >> table;) tables[type] = table;
  const std::regex opening(R"(^struct (\w+) \{)"), member(R"(^  [\w:]+ ((\w+, )*\w+)( = [^;]+|\{[^;]*\})?;)"),
      word(R"(\w+)");
  std::vector<std::string> names;
  std::string prefix;
  std::smatch match;
  for (const std::string& line : test::lines_of(text)) {
    if (std::regex_search(line, match, opening))
      prefix = tables.contains(match[1]) ? tables.at(match[1]) : "";
    if (prefix.empty() || !std::regex_search(line, match, member)) continue;
    const std::string list = match[1];
    for (std::sregex_iterator name(list.begin(), list.end(), word), end; name != end; ++name)
      names.push_back(prefix + name->str());
  }
  return names;
}

TEST(SceneRoundTrip, EveryMemberHasAKey) {
  Scene scene;
  std::set<std::string> keys;
  for (const Key& key : scene_keys(scene)) keys.emplace(key.name);
  const std::vector<std::string> names = members();
  EXPECT_GE(names.size() + 1, keys.size());  // and the model
  const std::set<std::string> tables{"dynamics.wind", "dynamics.springs", "dynamics.motion",
                                     "dynamics.poke", "strands.chain",    "contact.mesh_motion"};
  keys.insert("contact.mesh_file");  // its key is contact.mesh
  for (const std::string& name : names) EXPECT_TRUE(keys.contains(name) || tables.contains(name)) << name;
}

TEST(SceneRoundTrip, EveryExampleReads) {
  const std::vector<fs::path> examples = test::files_below(PELAGE_SOURCE_DIR "/examples", ".toml");
  EXPECT_FALSE(examples.empty());
  for (const fs::path& file : examples) EXPECT_NO_THROW(read_scene(file)) << file;
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

TEST(ChangedKeys, AreThoseThatDifferFromTheDefaults) {
  EXPECT_EQ(changed_keys(Scene{}), Pairs{});
  const Scene scene = parse_scene("[fur]\nlength = 0.25\n[wetness]\nrandom = 40\n", "a.toml");
  EXPECT_EQ(changed_keys(scene), (Pairs{{"fur.length", "0.25"}, {"wetness.random", "40"}}));
}

// The option --anonymous promises that results contain no paths.
TEST(ChangedKeys, ContainNoFolders) {
  EXPECT_EQ(changed_keys(parse_scene("model = \"secret/horse.obj\"\n", "a.toml", "/secret")),
            (Pairs{{"model", "\"horse.obj\""}}));
}

TEST(ChangedKeys, ContainListsAndKeyframesAndShortenLongLists) {
  std::string text = "[keyframes]\n\"fur.length\" = [[0.0, 0.1], [1.0, 0.2]]\n";
  for (int i = 0; i < 2; ++i) text += "[[wetness.droplet]]\nuv = [0.5, 0.5]\nradius = 0.1\n";
  const Pairs few = changed_keys(parse_scene(text, "a.toml"));
  ASSERT_EQ(few.size(), 2U);
  EXPECT_EQ(few[0].first, "wetness.droplet");
  EXPECT_EQ(few[0].second.rfind("[{ ", 0), 0U) << few[0].second;
  EXPECT_EQ(few[1],
            std::pair(std::string("keyframes.\"fur.length\""), std::string("[[0.0, 0.1], [1.0, 0.2]]")));
  for (int i = 0; i < 100; ++i) text += "[[wetness.droplet]]\nuv = [0.5, 0.5]\nradius = 0.1\n";
  test::expect_has(changed_keys(parse_scene(text, "a.toml"))[0].second, " characters");
}

}  // namespace
}  // namespace pelage
