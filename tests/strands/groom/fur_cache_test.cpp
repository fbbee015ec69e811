// Tests the cache of grown fur.
#include <fstream>

#include "harness/hash.hpp"
#include "harness/strands/groom/fur.hpp"
#include "tests/strands/groom/groom.hpp"

namespace pelage::strands {
namespace {

using namespace test;

class FurCache : public ::testing::Test {
 protected:
  FurCache() {
    ::setenv("XDG_CACHE_HOME", folder_.path.c_str(), 1);
    fs::create_directories(folder_.path / "pelage" / "fur");
    mesh_.hash = "the hash of a mesh";
    scene_.layers.front().length_spread = 0.3f;
    scene_.layers.front().length_map = test::grey(folder_, 200);
  }
  ~FurCache() override { ::unsetenv("XDG_CACHE_HOME"); }

  Fur kept() const { return kept_fur(mesh_, scene_, coat_); }
  void expect_grown() const { EXPECT_EQ(difference(kept(), grow(mesh_, scene_, coat_)), ""); }
  std::vector<fs::path> files() const { return pelage::test::files_below(folder_.path / "pelage" / "fur"); }

  pelage::test::Folder folder_;
  Mesh mesh_ = test::square();
  StrandsScene scene_ = even(300);
  CoatTexture coat_ = plain_coat();
};

TEST_F(FurCache, GivesTheGrownFurFirstAndLater) {
  for (int time = 0; time < 2; ++time) {
    expect_grown();
    EXPECT_EQ(files().size(), 1u);
  }
}

TEST_F(FurCache, HasAFilePerMeshCoatAndLayers) {
  kept();
  mesh_.hash = "another mesh";
  mesh_.position[20].z += 0.1f;
  expect_grown();
  coat_ = plain_coat({1, 2, 3});
  expect_grown();
  scene_.layers.front().lean = 11;
  expect_grown();
  test::picture(folder_, "grey200.png", 3, 2, [](int, int) { return glm::ivec3(100); });
  expect_grown();
  scene_.layers.front().locks = 9;
  scene_.chain.first_segment = 0.3f;
  expect_grown();
  scene_.layers.front().damping = 2;
  expect_grown();
  EXPECT_EQ(files().size(), 7u);
}

TEST_F(FurCache, DoesNotGrowFurAgainForOtherKeys) {
  kept();
  scene_.layers.front().order_bias = 3;
  scene_.layers.front().order_offset = -2;
  scene_.layers.front().opacity = 0.4f;
  scene_.layers.front().gloss = 3;
  scene_.layers.front().exponent = scene_.layers.front().rim_exponent = 2;
  scene_.layers.front().skin_shadow = 0.5f;
  scene_.layers.front().rim = {1, 0, 2};
  scene_.fraction = 0.5f;
  scene_.chain.stiffness = 77;
  scene_.chain.limit_joint = 12;
  expect_grown();
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(FurCache, GrowsFurAgainIfTheFileIsDamaged) {
  kept();
  const fs::path file = files().front();
  {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(1000);
    stream.put('x');
    stream.put('y');
  }
  expect_grown();
  fs::resize_file(file, 500);
  expect_grown();
}

TEST_F(FurCache, KeepsNothingForAMeshWithoutHash) {
  mesh_.hash = "";
  expect_grown();
  EXPECT_TRUE(files().empty());
}

// If this test fails, the code grows other fur than before: increase fur_recipe, and then correct the hash.
TEST_F(FurCache, TheRecipeStandsForTheFur) {
  scene_.layers.front().twist_spread = 30;
  const Fur fur = kept();
  Hash hash;
  for (const KeyedStrand& s : fur.strands)
    hash.bytes(s.key.data(), sizeof s.key)
        .bytes(&s.weight, sizeof s.weight)
        .bytes(&s.length, 4)
        .bytes(&s.twist, 4)
        .bytes(s.colour.data(), 3);
  for (const KeyStrand& key : fur.keys) hash.bytes(&key.rest, sizeof key.rest);
  hash.values(fur.points);
  EXPECT_EQ(fur_recipe, 4);
  EXPECT_EQ(hash.hex(), "007fe6507bf8131f");
}

}  // namespace
}  // namespace pelage::strands
