#include "harness/mesh/cache.hpp"

#include <cstring>
#include <fstream>

#include "harness/mesh/finish.hpp"
#include "tests/mesh/mesh_files.hpp"

namespace pelage {
namespace {

TEST(Cache, what_is_written_is_read_back) {
  const auto mesh = load_model("torus", fresh());
  const auto back = decode(encode(*mesh));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->name, mesh->name);
  EXPECT_EQ(back->hash, mesh->hash);
  EXPECT_EQ(content_hash(*back), mesh->hash);
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

TEST(Cache, no_mesh_whose_lists_disagree_is_believed) {
  const auto mesh = load_model("banisch-grass", fresh());
  std::vector<Mesh> wrong(6, *mesh);
  wrong[0].uv.pop_back();
  wrong[1].weld.pop_back();
  wrong[2].weld[0] = mesh->welded;
  for (int k = 0; k < 3; ++k) wrong[std::size_t(k) + 3].triangle[0][k] = std::uint32_t(mesh->position.size());
  for (const Mesh& one : wrong) EXPECT_FALSE(decode(encode(one)));
}

// Entries that earlier versions wrote stay valid.
TEST(Cache, entries_have_a_title_and_a_checksum) {
  for (const auto& [length, sum] : {std::pair(100, 0x9d209a02053a748bu), {115, 0xb76929b4ece0a2beu}}) {
    Writer to;
    to.text(std::string(std::size_t(length), 'x'));
    const std::string bytes = to.sealed("title");
    std::uint64_t found;
    std::memcpy(&found, bytes.data() + bytes.size() - sizeof found, sizeof found);
    EXPECT_EQ(found, sum);
  }
  EXPECT_EQ(unsealed(Writer().sealed("title"), "title"), "");
  const auto one = [](const auto& store, auto& number) { return store(number); };
  const auto two = [](const auto& store, auto& number) { return store(number) && store(number); };
  const std::uint32_t seven = 7;
  const std::string bytes = packed("a", two, seven);
  EXPECT_EQ(unpacked<std::uint32_t>(bytes, "a", two), 7u);
  EXPECT_FALSE(unpacked<std::uint32_t>(bytes, "b", two));
  EXPECT_FALSE(unpacked<std::uint32_t>(bytes, "a", one));
  EXPECT_FALSE(unpacked<std::uint32_t>(packed("a", one, seven), "a", two));
  const std::uint64_t huge = std::uint64_t(1) << 60;  // read as the length of a text
  EXPECT_FALSE(unpacked<std::string>(packed("a", one, huge), "a", one));
}

TEST(Cache, a_damaged_file_is_made_again_bit_for_bit) {
  const test::Folder folder;
  ::setenv("XDG_CACHE_HOME", folder.path.c_str(), 1);
  load_model("square", fresh());
  EXPECT_TRUE(test::files_below(folder.path).empty());
  const auto first = load_model("square");
  const std::vector<fs::path> files = test::files_below(folder.path);
  ASSERT_EQ(files.size(), 1u);
  const fs::path& file = files.front();
  EXPECT_EQ(file.filename(), "square-1fd840bf8fea4b70.mesh");  // as long as no recipe changes
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0644));
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
  MeshOptions options;
  std::string said;
  options.progress = [&](const std::string& line) { said = line; };
  EXPECT_EQ(load_model("banisch-grass", options)->triangle.size(), 16u);
  EXPECT_TRUE(said.ends_with(".mesh could not be written; the mesh is not cached")) << said;

  fs::create_directory(folder.path / "folder");
  EXPECT_FALSE(write_cache_file(folder.path / "folder", "x"));
  EXPECT_EQ(test::files_below(folder.path).size(), 1u);
}

}  // namespace
}  // namespace pelage
