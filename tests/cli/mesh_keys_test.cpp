// Tests that the scene's mesh keys change the picture, and that defects of the mesh are reported on stderr
// and in the rows of results.
#include <gtest/gtest.h>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

// A tetrahedron whose four faces cover the same triangle of its UV map.
const char* const overlapping =
    "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nvt 0.1 0.1\nvt 0.9 0.1\nvt 0.1 0.9\n"
    "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 1/1 4/2 3/3\nf 2/1 3/2 4/3\n";
const char* const small_picture = " --set fur.layers=4 --set fur.texture=64 --size 64x48 ";

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(MeshKeys, AWarningOfOverlapReachesRender) {
  const Folder folder;
  folder.write("t.obj", overlapping);
  const std::string render =
      std::string("render --pipeline reference -o a.png --model t.obj") + small_picture;
  const Outcome kept = pelage(folder, render + "--set fur.uv=file");
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_TRUE(holds(kept.err, "t: UV map: 100.00% of the map overlaps")) << kept.err;
  const Outcome computed = pelage(folder, render);
  EXPECT_EQ(computed.code, 0) << computed.err;
  EXPECT_FALSE(holds(computed.err, "overlaps")) << computed.err;
  const Outcome mesh = pelage(folder, "mesh t.obj --keep-uv");
  EXPECT_EQ(mesh.code, 0) << mesh.err;
  EXPECT_TRUE(holds(mesh.err, "t: UV map: 100.00% of the map overlaps")) << mesh.err;
}

TEST(MeshKeys, AWarningOfOverlapReachesTheRows) {
  const Folder folder;
  folder.write("t.obj", overlapping);
  folder.write("one.toml",
               "name = 'one'\ntitle = 'one'\n[axes]\nmodel = ['torus']\nlayers = [4]\nsize = ['64x48']\n"
               "[scene]\nfur.texture = 64\nfur.uv = 'file'\n"
               "[preset.quick]\nwarm_up_s = 0.0\nleast = 2\nmost = 2\nprecision = 1.0\nlimit_s = 5.0\n");
  const Outcome run = pelage(folder, "run one.toml --model t.obj -o out; cat out/one/*.jsonl >rows");
  const std::string rows = folder.read("rows");
  ASSERT_TRUE(holds(rows, "\"mesh_warnings\":[\"UV map: 100.00% of the map overlaps")) << run.err << rows;
}

TEST(MeshKeys, AMissingMapIsOneErrorAndExitCode2) {
  const Folder folder;
  folder.write("t.off", "OFF\n4 4 0\n1 1 1\n-1 -1 1\n-1 1 -1\n1 -1 -1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  for (const std::string& arguments :
       {std::string("render --pipeline reference -o a.png --model t.off --set fur.uv=file") + small_picture,
        std::string("mesh t.off --keep-uv")}) {
    const Outcome outcome = pelage(folder, arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(holds(outcome.err, "t.off: has no UV map of its own")) << outcome.err;
  }
}

TEST(MeshKeys, ARotationChangesThePicture) {
  const Folder folder;
  const std::string render = std::string("render --pipeline reference --model banisch-dog") + small_picture;
  EXPECT_EQ(pelage(folder, render + "-o a.png").code, 0);
  EXPECT_EQ(pelage(folder, render + "-o b.png --set 'mesh.rotate=[0, 90, 0]'").code, 0);
  EXPECT_NE(folder.read("a.png"), folder.read("b.png"));
  const Outcome mesh = pelage(folder, "mesh banisch-dog --rotate -90,0,0");
  EXPECT_EQ(mesh.code, 0) << mesh.err;
  EXPECT_TRUE(holds(mesh.out, "turned by -90, 0 and 0 degrees about x, y and z")) << mesh.out;
}

TEST(MeshKeys, AFileWhoseZAxisPointsUpIsTurned) {
  const Folder folder;
  const std::string render = std::string("render --pipeline reference --model banisch-dog") + small_picture;
  EXPECT_EQ(pelage(folder, render + "-o y.png").code, 0);
  EXPECT_EQ(pelage(folder, render + "-o z.png --up z").code, 0);
  EXPECT_EQ(pelage(folder, render + "-o key.png --set mesh.up=z").code, 0);
  EXPECT_EQ(pelage(folder, render + "-o turned.png --set 'mesh.rotate=[-90, 0, 0]'").code, 0);
  EXPECT_NE(folder.read("y.png"), folder.read("z.png"));
  EXPECT_EQ(folder.read("key.png"), folder.read("z.png"));
  EXPECT_EQ(folder.read("turned.png"), folder.read("z.png"));
  const Outcome mesh = pelage(folder, "mesh banisch-dog --up z --rotate 10,0,0");
  EXPECT_TRUE(holds(mesh.out, "turned by -80, 0 and 0 degrees about x, y and z")) << mesh.out;
  EXPECT_EQ(pelage(folder, "mesh banisch-dog --up x").code, 2);
  EXPECT_EQ(pelage(folder, "mesh banisch-dog --up z --rotate -361,0,0").code, 2);
  EXPECT_EQ(pelage(folder, "mesh banisch-dog --up z --rotate -360,0,0").code, 0);
}

TEST(MeshKeys, RepairsArePrintedOnceAndByTheCommandMesh) {
  const Folder folder;
  // The comment in the OBJ file makes its content unique, so that the mesh is not yet in the mesh cache.
  folder.write("t.obj", std::string(overlapping) + "f 1/1 3/2 2/3\n# " + folder.path().string() + "\n");
  const std::string render =
      std::string("render --pipeline reference -o a.png --model t.obj") + small_picture;
  const Outcome first = pelage(folder, render), second = pelage(folder, render);
  EXPECT_TRUE(holds(first.err, "dropped 1 degenerate or doubled face")) << first.err;
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_FALSE(holds(second.err, "dropped")) << second.err;
  EXPECT_TRUE(holds(pelage(folder, "mesh t.obj").out, "dropped 1 degenerate or doubled face"));
}

}  // namespace
}  // namespace pelage::cli
