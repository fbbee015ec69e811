// Tests files of archives, mesh files that refer to other files, and mesh files that begin with a byte-order
// mark.
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "harness/mesh/read/formats.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

/// Returns the bytes of a glTF buffer: the points of a tetrahedron (12 floats), then its faces (12 16-bit
/// integers).
std::string buffer(float size) {
  const float points[12] = {size, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1};
  const std::uint16_t faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  std::string bytes(reinterpret_cast<const char*>(points), sizeof points);
  return bytes.append(reinterpret_cast<const char*>(faces), sizeof faces);
}

std::string gltf_with(const std::string& uri) {
  return test::gltf_text(uri, 4, 12);
}

std::string refusal_of(const std::string& file) {
  return test::refusal([&] { load_model(file, fresh()); });
}

struct OutsideFiles : test::InFolder {};

TEST_F(OutsideFiles, AreThoseThatTheGltfFileNames) {
  folder.write("a bed.bin", buffer(1));
  EXPECT_EQ(detail::gltf_files(folder.write("a.gltf", gltf_with("a%20bed.bi%6E"))),
            std::vector<fs::path>{folder.path / "a bed.bin"});
  EXPECT_TRUE(
      detail::gltf_files(folder.write("b.gltf", gltf_with("data:application/octet-stream;base64,AAAA")))
          .empty());
  EXPECT_TRUE(detail::gltf_files(folder.write("c.gltf", "no JSON")).empty());
  EXPECT_TRUE(detail::gltf_files(R"({"buffers": [7, {}, {"uri": 7}]})", "e.gltf").empty());
  const std::string json = gltf_with("a%20bed.bin");
  std::string binary = "glTF" + std::string("\2\0\0\0\0\0\0\0", 8);
  const auto length = std::uint32_t(json.size());
  binary.append(reinterpret_cast<const char*>(&length), 4).append("JSON").append(json);
  EXPECT_EQ(detail::gltf_files(folder.write("d.glb", binary)).size(), 1u);
}

TEST_F(OutsideFiles, OfAGltfFileStandInItsFolderAndAreRegular) {
  fs::create_directory(folder.path / "inner");
  folder.write("outside.bin", buffer(1));
  ASSERT_EQ(::mkfifo((folder.path / "pipe").c_str(), 0600), 0);
  for (const char* uri :
       {"/etc/passwd", "../outside.bin", "x/../../outside.bin", "%2e%2e/outside.bin", "file:///etc"}) {
    const std::string text = refusal_of(folder.write("inner/a.gltf", gltf_with(uri)));
    EXPECT_NE(text.find("it may refer only to files in its own folder"), std::string::npos)
        << uri << ": " << text;
  }
  for (const char* uri : {"pipe", "missing.bin", "inner"}) {
    const std::string text = refusal_of(folder.write("a.gltf", gltf_with(uri)));
    EXPECT_NE(text.find("which does not exist or is not a regular file"), std::string::npos)
        << uri << ": " << text;
  }
}

// The cache returns the mesh for a relative path too, and must not return it after a buffer file has changed.
TEST_F(OutsideFiles, AnEditedBufferGivesAnotherMesh) {
  ::setenv("XDG_CACHE_HOME", folder.path.c_str(), 1);
  folder.write("a.bin", buffer(1));
  const std::string file = folder.write("a.gltf", gltf_with("a.bin"));
  const std::string before = load_model(file)->hash;
  EXPECT_EQ(load_model(fs::relative(file).string())->hash, before);
  EXPECT_EQ(test::files_below(folder.path, ".mesh").size(), 1u);
  folder.write("a.bin", buffer(2));
  EXPECT_NE(load_model(file)->hash, before);
  ::unsetenv("XDG_CACHE_HOME");
}

TEST_F(OutsideFiles, AByteOrderMarkIsNoPartOfTheFirstLine) {
  const std::string obj = "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string plain = folder.write("a.obj", obj), marked = folder.write("b.obj", "\xef\xbb\xbf" + obj);
  EXPECT_EQ(load_model(marked, fresh())->position, load_model(plain, fresh())->position);
}

// A name that is longer than the name field of a tar header, which has 100 bytes.
const std::string long_name = "meshes/" + std::string(60, 'a') + "/" + std::string(60, 'b') + ".off";

class Archive : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories((folder_.path / long_name).parent_path());
    for (unsigned i = 0, x = 1; i < 100000; ++i) noise_ += char((x = x * 1664525 + 1013904223) >> 24);
    folder_.write("meshes/noise.off", noise_);
    folder_.write("meshes/empty.off", "");
    folder_.write(long_name, "OFF long");
    const std::string command =
        "tar -C " + folder_.path.string() + " --sort=name -czf " + whole().string() + " meshes";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
  fs::path whole() const { return folder_.path / "whole.tar.gz"; }
  static std::string error_of(const fs::path& file, const std::string& member) {
    return test::refusal([&] { read_member(file, member); });
  }
  test::Folder folder_;
  std::string noise_;
};

TEST_F(Archive, GivesTheBytesOfAMember) {
  EXPECT_EQ(read_member(whole(), "meshes/noise.off"), noise_);
  EXPECT_EQ(read_member(whole(), "meshes/empty.off"), "");
  EXPECT_EQ(read_member(whole(), "meshes/none.off"), std::nullopt);
}

TEST_F(Archive, ReadsNamesOfMoreThan100Bytes) {
  EXPECT_EQ(read_member(whole(), long_name), "OFF long");
}

TEST_F(Archive, SaysInOneLineWhatIsWrong) {
  const fs::path none = folder_.path / "none.tar.gz", cut = folder_.path / "cut.tar.gz",
                 garbage = folder_.path / "garbage.tar.gz";
  EXPECT_EQ(error_of(none, "x"), none.string() + ": no such file");
  EXPECT_EQ(error_of(folder_.path, "x"), folder_.path.string() + ": no such file");
  const std::string bytes = test::text_of(whole()),
                    damage = ": the archive is damaged; install its package again";
  std::ofstream(cut, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  EXPECT_EQ(error_of(cut, "meshes/noise.off"), cut.string() + damage);
  std::ofstream(garbage, std::ios::binary) << noise_;
  EXPECT_EQ(error_of(garbage, "meshes/noise.off"), garbage.string() + damage);
}

}  // namespace
}  // namespace pelage
