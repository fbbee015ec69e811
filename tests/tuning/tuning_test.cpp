#include <algorithm>

#include "harness/error.hpp"
#include "harness/tuning/tuning_search.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

/// The simulated time and output of a configuration. The simulated times are alternately `ms` * (1 + `noise`)
/// and `ms` * (1 - `noise`), in milliseconds.
struct Behaviour {
  double ms = 10;
  std::uint64_t output = 1;
  bool right = true;
  double noise = 0;
};
using World = std::function<Behaviour(const Tuning&)>;

class FakeContender : public Contender {
 public:
  explicit FakeContender(const Behaviour& behaviour) : behaviour_(behaviour) {}
  double run_ms() override {
    return behaviour_.ms * (++runs_ % 2 ? 1 + behaviour_.noise : 1 - behaviour_.noise);
  }
  std::uint64_t output_hash() override { return behaviour_.output; }
  std::string fault() override { return behaviour_.right ? "" : "psnr is 12"; }

 private:
  Behaviour behaviour_;
  int runs_ = 0;
};

TuningSearch search(const World& world,
                    const std::vector<TuningAxis>& axes = {{"A", "", {1, 2, 3}, {}}, {"B", "", {1, 2}, {}}}) {
  const TuningScene scene{"scene",
                          [&](const Tuning& t) { return std::make_unique<FakeContender>(world(t)); }};
  return search_tuning(axes, {scene, scene}, 8, [](const Candidate&) {});
}

int value(const Tuning& tuning, const std::string& axis) {
  const auto found = tuning.find(axis);
  return found == tuning.end() ? 0 : found->second;
}

TEST(TuningSearch, FindsTheFastestOfAllAxes) {
  const TuningSearch found = search([](const Tuning& t) {
    return Behaviour{.ms = 10.0 - value(t, "A") * (value(t, "A") < 3) - value(t, "B")};
  });
  EXPECT_EQ(found.best, (Tuning{{"A", 2}, {"B", 2}}));
  EXPECT_NEAR(found.last.ratio, 0.6, 1e-9);
  EXPECT_TRUE(found.last.wins);
}

TEST(TuningSearch, APlantedWrongConfigurationIsNeverStoredHoweverFast) {
  const TuningSearch found = search([](const Tuning& t) {
    if (value(t, "A") == 1) return Behaviour{.ms = 0.1, .output = 2, .right = false};
    if (value(t, "A") == 2) return Behaviour{.ms = 9};
    return Behaviour{};
  });
  EXPECT_EQ(found.best, (Tuning{{"A", 2}}));
  const auto wrong = std::find_if(found.tried.begin(), found.tried.end(), [](const Candidate& c) {
    return c.tuning == Tuning{{"A", 1}};
  });
  ASSERT_NE(wrong, found.tried.end());
  EXPECT_EQ(wrong->fault, "scene: psnr is 12");
  EXPECT_FALSE(wrong->wins);
}

TEST(TuningSearch, OtherBitsMayWinWhenTheReferenceAgrees) {
  const TuningSearch found = search(
      [](const Tuning& t) { return value(t, "A") == 1 ? Behaviour{.ms = 5, .output = 7} : Behaviour{}; });
  EXPECT_EQ(found.best, (Tuning{{"A", 1}}));
}

TEST(TuningSearch, WhatIsNotSurelyFasterDoesNotWin) {
  EXPECT_TRUE(search([](const Tuning&) { return Behaviour{}; }).best.empty());
  const TuningSearch noisy =
      search([](const Tuning& t) { return t.empty() ? Behaviour{} : Behaviour{.ms = 9.8, .noise = 0.3}; });
  EXPECT_TRUE(noisy.best.empty());
  EXPECT_TRUE(noisy.last.tuning.empty());
}

TEST(TuningSearch, AWinnerByChanceIsDroppedInTheLastDuel) {
  int made = 0;
  // The candidate is fast in its first comparison with the incumbent, and slow in the final comparison.
  const TuningSearch found = search(
      [&made](const Tuning& t) {
        return t.empty() ? Behaviour{} : Behaviour{.ms = ++made <= 2 ? 5.0 : 11.0};
      },
      {{"A", "", {1}, {}}});
  EXPECT_EQ(found.last.tuning, (Tuning{{"A", 1}}));
  EXPECT_GT(found.last.ratio, 1);
  EXPECT_TRUE(found.best.empty());
}

TEST(TuningSearch, WhatDoesNotRunIsPassedOver) {
  const TuningSearch found = search([](const Tuning& t) -> Behaviour {
    if (value(t, "A") == 1) throw DeviceError("no work-group of that size\nlog");
    return Behaviour{.ms = value(t, "A") == 2 ? 5.0 : 10.0};
  });
  EXPECT_EQ(found.best, (Tuning{{"A", 2}}));
  EXPECT_EQ(found.tried.front().fault, "no work-group of that size");
}

TEST(TuningSearch, NothingIsSearchedWhenWhatIsShippedIsWrong) {
  const TuningSearch found = search([](const Tuning& t) { return Behaviour{.right = !t.empty()}; });
  EXPECT_EQ(found.fault, "scene: psnr is 12");
  EXPECT_TRUE(found.tried.empty());
  EXPECT_TRUE(found.best.empty());
}

TEST(TuningFile, StagesAreReplacedOneByOne) {
  const test::Folder folder;
  const auto file = folder.path / "t.toml";
  std::string text = with_stage("", "rasterize", {{"TILE_W", 8}, {"GROUP", 2}}, "one\ntwo");
  text = with_stage(text, "wet", {{"WET_BUCKET", 8}}, "three");
  test::write_text(file, text);
  EXPECT_EQ(read_tuning(file), (Tuning{{"TILE_W", 8}, {"GROUP", 2}, {"WET_BUCKET", 8}}));
  text = with_stage(text, "rasterize", {}, "four");
  test::write_text(file, text);
  EXPECT_EQ(read_tuning(file), (Tuning{{"WET_BUCKET", 8}}));
  EXPECT_EQ(text, "# three\n[wet]\nWET_BUCKET = 8\n\n# four\n[rasterize]\n");
}

TEST(TuningFile, MistakesAreRefusedByLineAndKey) {
  const test::Folder folder;
  test::expect_refusals({{"TILE_W = 16\nTILLE_H = 16\n", "t.toml:2: TILLE_H: no such tuning axis"},
                         {"TILE_W = 1.5\n", "t.toml:1: TILE_W"},
                         {"TILE_W = -1\n", "whole number"},
                         {"tile = 1\n", "capitals"},
                         {"TILE_W = 8\n[rasterize]\nTILE_W = 8\n", "occurs twice"},
                         {"TILE_W = \n", "not TOML"}},
                        [&](const std::string& text) { read_tuning(folder.write("t.toml", text)); });
}

TEST(TuningAxes, EveryStageHasSomeAndTheShippedValueIsNoCandidate) {
  const std::vector<std::string> stages = tunable_stages();
  EXPECT_GE(stages.size(), 3u);
  for (const std::string& stage : stages) {
    const std::vector<TuningAxis> axes = tuning_axes(stage);
    EXPECT_FALSE(axes.empty()) << stage;
    for (const TuningAxis& axis : axes) {
      EXPECT_FALSE(axis.values.empty()) << axis.name;
      EXPECT_FALSE(axis.what.empty()) << axis.name;
      EXPECT_EQ(std::count(axis.values.begin(), axis.values.end(), axis.shipped.value_or(-1)), 0);
    }
  }
  EXPECT_THROW(tuning_axes("raster"), InputError);
}

}  // namespace
}  // namespace pelage
