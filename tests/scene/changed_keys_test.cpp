// Tests the list of the scene keys that differ from their defaults. Rows of results contain this list.
#include <gtest/gtest.h>

#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

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
  EXPECT_NE(changed_keys(parse_scene(text, "a.toml"))[0].second.find(" characters"), std::string::npos);
}

}  // namespace
}  // namespace pelage
