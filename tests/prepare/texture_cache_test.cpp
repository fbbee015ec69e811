
#include "harness/hash.hpp"
#include "harness/mesh/disk_cache.hpp"
#include "harness/prepare/coat.hpp"
#include "harness/prepare/fur_texture.hpp"
#include "tests/mesh/mesh_files.hpp"

namespace pelage {
namespace {

class TextureCache : public ::testing::Test {
 protected:
  TextureCache() {
    ::setenv("XDG_CACHE_HOME", folder_.path.c_str(), 1);
    fur_.layers = 4;
    fur_.texture = 32;
    coat_.texture = 64;
  }

  std::vector<fs::path> files() const { return test::files_below(folder_.path / "pelage" / "textures"); }

  test::Folder folder_;
  std::shared_ptr<const Mesh> mesh_ = load_model("square", fresh());
  FurScene fur_;
  CoatScene coat_;
};

TEST_F(TextureCache, GivesWhatWasMadeBitForBitFirstAndLater) {
  for (int time = 0; time < 2; ++time) {
    const FurTexture fur = kept_fur_texture(fur_), made = make_fur_texture(fur_);
    EXPECT_EQ(fur.size, made.size);
    EXPECT_EQ(fur.layers, made.layers);
    EXPECT_EQ(fur.level, made.level);
    const CoatTexture coat = kept_coat(*mesh_, coat_);
    EXPECT_EQ(coat.size, 64);
    EXPECT_EQ(coat.texel, make_coat(*mesh_, coat_).texel);
    EXPECT_EQ(kept_surface_map(*mesh_, 32), surface_map(*mesh_, 32));
    EXPECT_EQ(files().size(), 3u);
  }
}

TEST_F(TextureCache, AnotherSceneOrMeshIsAnotherFile) {
  kept_fur_texture(fur_);
  fur_.seed += 1;
  EXPECT_EQ(kept_fur_texture(fur_).level, make_fur_texture(fur_).level);
  kept_coat(*mesh_, coat_);
  coat_.scale *= 2;
  EXPECT_EQ(kept_coat(*mesh_, coat_).texel, make_coat(*mesh_, coat_).texel);
  kept_surface_map(*mesh_, 32);
  kept_surface_map(*mesh_, 16);
  const auto torus = load_model("torus", fresh());
  EXPECT_EQ(kept_surface_map(*torus, 16), surface_map(*torus, 16));
  EXPECT_EQ(files().size(), 7u);
}

TEST_F(TextureCache, DamagedFilesAreMadeAgain) {
  const FurTexture good = kept_fur_texture(fur_);
  ASSERT_EQ(files().size(), 1u);
  const fs::path file = files().front();
  std::string bytes = *read_cache_file(file);
  bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
  ASSERT_TRUE(write_cache_file(file, bytes));
  EXPECT_EQ(kept_fur_texture(fur_).level, good.level);
  EXPECT_NE(*read_cache_file(file), bytes) << "it is good again";
  fs::resize_file(file, 100);
  EXPECT_EQ(kept_fur_texture(fur_).level, good.level);
}

TEST_F(TextureCache, AFolderThatCannotBeWrittenCostsTimeOnly) {
  ::setenv("XDG_CACHE_HOME", folder_.write("file", "in the way").c_str(), 1);
  EXPECT_EQ(kept_fur_texture(fur_).level, make_fur_texture(fur_).level);
}

TEST_F(TextureCache, WhatWasNotUsedForLongestGoesFirst) {
  const fs::path old = folder_.write("old", std::string(100, 'x')),
                 used = folder_.write("used", std::string(100, 'x')),
                 fresh_one = folder_.write("fresh", std::string(100, 'x'));
  const auto now = fs::file_time_type::clock::now();
  fs::last_write_time(old, now - std::chrono::hours(2));
  fs::last_write_time(used, now - std::chrono::hours(3));
  ASSERT_TRUE(read_cache_file(used));
  trim_cache(folder_.path, 200);
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(used));
  EXPECT_TRUE(fs::exists(fresh_one));
}

// If this test fails after an intended change of a texture, increase texture_recipe and write the new hashes
// into this test. If texture_recipe stays the same, programs continue to read the old textures from the
// cache.
TEST_F(TextureCache, TheRecipeHasTheseBytes) {
  EXPECT_EQ(texture_recipe, 1);
  Hash fur;
  for (const auto& level : make_fur_texture(fur_).level) fur.values(level);
  EXPECT_EQ(fur.value(), 16436695362474114906u);
  EXPECT_EQ(Hash().values(make_coat(*mesh_, coat_).texel).value(), 13665619114042081950u);
  EXPECT_EQ(Hash().values(surface_map(*mesh_, 32)).value(), 6792194699267670169u);
}

}  // namespace
}  // namespace pelage
