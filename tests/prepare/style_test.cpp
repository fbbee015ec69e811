// Tests the preparation of maps and colliders, and the refusal of bad ones.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/prepare/contact.hpp"
#include "harness/prepare/picture_map.hpp"
#include "harness/prepare/strands.hpp"
#include "tests/support/files.hpp"
#include "tests/support/style_scenes.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using namespace style_scenes;

using test::refusal;

TEST(Style, HasOneValuePerTriangleOrPoint) {
  const test::Folder folder;
  const auto map = write_map(folder.path / "u.exr", 256, 1, [](glm::vec2 uv) { return uv.x; });
  Scene scene;
  scene.fur.length_map = scene.fur.comb_map = scene.curl.radius_map = scene.curl.turns_map = map;
  const auto mesh = load_model("torus-40x24");
  const Skin skin = weld(*mesh);
  const Style style = make_style(*mesh, skin, scene);
  ASSERT_EQ(style.length.size(), mesh->triangle.size());
  ASSERT_EQ(style.comb.size(), mesh->welded);
  EXPECT_TRUE(style.density.value.empty());
  for (std::size_t f = 0; f < style.length.size(); ++f) {
    const glm::uvec3 t = mesh->triangle[f];
    const float u = (mesh->uv[t.x].x + mesh->uv[t.y].x + mesh->uv[t.z].x) / 3;
    EXPECT_NEAR(style.length[f], u, 1e-5f);
  }
  for (std::size_t w = 0; w < style.comb.size(); ++w) {
    const float u = std::clamp(mesh->uv[skin.first_copy[w]].x, 0.5f / 256, 1 - 0.5f / 256);
    EXPECT_NEAR(style.comb[w], u, 1e-5f);
    EXPECT_EQ(style.curl_radius[w], style.comb[w]);
    EXPECT_EQ(style.curl_turns[w] * turn_steps, std::rint(style.comb[w] * turn_steps));
  }
}

TEST(Style, LimitsTheLengthFromBelow) {
  const test::Folder folder;
  Scene scene;
  scene.fur.length_map = write_map(folder.path / "zero.exr", 2, 2, [](glm::vec2) { return 0.0f; });
  const auto mesh = load_model("torus-24x16");
  for (const float share : make_style(*mesh, weld(*mesh), scene).length) EXPECT_EQ(share, least_length_share);
}

TEST(Style, RefusesPicturesThatAreNoMaps) {
  const test::Folder folder;
  const auto with = [](const std::filesystem::path& file) {
    return refusal([&] { small_torus([&](Scene& s) { s.curl.turns_map = file; }); });
  };
  const std::string missing = with(folder.path / "missing.png");
  test::expect_has(missing, {"curl.turns_map", "missing.png"});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string not_a_number =
      with(write_map(folder.path / "nan.exr", 2, 2, [&](glm::vec2) { return nan; }));
  test::expect_has(not_a_number, "not a number");
  const std::string bright = with(write_map(folder.path / "two.exr", 2, 2, [](glm::vec2) { return 2.0f; }));
  test::expect_has(bright, "at most 1");
}

TEST(ContactField, RefusesAnOpenMesh) {
  const test::Folder folder;
  Mesh open = *load_model("torus-24x16");
  open.triangle.resize(open.triangle.size() / 2);
  write_ply(folder.path / "open.ply", open);
  ContactMeshScene scene;
  scene.file = folder.path / "open.ply";
  const std::string message = refusal([&] { contact_fields(scene); });
  test::expect_has(message, {"not closed", "open.ply"});
  scene.file = folder.path / "missing.ply";
  test::expect_has(refusal([&] { contact_fields(scene); }), "contact.mesh");
}

TEST(ContactField, RefusesFilesThatAreNoFrames) {
  const test::Folder folder;
  const Mesh torus = *load_model("torus-24x16");
  const auto with = [&](const char* file, int frames, int cells = 8) {
    ContactMeshScene scene;
    scene.file = folder.path / file;
    scene.frames = frames;
    scene.cells = cells;
    return refusal([&] { contact_fields(scene); });
  };
  for (const char* name : {"plain.ply", "ring-0.ply", "ring-1.ply"}) write_ply(folder.path / name, torus);
  write_ply(folder.path / "ring-2.ply", *load_model("torus-24x12"));
  EXPECT_EQ(with("ring-0.ply", 2), "accepted");
  test::expect_has(with("plain.ply", 2), {"contact.mesh_frames", "plain.ply", "needs a number"});
  test::expect_has(with("ring-0.ply", 3), {"contact.mesh_frames", "ring-2.ply", "are not those of"});
}

