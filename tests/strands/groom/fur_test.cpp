// Tests the fur of a scene: key strands, layers, colours, film strips and seeds (docs/strands.md, section
// Authoring).
#include <algorithm>
#include <set>

#include "tests/strands/groom/groom.hpp"

namespace pelage::strands {
namespace {

using pelage::test::Folder;
using namespace test;

TEST(Fur, HasAKeyStrandForEachLayerAtEachCornerOfATriangleWithStrands) {
  StrandsScene scene = even(40);
  scene.layers.push_back(scene.layers.front());
  scene.layers[1].count = 25;
  scene.layers[1].lean = 10;
  const Mesh mesh = square();
  const Fur fur = grow(mesh, scene, plain_coat());
  ASSERT_EQ(fur.strands.size(), 65u);
  ASSERT_EQ(fur.chains.size(), fur.keys.size());
  std::set<std::uint32_t> used;
  std::set<std::pair<int, std::uint32_t>> points;
  for (const KeyedStrand& s : fur.strands)
    for (const std::uint32_t key : s.key) {
      ASSERT_LT(key, fur.keys.size());
      used.insert(key);
      const glm::vec3 root = fur.keys[key].root;
      const auto grid = [](float x) { return std::uint32_t(std::lround((x + 1) * 8)); };
      points.emplace(s.layer, grid(root.x) * 100 + grid(root.y));
      EXPECT_NEAR(glm::dot(fur.keys[key].rest, fur.keys[key].normal),
                  std::cos(s.layer == 0 ? 40 * 0.0174533 : 10 * 0.0174533), 1e-6);
    }
  EXPECT_EQ(used.size(), fur.keys.size()) << "a key strand that no strand uses";
  EXPECT_EQ(points.size(), fur.keys.size()) << "two key strands at a point of a layer";
  EXPECT_LT(fur.keys.size(), 2 * mesh.welded) << "some points have no strands";
}

TEST(Fur, StrandsAtASeamOfTheUvMapShareKeyStrands) {
  const Mesh torus = synthetic::grid(synthetic::torus(), 24, 12);
  ASSERT_LT(torus.welded, torus.position.size());
  const Fur fur = grow(torus, even(5000), plain_coat());
  EXPECT_EQ(fur.keys.size(), torus.welded);
}

TEST(Fur, ChainsHaveTheConstantsOfTheirKeyStrands) {
  StrandsScene scene = even(300);
  scene.chain.stiffness = 700;
  scene.chain.stiffness_joint = 90;
  scene.chain.limit = 50;
  scene.chain.limit_joint = 33;
  scene.layers.front().stiffness = 2.5f;
  scene.layers.front().drag = 3;
  scene.layers.front().damping = 0.5f;
  scene.layers.front().limit = 1.5f;
  scene.layers.front().length_spread = 0.4f;
  const Fur fur = grow(square(), scene, plain_coat());
  for (std::size_t i = 0; i < fur.keys.size(); ++i) {
    const Chain& chain = fur.chains[i];
    EXPECT_EQ(chain.root, fur.keys[i].root);
    EXPECT_EQ(chain.normal, fur.keys[i].normal);
    EXPECT_EQ(chain.rest, fur.keys[i].rest);
    EXPECT_EQ(chain.length, scene.layers.front().length);
    EXPECT_EQ(chain.stiffness_first, 1750);
    EXPECT_EQ(chain.stiffness_second, 225);
    EXPECT_EQ(chain.limit_first, 75);
    EXPECT_EQ(chain.limit_second, 49.5f);
    EXPECT_EQ(chain.drag, 3);
    EXPECT_EQ(chain.damping, 0.5f);
  }
  EXPECT_NO_THROW(strand_columns(fur.chains, {}));
}

TEST(Fur, ChainsAreValidForShortStrandsThatLieOnTheSkin) {
  StrandsScene scene = even(300);
  scene.layers.front().lean = 90;
  scene.layers.front().length = 0.0001f;
  const Mesh torus = synthetic::grid(synthetic::torus(), 24, 12);
  EXPECT_NO_THROW(strand_columns(grow(torus, scene, plain_coat()).chains, {}));
}

TEST(Fur, DrawsValuesFromTheirSpreads) {
  StrandsScene scene = even(4000);
  StrandLayerScene& layer = scene.layers.front();
  layer.length_spread = 0.4f;
  layer.twist = 20;
  layer.twist_spread = 50;
  layer.curvature = -10;
  layer.curvature_spread = 30;
  layer.response = 0.7f;
  const Fur fur = grow(square(), scene, plain_coat());
  const auto expect = [&](float KeyedStrand::*value, double mean, double spread) {
    double least = 1e9, most = -1e9, sum = 0;
    for (const KeyedStrand& s : fur.strands) {
      least = std::min(least, double(s.*value));
      most = std::max(most, double(s.*value));
      sum += double(s.*value);
    }
    EXPECT_GE(least, mean - spread - 1e-5);
    EXPECT_LE(most, mean + spread + 1e-5);
    EXPECT_LT(least, mean - 0.98 * spread);
    EXPECT_GT(most, mean + 0.98 * spread);
    EXPECT_NEAR(sum / 4000, mean, 0.04 * spread);  // 4 standard deviations
  };
  expect(&KeyedStrand::length, 0.1, 0.04);
  expect(&KeyedStrand::twist, 20, 50);
  expect(&KeyedStrand::curvature, -10, 30);
  EXPECT_TRUE(std::all_of(fur.strands.begin(), fur.strands.end(),
                          [](const KeyedStrand& s) { return s.response == 0.7f; }));
}

TEST(Fur, HasTheColourOfTheCoatAtTheRoot) {
  StrandsScene scene = even(800);
  scene.layers.front().colour = {0.5f, 1, 1.2f};
  CoatTexture coat{256, {}};
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) coat.texel.push_back({std::uint8_t(x), std::uint8_t(y), 100, 255});
  const Fur fur = grow(square(), scene, coat);
  for (const KeyedStrand& s : fur.strands) {
    const glm::vec3 root = root_of(fur, s);
    // Texel i has the value i at the coordinate (i + 1/2) / 256. The texture repeats at its borders.
    const double u = 128.0 * (double(root.x) + 1) - 0.5, v = 128.0 * (double(root.y) + 1) - 0.5;
    if (u > 0 && u < 255) {
      ASSERT_NEAR(s.colour[0], 0.5 * u, 0.51);
    }
    if (v > 0 && v < 255) {
      ASSERT_NEAR(s.colour[1], v, 0.51);
    }
    ASSERT_EQ(s.colour[2], 120);
  }
}

TEST(Fur, RegionsLimitLayers) {
  StrandsScene scene = even(700);
  StrandLayerScene belly = scene.layers.front();
  belly.region_centre = {0.2f, -0.1f, 0.3f};
  belly.region_radius = 0.6f;
  scene.layers = {belly, belly};
  scene.layers[1].region_outside = true;
  const Fur fur = grow(square(), scene, plain_coat());
  std::size_t inside = 0;
  for (const KeyedStrand& s : fur.strands) {
    const float distance = glm::distance(root_of(fur, s), belly.region_centre);
    ASSERT_EQ(s.layer == 0, distance <= 0.6f) << distance;
    inside += s.layer == 0;
  }
  EXPECT_EQ(inside, 700u);
  ASSERT_EQ(fur.bounds.size(), 2u);
  EXPECT_GT(fur.bounds[0].low.x, -0.45f);
  EXPECT_LT(fur.bounds[1].low.x, -0.9f);
  for (const LayerBounds& b : fur.bounds) EXPECT_GT(b.high.z, 0.05f) << "the bounds contain the tips";
}

TEST(Fur, DependsOnTheSeedAndOnTheNumberOfTheLayer) {
  StrandsScene scene = even(200);
  scene.layers.front().length_spread = 0.3f;
  const Mesh mesh = square();
  const Fur fur = grow(mesh, scene, plain_coat());
  EXPECT_EQ(difference(grow(mesh, scene, plain_coat()), fur), "");
  scene.layers.push_back(scene.layers.front());
  const Fur two = grow(mesh, scene, plain_coat());
  std::set<std::pair<float, float>> roots;
  for (const KeyedStrand& s : two.strands) roots.emplace(root_of(two, s).x, root_of(two, s).y);
  EXPECT_EQ(roots.size(), 400u) << "layers with equal seeds have different roots";
  scene.layers.pop_back();
  scene.layers.front().seed = 2;
  EXPECT_NE(difference(grow(mesh, scene, plain_coat()), fur), "");
}

TEST(Fur, NeighboursInMemoryAreNeighboursOnTheSkin) {
  const Fur fur = grow(square(), even(40000), plain_coat());
  std::size_t equal = 0;
  for (std::size_t i = 1; i < fur.strands.size(); ++i) equal += fur.strands[i].key == fur.strands[i - 1].key;
  // There are 512 triangles. The last block of prefix_order() has 2,500 strands, the earlier ones have fewer.
  EXPECT_GT(equal, 20000u);
}

TEST(Fur, EachLayerHasItsFramesOfTheFilmStrip) {
  const Folder folder;
  StrandsScene scene = even(10);
  scene.layers.resize(4, scene.layers.front());
  const auto strip = [&](const char* name, int rows, int blue) {
    return picture(folder, name, 8, rows, [=](int x, int y) { return glm::ivec3(10 * y, 20 * x, blue); });
  };
  scene.layers[1].film = strip("a.png", 3, 5);
  scene.layers[3].film = strip("b.png", 2, 0);
  const Fur fur = grow(square(), scene, plain_coat());
  const std::vector<LayerLook> expected{{0, 0, 1}, {1, 1, 3}, {2, 0, 1}, {3, 4, 2}};
  EXPECT_EQ(fur.layers, expected);
  ASSERT_EQ(fur.film.size(), 6u);
  const auto sample = [&](std::size_t frame, std::size_t column) {
    const FilmSample& s = fur.film[frame][column];
    return std::array<int, 3>{s.luminance, s.gloss, s.opacity};
  };
  for (std::size_t x = 0; x < 8; ++x) {
    EXPECT_EQ(sample(0, x), (std::array<int, 3>{128, 128, 255}));  // factors 1
    EXPECT_EQ(sample(3, x), (std::array<int, 3>{20, 20 * int(x), 250}));
    EXPECT_EQ(sample(5, x), (std::array<int, 3>{10, 20 * int(x), 255}));
  }
  scene.layers[0].film = scene.layers[2].film = strip("long.png", 130, 0);
  EXPECT_NE(test::refusal(square(), scene).find("more than 256 frames"), std::string::npos);
  for (StrandLayerScene& layer : scene.layers) layer.film = "";
  EXPECT_TRUE(grow(square(), scene, plain_coat()).film.empty());
}

}  // namespace
}  // namespace pelage::strands
