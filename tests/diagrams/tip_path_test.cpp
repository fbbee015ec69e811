// Tests the path of a tip, and the arrow of a wind that changes, against the reference's tips.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/frame_output.hpp"
#include "harness/compare/strands.hpp"
#include "harness/diagrams/diagrams.hpp"
#include "harness/error.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/scene/scene_toml.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

constexpr double path_rounding = 1e-5;  // the tips of reference_motion() are in single precision

Scene gusty(const std::string& keys) {
  return scene_at(parse_scene(fmt::format("{}\nfur.length = 0.2\nfur.layers = 4\nfur.texture = 16\n"
                                          "image.width = 64\nimage.height = 32\ndynamics.time = 0.5\n"
                                          "[keyframes]\n\"dynamics.wind.strength\" = "
                                          "[[0.0, 0.0], [0.3, 0.03], [0.4, 0.0]]",
                                          keys),
                              "s.toml"),
                  0.5);
}

const std::shared_ptr<const Mesh>& small_torus() {
  static const auto mesh = std::make_shared<const Mesh>(synthetic::grid(synthetic::torus(), 8, 6));
  return mesh;
}

/// The column `apart` must be, in each row, the value of a tip, and somewhere the greatest of all tips.
/// `apart_of` returns this value for all tips after some frames.
template <class ApartOf>
void expect_path(const diagrams::Section& path, const ApartOf& apart_of) {
  ASSERT_EQ(path.rows.size(), 31u);  // the pictures of 0 to 0.5 s
  double greatest = 0, of_path = 0;
  for (std::size_t i = 0; i < path.rows.size(); ++i) {
    const std::vector<double>& row = path.rows[i];
    ASSERT_EQ(row.size(), 6u);
    EXPECT_NEAR(row[0], double(i) / 60, 1e-6);
    EXPECT_LE(std::hypot(row[1] - row[3], row[2] - row[4]), row[5] * 0.2 + path_rounding);
    double nearest = 1;
    for (const double apart : apart_of(int(i) + 1)) {
      nearest = std::min(nearest, std::abs(apart - row[5]));
      greatest = std::max(greatest, apart);
    }
    EXPECT_LT(nearest, path_rounding) << i;
    of_path = std::max(of_path, row[5]);
  }
  EXPECT_NEAR(of_path, greatest, path_rounding);
  EXPECT_GT(of_path, 0.1);
  const auto farthest =
      std::ranges::max_element(path.rows, {}, [](const std::vector<double>& row) { return row[5]; });
  EXPECT_NEAR(std::hypot((*farthest)[1] - (*farthest)[3], (*farthest)[2] - (*farthest)[4]), of_path * 0.2,
              path_rounding);
}

TEST(TipPath, IsThatOfTheTipThatMovesFarthest) {
  for (const char* topology : {"silva", "sticks", "separable-prisms"}) {
    const auto input = prepare(gusty(fmt::format("dynamics.topology = \"{}\"", topology)), small_torus());
    const std::vector<glm::vec3> rest = reference_motion(*input, 0).tips;
    expect_path(diagrams::path_section(*input, 100000), [&](int frames) {
      const std::vector<glm::vec3> tips = reference_motion(*input, frames).tips;
      std::vector<double> apart;
      for (std::size_t i = 0; i < tips.size(); ++i)
        apart.push_back(double(glm::distance(tips[i], rest[i])) / 0.2);
      return apart;
    });
  }
}

TEST(TipPath, OfAStickReturnsLikeTheRootOfTheTime) {
  // docs/springs.md, section Forces: sqrt(c L / (w t)), below it by the angle at the end of the wind.
  for (const auto& [w, c] : {std::pair(0.4, 0.004), {0.2, 0.01}}) {
    const Scene scene = parse_scene(
        fmt::format(
            "dynamics.topology = \"sticks\"\ndynamics.springs.return_weight = {}\ndynamics.drag = {}\n"
            "fur.length = 0.2\nfur.layers = 4\nfur.texture = 16\ndynamics.time = 6.0\n[keyframes]\n"
            "\"dynamics.wind.strength\" = [[0.0, 0.03], [1.0, 0.03], [1.001, 0.0]]",
            w, c),
        "s.toml");
    const auto input = prepare(scene_at(scene, 6), small_torus());
    const double law = std::sqrt(c * 0.2 / (w * 5));
    const double found = diagrams::path_section(*input, 100000).rows.back()[5];
    EXPECT_LT(found, law);
    EXPECT_GT(found, 0.9 * law);
  }
}

TEST(TipPath, IsThatOfAKeyStrand) {
  const auto input = strands::prepare_strands(
      gusty("strands.layer = [{ count = 300, length = 0.2 }]\nstrands.chain.stiffness = 200\n"
            "strands.chain.stiffness_joint = 100"),
      small_torus());
  const float first = input->first_segment;
  expect_path(diagrams::path_section(*input, 100000), [&](int frames) {
    std::vector<double> apart;
    for (const strands::KeyStrand& key : reference_keys(*input, frames).first)
      apart.push_back(
          double(glm::length(first * (key.first - key.rest) + (1 - first) * (key.second - key.rest))));
    return apart;
  });
}

TEST(ArrowOfAWindThatChanges, ShowsTheWindOfThePicture) {
  for (const auto& [time, blows] : {std::pair(0.f, false), {0.3f, true}, {0.5f, false}}) {
    Scene scene = gusty("");
    scene.dynamics.time = time;
    const auto input = prepare(scene, small_torus());
    Picture picture{64, 32, std::vector<glm::vec4>(std::size_t(64) * 32, {0, 0, 0, 1})};
    if (blows) {
      EXPECT_NO_THROW(diagrams::draw_wind_arrow(picture, *input, 1));
    } else {
      EXPECT_THROW(diagrams::draw_wind_arrow(picture, *input, 1), InputError);
    }
  }
}

}  // namespace
}  // namespace pelage
