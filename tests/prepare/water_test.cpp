// Tests the water over time (docs/shells.md, section 10): the closed form of a droplet's wetness, the
// arrivals, and the account of the water.
#include "harness/prepare/water.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/prepare/droplets.hpp"
#include "tests/prepare/meshes.hpp"

namespace pelage {
namespace {

struct Times {
  float soak, drying, drip;
};

WetnessScene scene_of(const Times& t) {
  WetnessScene wetness;
  wetness.soak = t.soak;
  wetness.drying = t.drying;
  wetness.drip = t.drip;
  return wetness;
}

constexpr Times all_times[] = {{0, 0, 0},       {1.5f, 0, 0},    {0, 2, 0},
                               {0, 0, .3f},     {0, 2, .3f},     {.7f, 3, .05f},
                               {2, .25f, .01f}, {.01f, 1000, 5}, {1, 3600, 1.0f / 64}};

/// Integrates the equations of docs/shells.md, section 10, by small steps of the midpoint rule, from the
/// arrival on.
Water integrated(const WetnessScene& w, double drop, double age) {
  constexpr double step = 1e-4;
  Water water{.fell = drop, .unsoaked = drop};
  const double soak = double(w.soak), drying = double(w.drying), drip = double(w.drip);
  for (double t = 0; t < age;) {
    const bool soaks = t < soak;
    double dt = std::min(step, age - t);
    if (soaks) dt = std::min(dt, soak - t);
    if (soaks) {
      water.held += drop * dt / soak;
      water.unsoaked -= drop * dt / soak;
    } else {
      water.held += water.unsoaked;
      water.unsoaked = 0;
      const auto rate = [&](double rho) { return drying > 0 ? rho / drying : 0.0; };
      const double middle = water.held - dt / 2 * (rate(water.held) + drip);
      double evaporated = dt * rate(std::max(0.0, middle)), dripped = dt * drip;
      const double part = std::min(1.0, water.held / std::max(1e-300, evaporated + dripped));
      water.evaporated += part * evaporated;
      water.dripped += part * dripped;
      water.held -= part * (evaporated + dripped);
    }
    t += dt;
  }
  if (soak == 0 && water.unsoaked > 0) {
    water.held += water.unsoaked;
    water.unsoaked = 0;
  }
  return water;
}

TEST(Water, TheClosedFormIsTheIntegral) {
  for (const Times& times : all_times)
    for (const double drop : {1.0, .6, .03})
      for (const double age : {0.0, .004, .5, 1.0, 1.7, 2.3, 4.0, 9.0}) {
        SCOPED_TRACE(fmt::format("soak {} drying {} drip {} drop {} age {}", times.soak, times.drying,
                                 times.drip, drop, age));
        const WetnessScene wetness = scene_of(times);
        const Water closed = water_of(wetness, drop, age), stepped = integrated(wetness, drop, age);
        const double close = 1e-4 * drop * (1 + double(times.drip) / drop);
        EXPECT_DOUBLE_EQ(closed.fell, drop);
        EXPECT_NEAR(closed.unsoaked, stepped.unsoaked, close);
        EXPECT_NEAR(closed.held, stepped.held, close);
        EXPECT_NEAR(closed.evaporated, stepped.evaporated, close);
        EXPECT_NEAR(closed.dripped, stepped.dripped, close);
      }
}

TEST(Water, HandMadeValues) {
  WetnessScene wetness = scene_of({2, 0, 0});
  EXPECT_EQ(water_of(wetness, .8, -1e-9).fell, 0);
  EXPECT_DOUBLE_EQ(water_of(wetness, .8, .5).held, .2);
  EXPECT_DOUBLE_EQ(water_of(wetness, .8, 2).held, .8);
  wetness = scene_of({0, 3, 0});
  EXPECT_DOUBLE_EQ(water_of(wetness, .8, 3).held, .8 / std::numbers::e);
  wetness = scene_of({1, 0, .25f});
  EXPECT_DOUBLE_EQ(water_of(wetness, .8, 3).held, .3);
  EXPECT_DOUBLE_EQ(water_of(wetness, .8, 4.2).held, 0);
  EXPECT_DOUBLE_EQ(water_of(wetness, .8, 100).dripped, .8);
  // rho = (drop + D T) e^-1 - D T with drop = .5, D T = .25 .. and 0 from b = T ln(1 + .5 / .25) on
  wetness = scene_of({0, 2, .125f});
  EXPECT_DOUBLE_EQ(water_of(wetness, .5, 2).held, .75 / std::numbers::e - .25);
  EXPECT_GT(water_of(wetness, .5, 2 * std::log(3.0) - 1e-6).held, 0);
  EXPECT_EQ(water_of(wetness, .5, 2 * std::log(3.0) + 1e-6).held, 0);
}

Droplet droplet(float wetness, float arrival, std::uint32_t number = Droplet::alone) {
  Droplet d{{.5f, .5f}, .1f, wetness, {0, 0, 0}, 1, number};
  d.arrival = arrival;
  return d;
}

TEST(Water, TheAccountIsCompleteAndMonotone) {
  std::vector<Droplet> drops;
  drops.reserve(40);
  for (int i = 0; i < 40; ++i) drops.push_back(droplet(.02f + .024f * float(i), .1f * float(i)));
  for (const Times& times : all_times) {
    const WetnessScene wetness = scene_of(times);
    Water before;
    for (int step = 0; step <= 400; ++step) {
      const Water now = water_at(wetness, drops, {2, 3}, .025 * step);
      for (const double part : {now.fell, now.unsoaked, now.held, now.evaporated, now.dripped}) {
        EXPECT_GE(part, 0);
        EXPECT_LE(part, now.fell);
      }
      EXPECT_NEAR(now.fell, now.unsoaked + now.held + now.evaporated + now.dripped, 1e-14 * now.fell);
      EXPECT_GE(now.fell, before.fell);
      EXPECT_GE(now.evaporated, before.evaporated - 1e-14 * now.fell);
      EXPECT_GE(now.dripped, before.dripped - 1e-14 * now.fell);
      before = now;
    }
    double sum = 0;
    for (const Droplet& d : drops)
      sum += double(d.wetness) * std::numbers::pi * double(.1f) * double(.1f) * 6;
    EXPECT_NEAR(before.fell, sum, 1e-12 * sum);
  }
}

TEST(Water, RepetitionsHaveNoMass) {
  const WetnessScene wetness = scene_of({0, 2, 0});
  const std::vector<Droplet> once{droplet(.5f, 0, 0), droplet(.8f, 1, 1), droplet(.7f, 1)},
      repeated{droplet(.5f, 0, 0), droplet(.5f, 0, 0), droplet(.8f, 1, 1), droplet(.8f, 1, 1),
               droplet(.7f, 1)};
  for (const double time : {0.0, 1.0, 2.5}) {
    EXPECT_EQ(water_at(wetness, once, {1, 1}, time).held, water_at(wetness, repeated, {1, 1}, time).held);
    EXPECT_EQ(water_csv_line(wetness, once, {1, 1}, time), water_csv_line(wetness, repeated, {1, 1}, time));
  }
  const std::vector<Droplet> two{droplet(.5f, 0), droplet(.5f, 0)};
  EXPECT_DOUBLE_EQ(water_at(wetness, two, {1, 1}, 0).fell, 2 * water_at(wetness, {two[0]}, {1, 1}, 0).fell);
}

TEST(Water, ArrivesAtEqualIntervalsUntilTheEnd) {
  WetnessScene wetness;
  wetness.rate = 4;
  wetness.begin = 1;
  wetness.end = 2;
  std::vector<Droplet> drops(10, droplet(.5f, 0));
  drops[0].arrival = 7;  // a droplet of the list
  set_arrivals(wetness, drops, 1);
  ASSERT_EQ(drops.size(), 6u);
  EXPECT_EQ(drops[0].arrival, 7);
  for (std::size_t i = 1; i < drops.size(); ++i) EXPECT_EQ(drops[i].arrival, 1 + .25f * float(i - 1));
  wetness.rate = 0;
  set_arrivals(wetness, drops, 1);
  ASSERT_EQ(drops.size(), 6u);
  for (std::size_t i = 1; i < drops.size(); ++i) EXPECT_EQ(drops[i].arrival, 1);
}

TEST(Water, OfASceneIsThatOfItsDropletsInTheirOrder) {
  WetnessScene wetness;
  wetness.random = 300;
  wetness.seams = "ignored";
  const auto mesh = test::two_charts();
  const std::vector<Droplet> still = make_droplets(mesh, weld(*mesh), wetness);
  EXPECT_FALSE(water_changes(wetness, still));
  wetness.rate = 100;
  wetness.end = 1;
  wetness.droplets.resize(1);
  wetness.droplets[0].uv = glm::vec2(.2f);
  wetness.droplets[0].time = 3;
  const std::vector<Droplet> rain = make_droplets(mesh, weld(*mesh), wetness);
  ASSERT_EQ(rain.size(), 102u) << "at 100 per second, 101 droplets arrive from 0 to 1 s";
  EXPECT_EQ(rain[0].arrival, 3);
  for (std::size_t i = 1; i < rain.size(); ++i) {
    EXPECT_EQ(rain[i].centre, still[i - 1].centre);
    EXPECT_EQ(rain[i].arrival, float(double(i - 1) / 100));
  }
  EXPECT_TRUE(water_changes(wetness, rain));
  EXPECT_EQ(droplets_at(wetness, rain, .495).size(), 50u);
  EXPECT_EQ(droplets_at(wetness, rain, 2).size(), 101u);
  EXPECT_EQ(droplets_at(wetness, rain, 3).size(), 102u);
}

TEST(Water, RepetitionsArriveWithTheirDroplet) {
  WetnessScene wetness;
  wetness.random = 300;
  wetness.rate = 100;
  wetness.seams = "joined";
  const auto mesh = test::two_charts();
  const std::vector<Droplet> rain = make_droplets(mesh, weld(*mesh), wetness);
  std::size_t repetitions = 0;
  for (std::size_t i = 1; i < rain.size(); ++i) {
    const bool repeats = rain[i].number == rain[i - 1].number;
    EXPECT_EQ(rain[i].arrival == rain[i - 1].arrival, repeats);
    repetitions += repeats;
  }
  EXPECT_GT(repetitions, 3u);
}

TEST(Water, ThatDoesNotChangeIsLeftAsItIs) {
  std::vector<Droplet> drops{droplet(.5f, 0), droplet(0, 0), droplet(0x1p-40f, 0)};
  WetnessScene wetness;
  EXPECT_FALSE(water_changes(wetness, drops));
  EXPECT_EQ(droplets_at(wetness, drops, 5).size(), 3u);
  EXPECT_FALSE(water_changes(scene_of({1, 1, 1}), {}));
  for (const Times& times : {Times{1, 0, 0}, Times{0, 1, 0}, Times{0, 0, 1}})
    EXPECT_TRUE(water_changes(scene_of(times), drops));
  wetness.soak = 1;
  EXPECT_EQ(droplets_at(wetness, drops, 5).size(), 1u) << "droplets that are too dry are left out";
  EXPECT_EQ(droplets_at(wetness, drops, 5)[0].wetness, .5f);
  EXPECT_EQ(droplets_at(wetness, drops, .25)[0].wetness, .125f);
  EXPECT_EQ(present_wetness(wetness, droplet(.5f, 0), double(least_wetness) * 2), least_wetness);
  EXPECT_EQ(present_wetness(wetness, droplet(.5f, 0), double(least_wetness) * 1.9), 0);
}

TEST(Water, IsWrittenAsCsv) {
  FrameInput input;
  auto mesh = std::make_shared<Mesh>();
  mesh->length_per_uv = glm::vec2(2);
  input.mesh = mesh;
  input.droplets = {droplet(.5f, 1)};
  input.droplets[0].radius = 1;
  input.scene.wetness.soak = 2;
  const std::string two_pi = fmt::format("{:.9g}", 2 * std::numbers::pi),
                    half = fmt::format("{:.9g}", std::numbers::pi);
  std::string text = water_csv_header();
  for (const double time : {0.0, 2.0, 3.0})
    text += water_csv_line(input.scene.wetness, input.droplets, mesh->length_per_uv, time);
  EXPECT_EQ(text, fmt::format("time_s,droplets,fell,unsoaked,held,evaporated,dripped\n0,0,0,0,0,0,0\n"
                              "2,1,{0},{1},{1},0,0\n3,1,{0},0,{0},0,0\n",
                              two_pi, half));
}

TEST(Water, HasTheTimeOfThePicture) {
  DynamicsScene dynamics;
  dynamics.step = .25f;
  dynamics.substeps = 2;
  EXPECT_EQ(picture_time(dynamics, 1), 0);
  EXPECT_EQ(picture_time(dynamics, 0), 0);
  EXPECT_EQ(picture_time(dynamics, 7), 3);
  dynamics.time = 2.3f;
  EXPECT_EQ(picture_time(dynamics, frames_before(dynamics) + 1), 2.5);
}

}  // namespace
}  // namespace pelage
