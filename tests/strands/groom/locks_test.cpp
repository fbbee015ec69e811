// Tests locks with the reference's curves, which share no code with
// steps.cpp.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "harness/strands/groom/steps.hpp"
#include "harness/strands/reference/drawing.hpp"

namespace pelage::strands {
namespace {

constexpr float first_segment = 0.4f;
constexpr std::size_t locks = 30;

/// Strands on a square in the plane z = 0, between key strands at its corners that lean in other directions.
struct Patch {
  std::vector<KeyStrand> keys;
  std::vector<KeyedStrand> strands;

  Patch() {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0, 1);
    for (const glm::vec3 root : {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}) {
      KeyStrand key;
      key.root = root;
      key.normal = {0, 0, 1};
      key.first = key.second = key.rest =
          glm::normalize(glm::vec3(0.5f + 0.3f * root.x, 0.4f * root.y, 0.7f));
      keys.push_back(key);
    }
    for (int i = 0; i < 1500; ++i) {
      KeyedStrand s;
      s.key = {0, 1, 2};
      s.weight = {unit(random), unit(random)};
      if (s.weight.x + s.weight.y > 1) s.weight = 1.0f - s.weight;
      s.length = 0.3f + 0.1f * unit(random);
      s.twist = 40 * unit(random) - 20;
      s.curvature = 50 * unit(random) - 25;
      strands.push_back(s);
    }
  }
  glm::vec3 tip(const KeyedStrand& s) const { return reference::between(keys, s, first_segment).point[2]; }
  glm::vec3 root(const KeyedStrand& s) const { return reference::between(keys, s, first_segment).point[0]; }
};

TEST(Locks, TipsMoveToTheTipOfTheNearestMiddle) {
  const Patch before;
  for (const float pull : {1.0f, 0.6f}) {
    Patch after;
    pull_into_locks(after.strands, after.keys, {locks, pull, first_segment});
    std::size_t reached = 0;
    for (std::size_t i = locks; i < after.strands.size(); ++i) {
      std::size_t middle = 0;
      for (std::size_t k = 1; k < locks; ++k)
        if (glm::distance(before.root(before.strands[k]), before.root(before.strands[i])) <
            glm::distance(before.root(before.strands[middle]), before.root(before.strands[i])))
          middle = k;
      const glm::vec3 own = before.tip(before.strands[i]), target = before.tip(before.strands[middle]);
      const glm::vec3 wanted = own + pull * (target - own), found = after.tip(after.strands[i]);
      const float change = after.strands[i].length / before.strands[i].length;
      ASSERT_GE(change, 0.5f);
      ASSERT_LE(change, 1.25f);
      if (change > 0.501f && change < 1.249f) {
        ASSERT_LT(glm::distance(found, wanted), 1e-4f) << i;
        ++reached;
      } else {
        ASSERT_LT(glm::distance(found, wanted), glm::distance(own, wanted) + 0.05f) << i;
      }
    }
    EXPECT_GT(reached, 1200u);
  }
}

TEST(Locks, TheMiddlesKeepTheirShapes) {
  const Patch before;
  Patch after;
  pull_into_locks(after.strands, after.keys, {locks, 1, first_segment});
  for (std::size_t i = 0; i < locks; ++i)
    EXPECT_EQ(after.tip(after.strands[i]), before.tip(before.strands[i]));
}

TEST(Locks, WithoutLocksOrPullNothingChanges) {
  const Patch before;
  for (const LockOptions& none : {LockOptions{0, 1, first_segment}, LockOptions{locks, 0, first_segment}}) {
    Patch after;
    pull_into_locks(after.strands, after.keys, none);
    for (std::size_t i = 0; i < after.strands.size(); ++i)
      ASSERT_EQ(after.tip(after.strands[i]), before.tip(before.strands[i]));
  }
}

TEST(Locks, DoNotJoinStrandsOfTheTwoSidesOfASheet) {
  Patch patch;
  const auto front = std::uint32_t(patch.keys.size());
  for (std::uint32_t k = 0; k < front; ++k) {
    KeyStrand key = patch.keys[k];
    key.normal.z = -1;
    key.first.z = key.second.z = key.rest.z = -key.rest.z;
    patch.keys.push_back(key);
  }
  // The middles are in front, and the strands that follow are behind.
  for (std::size_t i = locks; i < patch.strands.size(); ++i)
    for (std::uint32_t& key : patch.strands[i].key) key += front;
  const Patch before = patch;
  pull_into_locks(patch.strands, patch.keys, {locks, 1, first_segment});
  for (std::size_t i = 0; i < patch.strands.size(); ++i)
    ASSERT_EQ(patch.strands[i].twist, before.strands[i].twist);
}

}  // namespace
}  // namespace pelage::strands
