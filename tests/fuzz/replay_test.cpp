// Runs every fuzz target on its stored inputs (tests/fuzz/corpus), which include all inputs with which
// scripts/fuzz.sh has found an error.
#include <gtest/gtest.h>

#include <set>

#include "tests/fuzz/targets.hpp"
#include "tests/support/files.hpp"

namespace pelage::fuzz {
namespace {

const fs::path corpus = fs::path(PELAGE_SOURCE_DIR) / "tests/fuzz/corpus";

struct Replay : ::testing::TestWithParam<Target> {};

TEST_P(Replay, TheCorpusHasNoFinding) {
  int inputs = 0;
  for (const auto& entry : fs::directory_iterator(corpus / GetParam().name)) {
    EXPECT_NO_THROW(GetParam().run(test::text_of(entry.path()))) << entry.path();
    ++inputs;
  }
  EXPECT_GT(inputs, 1);
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Replay, ::testing::ValuesIn(targets),
                         [](const auto& with) { return std::string(with.param.name); });

TEST(Corpus, HasAFolderForEachTargetAndNoOther) {
  std::set<std::string> folders, names;
  for (const auto& entry : fs::directory_iterator(corpus)) folders.insert(entry.path().filename().string());
  for (const Target& target : targets) names.insert(std::string(target.name));
  EXPECT_EQ(folders, names);
}

}  // namespace
}  // namespace pelage::fuzz
