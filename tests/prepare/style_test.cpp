// Tests the preparation of maps and colliders, and the refusal of bad ones.

#include <limits>

#include "harness/error.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/prepare/picture_map.hpp"
#include "harness/prepare/scene_mesh.hpp"
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
  const std::string message = refusal([&] { contact_field(scene); });
  test::expect_has(message, {"not closed", "open.ply"});
  scene.file = folder.path / "missing.ply";
  test::expect_has(refusal([&] { contact_field(scene); }), "contact.mesh");
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