TEST(ContactField, HasTheDistancesOfEachFile) {
  const test::Folder folder;
  const Mesh torus = *load_model("torus-60x36");
  ContactMeshScene scene;
  scene.file = folder.path / "ring-0.ply";
  scene.frames = 3;
  scene.cells = 24;
  for (int i = 0; i < 3; ++i) {
    Mesh moved = torus;
    for (glm::vec3& p : moved.position) p = (1 + 0.5f * float(i)) * p + glm::vec3(0.2f * float(i), 0, 0);
    write_ply(folder.path / fmt::format("ring-{}.ply", i), moved);
  }
  const ContactFields fields = contact_fields(scene);
  ASSERT_EQ(fields.size(), 3u);
  const DistanceField alone = distance_field(load_model((folder.path / "ring-0.ply").string()), 24);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(fields[std::size_t(i)]->nodes, fields[0]->nodes);
    EXPECT_EQ(fields[std::size_t(i)]->origin, fields[0]->origin);
    const double scale = 1 + 0.5 * i;
    for (const glm::dvec3 p : {glm::dvec3(0.7, 0.1, 0.2), {0.1, -0.3, 0.6}, {0.05, 0.02, 0.01}})
      EXPECT_NEAR(value_at(*fields[std::size_t(i)], scale * p + glm::dvec3(0.2 * i, 0, 0)),
                  scale * value_at(alone, p), 0.05)
          << i;
  }
}

TEST(ContactMoment, TurnsAndCountsFiles) {
  ContactMeshScene mesh;
  DynamicsScene dynamics;
  dynamics.step = 1.0f / 256;
  dynamics.substeps = 4;
  mesh.axis = {0, 0, 5};
  mesh.spin = 2;
  mesh.frames = 3;
  mesh.motion.begin = 1;
  const double quarter = std::acos(-1.0) / 4;
  const glm::dvec3 x(1, 0, 0);
  EXPECT_EQ(contact_moment(mesh, dynamics, 0.5).turn * x, x);  // before the beginning
  EXPECT_LT(glm::distance(contact_moment(mesh, dynamics, 1 + quarter).turn * x, glm::dvec3(0, 1, 0)), 1e-12);
  mesh.spin = 1000;  // 3600 s
  EXPECT_LT(glm::distance(contact_moment(mesh, dynamics, 3601).turn * x,
                          glm::dvec3(std::cos(3.6e6), std::sin(3.6e6), 0)),
            1e-8);
  const ContactMoment m = contact_moment(mesh, dynamics, 1 + 2.75 / 64);
  EXPECT_EQ(m.file, 2);
  EXPECT_DOUBLE_EQ(m.share, 0.75);
  EXPECT_EQ(m.spin, glm::dvec3(0, 0, 1000));
  for (const int interval : {0, 1, 2, 3, 4, 215999}) {
    mesh.after_frames = "hold";
    EXPECT_EQ(field_of_interval(mesh, interval), std::size_t(std::min(interval, 2)));
    mesh.after_frames = "repeat";
    EXPECT_EQ(field_of_interval(mesh, interval), std::size_t(interval % 3));
  }
}

/// Reads a picture of 2 x 2 pixels, written as EXR, whose values are not rounded.
PictureMap map_of_file(const Picture& picture) {
  const test::Folder folder;
  write_picture(folder.path / "map.exr", picture);
  return PictureMap(folder.path / "map.exr");
}

Picture four(float top_left, float top_right, float bottom_left, float bottom_right) {
  Picture picture{2, 2, {}};
  for (const float value : {top_left, top_right, bottom_left, bottom_right})
    picture.pixel.emplace_back(value, 2 * value, 3 * value, 1);
  return picture;
}

TEST(PictureMap, InterpolatesBetweenPixelCentresWithTheTopRowAtVOfOne) {
  const PictureMap map = map_of_file(four(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(map.width(), 2);
  EXPECT_EQ(map.height(), 2);
  EXPECT_FLOAT_EQ(map.at({0.25, 0.75}).x, 0.1f);
  EXPECT_FLOAT_EQ(map.at({0.75, 0.75}).x, 0.2f);
  EXPECT_FLOAT_EQ(map.at({0.25, 0.25}).y, 0.6f);
  EXPECT_FLOAT_EQ(map.at({0.75, 0.25}).z, 1.2f);
  EXPECT_FLOAT_EQ(map.at({0.5, 0.5}).x, 0.25f);
  EXPECT_FLOAT_EQ(map.at({0.5, 0.75}).x, 0.15f);
  EXPECT_FLOAT_EQ(map.at({-3, 5}).x, 0.1f);  // outside the unit square
  EXPECT_FLOAT_EQ(map.at({7, -1}).x, 0.4f);
}

TEST(PictureMap, RefusesNegativeValues) {
  EXPECT_THROW(map_of_file(four(0.1f, -0.2f, 0.3f, 0.4f)), InputError);
}

}  // namespace
}  // namespace pelage
