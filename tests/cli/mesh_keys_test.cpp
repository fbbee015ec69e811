// Tests that the scene's mesh keys change the picture, and that defects of the mesh are reported on stderr
// and in the rows of results.
#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

// A tetrahedron whose four faces cover the same triangle of its UV map.
const char* const overlapping =
    "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nvt 0.1 0.1\nvt 0.9 0.1\nvt 0.1 0.9\n"
    "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 1/1 4/2 3/3\nf 2/1 3/2 4/3\n";
const std::string small_picture =
    "render --pipeline reference --set fur.layers=4 --set fur.texture=64 --size 64x48 ";

struct MeshKeys : InFolder {};

TEST_F(MeshKeys, AWarningOfOverlapReachesRender) {
  folder.write("t.obj", overlapping);
  const std::string render = small_picture + "-o a.png --model t.obj ";
  expect_has(done(render + "--set fur.uv=file").err, "t: UV map: 100.00% of the map overlaps");
  // The second run reads the mesh from the cache.
  expect_has(done(render + "--set fur.uv=file").err, "t.obj: kept the file's own UV map");
  expect_lacks(done(render).err, "overlaps");
  expect_has(done("mesh t.obj --keep-uv").err, "t: UV map: 100.00% of the map overlaps");
}

TEST_F(MeshKeys, AWarningOfOverlapReachesTheRows) {
  folder.write("t.obj", overlapping);
  folder.write("own.toml",
               experiment("model = ['torus']\nlayers = [4]\nsize = ['64x48']", "fur.uv = 'file'"));
  pelage("run own.toml --model t.obj -o out");
  expect_has(folder.read(journal_in(folder, "out")),
             {"\"mesh_warnings\":[\"kept the file's own UV map", "\"UV map: 100.00% of the map overlaps"});
}

TEST_F(MeshKeys, AFileWhoseZAxisPointsUpIsTurned) {
  const std::string render = small_picture + "--model banisch-dog ";
  done(render + "-o y.png");
  done(render + "-o z.png --up z");
  done(render + "-o key.png --set mesh.up=z");
  done(render + "-o turned.png --set 'mesh.rotate=[-90, 0, 0]'");
  EXPECT_NE(folder.read("y.png"), folder.read("z.png"));
  EXPECT_EQ(folder.read("key.png"), folder.read("z.png"));
  EXPECT_EQ(folder.read("turned.png"), folder.read("z.png"));
  expect_has(done("mesh banisch-dog --up z --rotate 10,0,0").out,
             "turned by -80, 0 and 0 degrees about x, y and z");
  EXPECT_EQ(pelage("mesh banisch-dog --up x").code, 2);
  EXPECT_EQ(pelage("mesh banisch-dog --up z --rotate -361,0,0").code, 2);
  done("mesh banisch-dog --up z --rotate -360,0,0");
}

TEST_F(MeshKeys, RepairsArePrintedAtEachUse) {
  // The comment in the OBJ file makes its content unique, so that the mesh is not yet in the mesh cache.
  folder.write("t.obj", std::string(overlapping) + "f 1/1 3/2 2/3\n# " + folder.path.string() + "\n");
  const std::string render = small_picture + "-o a.png --model t.obj ";
  expect_has(pelage(render).err, "dropped 1 degenerate or doubled face");
  expect_has(done(render).err, "dropped 1 degenerate or doubled face");
  expect_has(pelage("mesh t.obj").out, "dropped 1 degenerate or doubled face");
}

}  // namespace
}  // namespace pelage::cli
