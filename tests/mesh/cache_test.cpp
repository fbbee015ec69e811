#include "harness/mesh/cache.hpp"

#include <fstream>

#include "tests/mesh/mesh_files.hpp"

namespace pelage {
namespace {

TEST(Cache, what_is_written_is_read_back) {
  const auto mesh = load_model("torus", fresh());
  const auto back = decode(encode(*mesh));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->name, mesh->name);
  EXPECT_EQ(back->hash, mesh->hash);
  EXPECT_EQ(back->position, mesh->position);
  EXPECT_EQ(back->uv, mesh->uv);
  EXPECT_EQ(back->weld, mesh->weld);
  EXPECT_EQ(back->triangle, mesh->triangle);
  EXPECT_EQ(back->welded, mesh->welded);
  EXPECT_EQ(back->periodic_uv, mesh->periodic_uv);
  EXPECT_EQ(back->length_per_uv, mesh->length_per_uv);
  EXPECT_EQ(back->notes, mesh->notes);
}

TEST(Cache, no_changed_byte_and_no_shorter_file_is_believed) {
  const std::string whole = encode(*load_model("banisch-grass", fresh()));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = char(damaged[i] ^ 0x10);
    EXPECT_FALSE(decode(damaged)) << "byte " << i;
    EXPECT_FALSE(decode(std::string_view(whole).substr(0, i))) << "length " << i;
  }
  EXPECT_FALSE(decode(whole + 'x'));
}

TEST(Cache, a_damaged_file_is_made_again_bit_for_bit) {
  const test::Folder folder;
  ::setenv("XDG_CACHE_HOME", folder.path.c_str(), 1);
  const auto first = load_model("square");
  const std::vector<fs::path> files = test::files_below(folder.path);
  ASSERT_EQ(files.size(), 1u);
  const fs::path& file = files.front();
  const std::string good = test::text_of(file);
  ASSERT_TRUE(decode(good));

  std::string bad = good;
  bad[bad.size() / 2] = char(bad[bad.size() / 2] ^ 1);
  std::ofstream(file, std::ios::binary) << bad;
  EXPECT_EQ(load_model("square")->hash, first->hash);
  EXPECT_EQ(test::text_of(file), good);

  std::filesystem::resize_file(file, good.size() / 3);
  EXPECT_EQ(load_model("square")->hash, first->hash);
  EXPECT_EQ(test::text_of(file), good);
}

TEST(Cache, a_folder_that_cannot_be_written_costs_time_only) {
  const test::Folder folder;
  const std::string file = folder.write("file", "in the way");
  ::setenv("XDG_CACHE_HOME", file.c_str(), 1);
  EXPECT_EQ(load_model("banisch-grass")->triangle.size(), 16u);
}

}  // namespace
}  // namespace pelage
