// Tests the frames of a mesh that moves and deforms.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/error.hpp"
#include "harness/mesh/finish.hpp"
#include "harness/mesh/mesh.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using Move = std::function<glm::dvec3(glm::dvec3)>;

constexpr int around = 24, along = 12;

/// The point (i, j) of a torus that is not at the origin and has no unit size.
glm::dvec3 torus_point(int i, int j) {
  const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / along;
  const double radius = 7 + 2 * std::cos(v);
  return glm::dvec3(radius * std::cos(u), 2 * std::sin(v), radius * std::sin(u)) + glm::dvec3(30, -5, 11);
}

/// Returns the torus as an OBJ file, with each point moved. `faces`: number of faces, from the first one on.
std::string torus(const Move& move, int faces = 2 * around * along) {
  std::string text;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      const glm::dvec3 p = move(torus_point(i, j));
      text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
    }
  for (int f = 0; f < faces; ++f) {
    const int i = f / 2 / along, j = f / 2 % along, right = (i + 1) % around, up = (j + 1) % along;
    const int a = i * along + j, b = right * along + j, c = right * along + up, d = i * along + up;
    text += f % 2 == 0 ? fmt::format("f {} {} {}\n", a + 1, c + 1, b + 1)
                       : fmt::format("f {} {} {}\n", a + 1, d + 1, c + 1);
  }
  return text;
}

glm::dvec3 bent(glm::dvec3 p, int frame) {
  return p + glm::dvec3(0.3 * frame, 0.1 * frame * std::sin(p.x), 0);
}

std::string refusal_of_frames(const test::Folder& folder, const std::string& first, int count) {
  return test::refusal([&] {
    read_mesh_frames(*load_model((folder.path / first).string(), fresh()), folder.path / first, count,
                     glm::dvec3(0));
  });
}

struct MeshFrames : test::InFolder {};

TEST_F(MeshFrames, FilesCountUp) {
  EXPECT_EQ(frame_file("walk/a-0009.obj", 0), "walk/a-0009.obj");
  EXPECT_EQ(frame_file("walk/a-0009.obj", 1), "walk/a-0010.obj");
  EXPECT_EQ(frame_file("walk2/a9.final.ply", 2), "walk2/a11.final.ply");
  EXPECT_EQ(frame_file("9999999999.off", 1), "10000000000.off");
  EXPECT_EQ(frame_file("20261125123456789.off", 1), "20261125123456790.off");
  EXPECT_THROW(frame_file("walk3/a.obj", 1), InputError);
}

TEST_F(MeshFrames, HaveThePlacementOfTheFirstFrame) {
  for (int frame = 0; frame < 3; ++frame)
    folder.write(fmt::format("ring{}.obj", frame), torus([&](glm::dvec3 p) { return bent(p, frame); }));
  MeshOptions options = fresh();
  options.rotate = {20, 40, -70};
  const auto mesh = load_model((folder.path / "ring0.obj").string(), options);
  const auto frames = read_mesh_frames(*mesh, folder.path / "ring0.obj", 3, glm::dvec3(options.rotate));
  ASSERT_EQ(frames.size(), 3u);
  std::vector<glm::vec3> rest(mesh->welded);
  for (std::size_t v = 0; v < mesh->position.size(); ++v) rest[mesh->weld[v]] = mesh->position[v];
  // The centre and the radius of the torus give the point of the file that a surface point was.
  const glm::dmat3 back = glm::transpose(rotation_matrix(glm::dvec3(options.rotate)));
  for (std::size_t w = 0; w < rest.size(); ++w) {
    EXPECT_LT(glm::distance(frames[0][w], rest[w]), 1e-6f);
    const glm::dvec3 file = 9.0 * (back * glm::dvec3(rest[w])) + glm::dvec3(30, -5, 11);
    for (const int frame : {1, 2}) {
      const glm::dvec3 moved = back * glm::dvec3(frames[std::size_t(frame)][w] - frames[0][w]);
      EXPECT_LT(glm::distance(9.0 * moved, bent(file, frame) - file), 1e-3) << w;
    }
  }
}

// Exporters print small negative numbers as -0.
TEST_F(MeshFrames, MayHavePointsWithNegativeZeros) {
  const Move centred = [](glm::dvec3 p) {
    p -= glm::dvec3(30, -5, 11);
    for (int k = 0; k < 3; ++k)
      if (std::abs(p[k]) < 1e-9) p[k] = -0.0;
    return p;
  };
  // No face has the last point.
  for (const int frame : {1, 2}) folder.write(fmt::format("z{}.obj", frame), torus(centred) + "v 90 0 0\n");
  test::expect_has(torus(centred), " -0 ");
  EXPECT_EQ(refusal_of_frames(folder, "z1.obj", 2), "accepted");
}

TEST_F(MeshFrames, ThatDoNotMatchAreRefused) {
  const Move still = [](glm::dvec3 p) { return p; };
  folder.write("a1.obj", torus(still));
  test::expect_has(refusal_of_frames(folder, "a1.obj", 2), "a2.obj");
  test::expect_has(refusal_of_frames(folder, "a1.obj", 2'000'000), "at most 357913941 points");
  folder.write("a2.obj", torus(still, 2 * around * along - 1));
  test::expect_has(refusal_of_frames(folder, "a1.obj", 2), "the points or faces are not those of");
  folder.write("a2.obj", "no mesh");
  test::expect_has(refusal_of_frames(folder, "a1.obj", 2), "a2.obj");

  // Two tori of the same points, of which only one moves.
  const std::string text = torus(still);
  const auto twice = [&](const Move& move) {
    std::string both = text.substr(0, text.find('f')) + torus(move).substr(0, torus(move).find('f'));
    both += text.substr(text.find('f'));
    return both +
           fmt::format("f {} 2 {}\n", around * along + 1, along + 2);  // the face (1, 2, along + 2) again
  };
  folder.write("b1.obj", twice(still));
  folder.write("b2.obj", twice([](glm::dvec3 p) { return p + glm::dvec3(0, 1, 0); }));
  test::expect_has(refusal_of_frames(folder, "b1.obj", 2),
                   "b2.obj: the points 1 and 289 coincide in the first frame and part here");
}

// Small holes are filled, and the points of the faces that fill them come from the file. A part that the
// preparation drops makes the box of the file larger than that of the mesh.
TEST_F(MeshFrames, PartsThatThePreparationDropsAreRefused) {
  const auto with_speck = [](const std::string& text) {
    const std::size_t faces = text.find('f');
    const int points = around * along;
    return text.substr(0, faces) + "v 60 60 60\nv 60 60.1 60\nv 60.1 60 60\n" + text.substr(faces) +
           fmt::format("f {} {} {}\n", points + 1, points + 2, points + 3);
  };
  for (const int frame : {1, 2})
    folder.write(fmt::format("c{}.obj", frame), with_speck(torus([](glm::dvec3 p) { return p; })));
  test::expect_has(refusal_of_frames(folder, "c1.obj", 2), "the preparation of this mesh moved");
}

}  // namespace
}  // namespace pelage
