// Tests each map of a fur layer with small pictures (docs/strands.md, section Authoring).
#include <algorithm>
#include <numbers>
#include <span>

#include "tests/strands/groom/groom.hpp"

namespace pelage::strands {
namespace {

using pelage::test::Folder;
using namespace test;

using PathOf = std::filesystem::path StrandLayerScene::*;
using ValueOf = float StrandLayerScene::*;

Fur grown(const StrandsScene& scene) {
  return grow(square(), scene, plain_coat());
}

TEST(FurMaps, WhiteMapsChangeNothing) {
  const Folder folder;
  StrandsScene scene = even();
  StrandLayerScene& layer = scene.layers.front();
  layer.length_spread = 0.3f;
  layer.curvature = 20;
  layer.curvature_spread = 10;
  layer.twist = -30;
  layer.twist_spread = 60;
  const Fur plain = grown(scene);
  for (const PathOf map :
       {&StrandLayerScene::mask, &StrandLayerScene::density_map, &StrandLayerScene::length_map,
        &StrandLayerScene::width_map, &StrandLayerScene::stiffness_map, &StrandLayerScene::curvature_map,
        &StrandLayerScene::twist_map, &StrandLayerScene::response_map}) {
    layer.*map = grey(folder, 255);
    EXPECT_EQ(difference(grown(scene), plain), "");
  }
}

TEST(FurMaps, AMapOfOneValueEqualsTheProductAsTheKey) {
  const Folder folder;
  const double v = double(read_picture(grey(folder, 102)).at(0, 0).x);
  struct Case {
    PathOf map;
    ValueOf value;
    double factor;
  };
  for (const Case& c : {Case{&StrandLayerScene::length_map, &StrandLayerScene::length, v},
                        Case{&StrandLayerScene::width_map, &StrandLayerScene::width, v},
                        Case{&StrandLayerScene::stiffness_map, &StrandLayerScene::stiffness, v},
                        Case{&StrandLayerScene::response_map, &StrandLayerScene::response, v},
                        Case{&StrandLayerScene::curvature_map, &StrandLayerScene::curvature, 2 * v - 1},
                        Case{&StrandLayerScene::twist_map, &StrandLayerScene::twist, 2 * v - 1}}) {
    StrandsScene scene = even();
    scene.layers.front().curvature = 35;
    scene.layers.front().twist = 50;
    const Fur plain = grown(scene);
    scene.layers.front().*c.map = grey(folder, 102);
    const Fur mapped = grown(scene);
    scene.layers.front().*c.map = "";
    scene.layers.front().*c.value = float(double(scene.layers.front().*c.value) * c.factor);
    EXPECT_EQ(difference(mapped, grown(scene)), "");
    EXPECT_NE(difference(mapped, plain), "");
  }
}

TEST(FurMaps, ADensityMapOfOneValueChangesNothing) {
  const Folder folder;
  StrandsScene scene = even();
  const Fur plain = grown(scene);
  scene.layers.front().density_map = grey(folder, 51);
  EXPECT_EQ(difference(grown(scene), plain), "");
}

TEST(FurMaps, AHalfBlackMaskLeavesNoStrandThere) {
  const Folder folder;
  StrandsScene scene = even(2000);
  scene.layers.front().mask =
      picture(folder, "half.png", 8, 8, [](int x, int) { return glm::ivec3(x < 4 ? 0 : 255); });
  const Fur fur = grown(scene);
  ASSERT_EQ(fur.strands.size(), 2000u);
  for (const KeyedStrand& s : fur.strands) ASSERT_GE(root_of(fur, s).x, -1e-6f);
  for (const KeyStrand& key : fur.keys)
    EXPECT_GE(key.root.x, -2.0f / 16) << "a key strand that no strand uses";
}

TEST(FurMaps, ThereAreNoStrandsOfLengthOrWidth0) {
  const Folder folder;
  for (const PathOf map : {&StrandLayerScene::length_map, &StrandLayerScene::width_map}) {
    StrandsScene scene = even(800);
    // The top row of the picture is at v = 1.
    scene.layers.front().*map =
        picture(folder, "bald.png", 4, 4, [](int, int y) { return glm::ivec3(y < 2 ? 0 : 200); });
    const Fur fur = grown(scene);
    ASSERT_EQ(fur.strands.size(), 800u);
    // The interpolated value is 200 up to v = 0.375. From there it falls linearly to 0 at v = 0.625, which is
    // y = 0.25.
    for (const KeyedStrand& s : fur.strands) ASSERT_LT(root_of(fur, s).y, 0.25f + 1e-6f);
  }
}

TEST(FurMaps, DensityIsProportionalToTheMap) {
  const Folder folder;
  StrandsScene scene = even(4000);
  scene.layers.front().density_map =
      picture(folder, "density.png", 2, 2, [](int x, int) { return glm::ivec3(x == 0 ? 64 : 255); });
  const Fur fur = grown(scene);
  // Between the pixel centres x = -1/2 and x = 1/2, the density is linear; it is 159.5 at x = 0.
  const double left = 0.5 * 64 + 0.5 * (64 + 159.5) / 2, right = 0.5 * 255 + 0.5 * (159.5 + 255) / 2;
  const auto few = std::count_if(fur.strands.begin(), fur.strands.end(),
                                 [&](const KeyedStrand& s) { return root_of(fur, s).x < 0; });
  EXPECT_NEAR(double(few), 4000 * left / (left + right), 60);
}

TEST(FurMaps, SignedMapsTurnAnglesInBothDirections) {
  const Folder folder;
  StrandsScene scene = even(600);
  StrandLayerScene& layer = scene.layers.front();
  layer.twist = 40;
  layer.curvature = 25;
  const auto signs = [](int x, int) { return glm::ivec3(x < 2 ? 0 : 255); };
  layer.twist_map = layer.curvature_map = picture(folder, "sign.png", 4, 1, signs);
  const Fur fur = grown(scene);
  int negative = 0, positive = 0;
  for (const KeyedStrand& s : fur.strands) {
    const float x = root_of(fur, s).x;
    if (std::abs(x) < 0.25f) continue;  // between the pixel centres
    (x < 0 ? negative : positive) += 1;
    ASSERT_EQ(s.twist, x < 0 ? -40 : 40);
    ASSERT_EQ(s.curvature, x < 0 ? -25 : 25);
  }
  EXPECT_GT(negative, 100);
  EXPECT_GT(positive, 100);
}

/// Returns the picture of one direction, in the components along growing u, along growing v and along the
/// normal. A byte b stands for the component 2 b / 255 - 1.
std::filesystem::path direction(const Folder& folder, glm::ivec3 bytes) {
  return picture(folder, "comb.png", 2, 2, [&](int, int) { return bytes; });
}

TEST(FurMaps, ACombMapOfOneDirectionLeansAllStrandsThere) {
  const Folder folder;
  StrandsScene scene = even();
  StrandLayerScene& layer = scene.layers.front();
  layer.lean = 50;
  for (const glm::ivec3 bytes : {glm::ivec3(255, 128, 128), glm::ivec3(0, 200, 128), glm::ivec3(90, 20, 200),
                                 glm::ivec3(128, 128, 255), glm::ivec3(128, 255, 90)}) {
    layer.comb_map = direction(folder, bytes);
    const glm::dvec3 d = glm::normalize(2.0 * glm::dvec3(bytes) / 255.0 - 1.0);
    const double angle = 50.0 * std::acos(std::clamp(d.z, 0.0, 1.0)) / (0.5 * std::numbers::pi);
    const double radians = angle * std::numbers::pi / 180, flat = std::hypot(d.x, d.y);
    const glm::dvec3 expected(std::sin(radians) * d.x / flat, std::sin(radians) * d.y / flat,
                              std::cos(radians));
    const Fur fur = grown(scene);
    for (const KeyStrand& key : fur.keys)
      ASSERT_LT(glm::distance(glm::dvec3(key.rest), expected), 1e-5) << bytes.x << ' ' << bytes.y;
  }
}

TEST(FurMaps, ACombMapFollowsTheUvOfACurvedSurface) {
  const Folder folder;
  const Mesh torus = synthetic::grid(synthetic::torus(), 60, 30);
  StrandsScene scene = even(3000);
  scene.layers.front().lean = 90;
  scene.layers.front().comb_map = direction(folder, {255, 128, 128});
  const Fur fur = grow(torus, scene, plain_coat());
  for (const KeyStrand& key : fur.keys) {
    // u runs around the y axis.
    const glm::vec3 along = glm::normalize(glm::cross(key.root, glm::vec3(0, 1, 0)));
    ASSERT_GT(std::abs(glm::dot(key.rest, along)), 0.99f);
    ASSERT_GE(glm::dot(key.rest, key.normal), 0.0f);
  }
}

TEST(FurMaps, ErrorsNameTheKeyAndTheFile) {
  const Folder folder;
  const auto expect = [](const StrandsScene& scene, std::initializer_list<std::string> words) {
    pelage::test::expect_has(refusal(square(), scene), words);
  };
  const std::vector<std::pair<PathOf, const char*>> maps{{&StrandLayerScene::mask, "mask"},
                                                         {&StrandLayerScene::density_map, "density_map"},
                                                         {&StrandLayerScene::length_map, "length_map"},
                                                         {&StrandLayerScene::width_map, "width_map"},
                                                         {&StrandLayerScene::stiffness_map, "stiffness_map"},
                                                         {&StrandLayerScene::curvature_map, "curvature_map"},
                                                         {&StrandLayerScene::twist_map, "twist_map"},
                                                         {&StrandLayerScene::comb_map, "comb_map"},
                                                         {&StrandLayerScene::film, "film"}};
  for (const auto& [map, key] : maps) {
    StrandsScene scene = even(10);
    scene.layers.push_back(scene.layers.front());
    scene.layers[1].*map = folder.path / "absent.png";
    expect(scene, {std::string("strands.layer[2].") + key + ": ", "absent.png"});
  }
  for (const auto& [map, key] : std::span(maps).first(4)) {  // without them there is a place for strands
    StrandsScene scene = even(100000);                       // the error comes without a long search
    scene.layers.front().*map = grey(folder, 0);
    expect(scene, {std::string("strands.layer[1].") + key + ": ", "grey0.png", "no place for strands"});
  }
  StrandsScene scene = even(100);
  scene.layers.front().region_centre = {5, 0, 0};
  scene.layers.front().region_radius = 1;
  expect(scene, {"strands.layer[1].region_radius: leaves no place for strands"});
  // Region and mask both have a place, but not a common one.
  scene.layers.front().region_centre = {-1, 0, 0};
  scene.layers.front().region_radius = 0.5f;
  scene.layers.front().mask =
      picture(folder, "right.png", 8, 8, [](int x, int) { return glm::ivec3(x < 4 ? 0 : 255); });
  expect(scene, {"strands.layer[1].mask: ", "right.png", "together with region_radius"});
  scene = even(100);
  scene.layers.front().comb_map = direction(folder, {128, 127, 128});
  expect(scene, {"strands.layer[1].comb_map: ", "comb.png", "zero"});
  scene = even(100);
  scene.layers.front().film = grey(folder, 9);
  expect(scene, {"strands.layer[1].film: ", "grey9.png", "3 x 2 pixels", "8 columns"});
}

}  // namespace
}  // namespace pelage::strands
